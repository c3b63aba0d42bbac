#pragma once
// HEVC by the command `x265` (preset medium, constant rate factor): the views as a film, in ring order. All bytes of
// the stream count; alpha is not stored. One frame at a time (-F 1), so that the result does not depend on the machine.

#include "tests/bench/rd/anchors/yuv_frames.hpp"
#include "tests/bench/rd/coded.hpp"

#include <filesystem>
#include <vector>

namespace rs::bench {

struct X265Settings {
    bool intra = false;        // every frame by itself (--keyint 1)
    bool full_chroma = false;  // 4:4:4, else 4:2:0
    bool tune_psnr = false;    // --tune psnr, else the default, which follows the eye
    int crf = 28;
};

// `shown` are the opaque images to code, view by view. `folder` takes temporary files.
Result<Coded> code_x265(const ReferenceImages& images, const std::vector<Image<Rgba8>>& shown,
                        const X265Settings& settings, const std::filesystem::path& folder);

}  // namespace rs::bench
