#pragma once
/// \file
/// Size and position of the object: the bounding cylinder of its visual hull, carved from the masks of posed photos.

#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"

#include <glm/glm.hpp>
#include <opencv2/core.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace rs::capture {

/// A mask and its camera, whose pixels are those of the mask.
struct HullView {
    Camera camera;
    cv::Mat1b mask;  ///< not 0: object
};

/// Longer side of a mask for carving, at most.
inline constexpr int kHullMask_px = 512;

/// The camera of an image that is reduced to at most kHullMask_px.
Camera hull_camera(Camera camera);

/// Point nearest to all rays through the middles of the masks, in least squares. Error: all rays are parallel.
Result<glm::dvec3> common_target(std::span<const HullView> views);

/// Number of cameras that have the point in front of them.
std::size_t count_in_front(std::span<const HullView> views, const glm::dvec3& point);

/// Voxels of the visual hull.
struct VisualHull {
    std::vector<glm::dvec3> voxels;  ///< centres
    glm::dvec3 step{0};              ///< sides of a voxel in a frame whose Y is `up`
};

/// Parameters of carving.
struct HullCarving {
    int voxels_per_side = 64;       ///< of the last pass
    double tolerated_views = 0.05;  ///< share of the views with a voxel in their frame that may see background there
    double min_views = 1.0 / 3;     ///< share of all views that must have a voxel in their frame
};

/// Carves voxels as carve_bounding_cylinder() does. Error: nothing remains.
Result<VisualHull> carve_visual_hull(std::span<const HullView> views, const glm::dvec3& target, const glm::dvec3& up,
                                     const HullCarving& carving = {});

/// Silhouette of the hull, 255 = object: each voxel is a square of its projected side.
cv::Mat1b project_hull(const Camera& camera, const VisualHull& hull);

/// Bounding cylinder about `up`.
struct BoundingCylinder {
    glm::dvec3 centre{0};  ///< on the axis, at half the height
    double radius = 0;
    double height = 0;
    /// Indices of views whose camera is inside the cylinder.
    std::vector<std::size_t> cameras_inside;
    /// [view]: share of the mask's pixels that the hull does not cover, 0..1. Large where a mask has background that
    /// the others do not have.
    std::vector<double> beyond_hull;
};

/// Carves voxels in three passes, the last with 1/64 of the object's extent a side. A voxel remains if at most one in
/// twenty of the views that have it in their frame see background there, and if a third of all views have it in their
/// frame. `target`: common_target(). Error: nothing remains.
Result<BoundingCylinder> carve_bounding_cylinder(std::span<const HullView> views, const glm::dvec3& target,
                                                 const glm::dvec3& up);

}  // namespace rs::capture
