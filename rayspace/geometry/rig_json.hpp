#pragma once
// Parser of read_rig() and rig_from_json(); internal to rayspace.

#include "rayspace/geometry/rig.hpp"

#include <functional>

namespace rs {

struct ImageSize {
    int width = 0;  // px
    int height = 0;
};

/// Called for the first frame if neither the file nor that frame states the image size.
using FindImageSize = std::function<Result<ImageSize>(const RigView& first)>;

Result<Rig> parse_rig(const std::string& text, const std::string& where, const FindImageSize& find_size);

}  // namespace rs
