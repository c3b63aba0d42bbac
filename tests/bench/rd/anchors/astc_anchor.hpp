#pragma once
// ASTC by the command `astcenc` (-medium). Blocks are coded independently, so that only visible blocks (alpha above 0)
// are coded, packed side by side in one image; their codes equal those of the whole images. Only these blocks count, 16
// bytes each. ASTC is therefore not charged for the empty part of a touched 8x8 block, nor for empty blocks larger than
// 8x8 that overlap one.

#include "tests/bench/rd/coded.hpp"

#include <filesystem>
#include <vector>

namespace rs::bench {

/// \param shown images to code, by view, with alpha
/// \param with_alpha code as RGBA; otherwise as opaque RGB
/// \param folder for temporary files
Result<Coded> code_astc(const ReferenceImages& images, const std::vector<Image<Rgba8>>& shown, int block_px,
                        bool with_alpha, const std::filesystem::path& folder);

}  // namespace rs::bench
