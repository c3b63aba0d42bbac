#pragma once
// Where the bytes of coded images went: in dense ones every decision is charged with its information content.

#include "rayspace/codec/code/coded_images.hpp"

#include <string>
#include <vector>

namespace rs::codec {

struct AccountEntry {
    std::string name;  // "prediction", "motion", "coefficients of Y", ...
    double bytes = 0;
};

// All images of `coded` must be loaded. The entries add up to the images' chunks but for their rounding to whole
// bytes, which is an entry too. Decodes dense images once, on the threads of the calling tbb arena.
std::vector<AccountEntry> account_bytes(const CodedImages& coded);

}  // namespace rs::codec
