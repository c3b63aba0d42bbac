#pragma once
// The parser behind read_rig() and rig_from_json(); private to rayspace.

#include "rayspace/geometry/rig.hpp"

#include <functional>

namespace rs {

struct ImageSize {
    int width = 0;  // px
    int height = 0;
};

// Called once, for the first frame, when neither the file nor that frame states how large the images are.
using FindImageSize = std::function<Result<ImageSize>(const RigView& first)>;

Result<Rig> parse_rig(const std::string& text, const std::string& where, const FindImageSize& find_size);

}  // namespace rs
