#pragma once
// ASTC by the command `astcenc` (-medium). Every block is coded by itself, so only the blocks that show something
// (alpha above 0) are given to it, packed side by side in one image: the same codes as for the whole images. Only
// those are billed, 16 bytes each. So ASTC is not charged for the empty part of a touched 8x8 block, nor for blocks
// larger than 8x8 that reach into one but show nothing.

#include "tests/bench/rd/coded.hpp"

#include <filesystem>
#include <vector>

namespace rs::bench {

// `shown` are the images to code, view by view, with their alpha; coded as RGBA where `with_alpha`, else as opaque
// RGB. `folder` takes temporary files.
Result<Coded> code_astc(const ReferenceImages& images, const std::vector<Image<Rgba8>>& shown, int block_px,
                        bool with_alpha, const std::filesystem::path& folder);

}  // namespace rs::bench
