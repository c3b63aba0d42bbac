#pragma once
// HEVC by the command `x265` (preset medium, constant rate factor): the views as a video in ring order. All bytes of
// the stream count; alpha is not stored. One frame thread (-F 1), so that the result does not depend on the machine.

#include "tests/bench/rd/anchors/yuv_frames.hpp"
#include "tests/bench/rd/coded.hpp"

#include <filesystem>
#include <vector>

namespace rs::bench {

struct X265Settings {
    bool intra = false;        // intra frames only (--keyint 1)
    bool full_chroma = false;  // 4:4:4, else 4:2:0
    bool tune_psnr = false;    // --tune psnr; else the default, perceptual tuning
    int crf = 28;
};

/// \param shown opaque images to code, by view
/// \param folder for temporary files
Result<Coded> code_x265(const ReferenceImages& images, const std::vector<Image<Rgba8>>& shown,
                        const X265Settings& settings, const std::filesystem::path& folder);

}  // namespace rs::bench
