#pragma once
// Conversions between the cameras of the public headers and those of the library.

#include "rayspace/api/camera.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/geometry/rig.hpp"

namespace rs::api {

rs::Camera to_internal(const Camera& camera);
Camera to_public(const rs::Camera& camera);
std::vector<CapturedCamera> cameras_of(const Rig& rig);

}  // namespace rs::api
