#pragma once
/// \file
/// Images and cameras of a posed capture set: each image is undistorted for a pinhole camera of its own, and the frame
/// has Y up, its origin at the middle of the object's bounding cylinder and an object_radius of 1.

#include "capture/posed/cameras/posed_camera.hpp"
#include "capture/posed/visual_hull.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <filesystem>
#include <span>
#include <string>

namespace rs::capture {

/// An image of the set; `hull.mask` is empty if it shows no object.
struct PosedImage {
    Camera camera;  ///< pinhole, in the world of the source
    HullView hull;
    bool was_distorted = false;
};

/// Undistorts a foreground image and writes it to `file`, unless it shows no object. `name` is that of the photo, in
/// messages. Errors: those of undistorted_camera(), the disk.
Result<PosedImage> write_posed_image(const PosedCamera& posed, Image<Rgba8> foreground, const std::string& name,
                                     const std::filesystem::path& file);

/// Object in the world of the source.
struct ObjectFrame {
    glm::dvec3 up{0, 1, 0};
    glm::dvec3 origin{0};
    double radius = 1;
};

/// Rig of the images 0, 1, ...: "posed": true, `names` as source_file, and up, origin and radius in photo_import. The
/// first camera beside the axis is above +Z.
Rig posed_rig(std::span<const Camera> cameras, std::span<const std::string> names, const ObjectFrame& object);

}  // namespace rs::capture
