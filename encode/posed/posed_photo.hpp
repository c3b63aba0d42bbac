#pragma once
// Photos of one object from cameras anywhere around it, in the rig's units: Y up, the object at the origin.

#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"

#include <string>

namespace rs::encode {

/// A photo without lens distortion; its alpha matte is the object.
struct PosedPhoto {
    std::string name;  // file_path, for errors
    Camera camera;
    Image<Rgba8> image;
};

}  // namespace rs::encode
