#pragma once
// Breakdown of the bytes of coded images by syntax element. In dense images every decision counts with its information
// content.

#include "rayspace/codec/code/coded_images.hpp"

#include <string>
#include <vector>

namespace rs::codec {

struct AccountEntry {
    std::string name;  // "prediction", "motion", "coefficients of Y", ...
    double bytes = 0;
};

/// Computes the breakdown. All images of `coded` must be loaded. The entries add up to the images' chunks; rounding to
/// whole bytes is an entry of its own. Decodes dense images once, on the threads of the calling tbb arena.
std::vector<AccountEntry> account_bytes(const CodedImages& coded);

}  // namespace rs::codec
