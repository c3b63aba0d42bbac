#pragma once
// Where the bytes of coded pictures went: in dense ones every decision is charged with its information content.

#include "rayspace/codec/code/coded_pictures.hpp"

#include <string>
#include <vector>

namespace rs::codec {

struct AccountEntry {
    std::string name;  // "prediction", "motion", "coefficients of Y", ...
    double bytes = 0;
};

// All pictures of `coded` must be loaded. The entries add up to the pictures' chunks but for their rounding to whole
// bytes, which is an entry too. Decodes dense pictures once, on the threads of the calling tbb arena.
std::vector<AccountEntry> account_bytes(const CodedPictures& coded);

}  // namespace rs::codec
