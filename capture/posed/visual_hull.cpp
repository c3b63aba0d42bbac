#include "capture/posed/visual_hull.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "rayspace/base/parallel.hpp"

#include <Eigen/Dense>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rs::capture {
namespace {

// Axis-aligned box in a frame whose Y is up.
struct HullBox {
    glm::dvec3 low{0}, high{0};
};

struct Ray {
    glm::dvec3 origin, direction;
};

Ray middle_ray(const HullView& view) {
    const cv::Rect box = bounding_box(view.mask);
    return {view.camera.centre(), glm::normalize(view.camera.ray(box.x + 0.5 * box.width, box.y + 0.5 * box.height))};
}

// Rotation whose rows are the axes of a frame with Y along `up`.
glm::dmat3 upright_axes(const glm::dvec3& up) {
    const glm::dvec3 other = std::abs(up.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 z = glm::normalize(glm::cross(other, up));
    return glm::transpose(glm::dmat3(glm::cross(up, z), up, z));
}

// Half the side of a cube about the target that contains the object: 1.2 times a high quantile of half the diagonals of
// the masks' boxes, at the target's depth.
double first_extent(std::span<const HullView> views, const glm::dvec3& target) {
    std::vector<double> extents;
    for (const HullView& view : views) {
        const cv::Rect box = bounding_box(view.mask);
        const double depth = view.camera.project(target).z;
        if (depth > 0) extents.push_back(0.5 * std::hypot(box.width, box.height) / view.camera.fl_x * depth);
    }
    if (extents.empty()) return 0;
    const auto high = extents.begin() + static_cast<std::ptrdiff_t>(0.9 * static_cast<double>(extents.size() - 1));
    std::ranges::nth_element(extents, high);
    return 1.2 * *high;
}

bool is_in_hull(std::span<const HullView> views, const glm::dvec3& p, const HullCarving& carving) {
    int seen = 0, background = 0;
    const double most = carving.tolerated_views * static_cast<double>(views.size());
    for (const HullView& view : views) {
        if (background > most) return false;
        const glm::dvec3 at = view.camera.project(p);
        if (!(at.z > 0 && at.x >= 0 && at.y >= 0 && at.x < view.mask.cols && at.y < view.mask.rows)) continue;
        ++seen;
        background += view.mask(static_cast<int>(at.y), static_cast<int>(at.x)) == 0 ? 1 : 0;
    }
    return seen >= carving.min_views * static_cast<double>(views.size()) &&
           background <= carving.tolerated_views * seen;
}

// Sides of a voxel.
glm::dvec3 step_of(const HullBox& box, const HullCarving& carving) {
    return (box.high - box.low) / static_cast<double>(carving.voxels_per_side);
}

// Centres of the voxels of a box that are in the hull. `world_from_frame` rotates.
std::vector<glm::dvec3> carve(std::span<const HullView> views, const glm::dmat3& world_from_frame, const HullBox& box,
                              const HullCarving& carving) {
    const int side = carving.voxels_per_side;
    std::vector<std::vector<glm::dvec3>> slices(static_cast<std::size_t>(side));
    const glm::dvec3 step = step_of(box, carving);
    for_each_index(side, 0, [&](std::int64_t k) {
        for (int j = 0; j < side; ++j) {
            for (int i = 0; i < side; ++i) {
                const glm::dvec3 p = box.low + step * (glm::dvec3(i, j, static_cast<double>(k)) + 0.5);
                if (is_in_hull(views, world_from_frame * p, carving)) slices[static_cast<std::size_t>(k)].push_back(p);
            }
        }
    });
    std::vector<glm::dvec3> kept;
    for (const auto& slice : slices) kept.insert(kept.end(), slice.begin(), slice.end());
    return kept;
}

// Bounds of the kept voxels with a margin of one voxel.
HullBox bounds_of(const std::vector<glm::dvec3>& kept, const glm::dvec3& step) {
    HullBox bounds{glm::dvec3(std::numeric_limits<double>::max()), glm::dvec3(std::numeric_limits<double>::lowest())};
    for (const glm::dvec3& p : kept) {
        bounds.low = glm::min(bounds.low, p - 1.5 * step);
        bounds.high = glm::max(bounds.high, p + 1.5 * step);
    }
    return bounds;
}

// Smallest vertical cylinder that contains the voxels.
BoundingCylinder cylinder_of(const std::vector<glm::dvec3>& kept, const glm::dvec3& step) {
    std::vector<cv::Point2f> plan;
    double low = kept.front().y, high = low;
    // Float coordinates are relative to a voxel, in voxels: minEnclosingCircle() adds 1e-4 to the radius.
    const glm::dvec3 near = kept.front();
    const double unit = std::max(step.x, step.z);
    for (const glm::dvec3& p : kept) {
        plan.emplace_back(static_cast<float>((p.x - near.x) / unit), static_cast<float>((p.z - near.z) / unit));
        low = std::min(low, p.y - 0.5 * step.y);
        high = std::max(high, p.y + 0.5 * step.y);
    }
    std::vector<cv::Point2f> outline;
    cv::convexHull(plan, outline);
    cv::Point2f middle;
    float radius = 0;
    cv::minEnclosingCircle(outline, middle, radius);
    BoundingCylinder cylinder;
    cylinder.centre = {near.x + unit * static_cast<double>(middle.x), 0.5 * (low + high),
                       near.z + unit * static_cast<double>(middle.y)};
    cylinder.radius = unit * static_cast<double>(radius) + 0.5 * std::hypot(step.x, step.z);
    cylinder.height = high - low;
    return cylinder;
}

// Share of a mask's pixels farther than a voxel from the projected voxels.
double share_beyond(const HullView& view, const std::vector<glm::dvec3>& kept, const glm::dmat3& world_from_frame,
                    double voxel) {
    cv::Mat1b beyond = view.mask.clone();
    for (const glm::dvec3& p : kept) {
        const glm::dvec3 at = view.camera.project(world_from_frame * p);
        if (!(at.z > 0)) continue;
        const int reach = 2 + static_cast<int>(std::min(1.5 * voxel * view.camera.fl_x / at.z, 64.0));
        const cv::Rect square(static_cast<int>(glm::clamp(at.x, -1e6, 1e6)) - reach,
                              static_cast<int>(glm::clamp(at.y, -1e6, 1e6)) - reach, 2 * reach + 1, 2 * reach + 1);
        const cv::Rect inside = square & cv::Rect({0, 0}, beyond.size());
        if (!inside.empty()) beyond(inside) = 0;
    }
    return static_cast<double>(cv::countNonZero(beyond)) / cv::countNonZero(view.mask);
}

// Voxels in the frame; `middle` is the target there.
Result<VisualHull> carve_in_frame(std::span<const HullView> views, const glm::dvec3& middle,
                                  const glm::dmat3& frame_from_world, const HullCarving& last) {
    const double extent = first_extent(views, glm::transpose(frame_from_world) * middle);
    HullBox box{middle - extent, middle + extent};
    std::vector<glm::dvec3> kept;
    constexpr int kPasses = 3;
    HullCarving carving = last;
    carving.voxels_per_side = HullCarving{}.voxels_per_side;
    for (int pass = 0; pass < kPasses; ++pass) {
        if (pass > 0) box = bounds_of(kept, step_of(box, carving));
        if (pass == kPasses - 1) carving = last;
        kept = carve(views, glm::transpose(frame_from_world), box, carving);
        if (kept.empty()) {
            return Error{
                "the masks have no common volume: cameras and photos do not belong together, or the masks are wrong; "
                "check some masks, and that the poses are camera-to-world"};
        }
    }
    return VisualHull{std::move(kept), step_of(box, last)};
}

}  // namespace

Camera hull_camera(Camera camera) {
    const double scale = std::min(1.0, static_cast<double>(kHullMask_px) / std::max(camera.width, camera.height));
    const int width = std::max(1, static_cast<int>(std::lround(camera.width * scale)));
    const int height = std::max(1, static_cast<int>(std::lround(camera.height * scale)));
    const double by_x = static_cast<double>(width) / camera.width, by_y = static_cast<double>(height) / camera.height;
    camera.fl_x *= by_x;
    camera.cx *= by_x;
    camera.fl_y *= by_y;
    camera.cy *= by_y;
    camera.width = width;
    camera.height = height;
    return camera;
}

Result<glm::dvec3> common_target(std::span<const HullView> views) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const HullView& view : views) {
        const Ray ray = middle_ray(view);
        const Eigen::Vector3d d(ray.direction.x, ray.direction.y, ray.direction.z);
        const Eigen::Vector3d c(ray.origin.x, ray.origin.y, ray.origin.z);
        const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - d * d.transpose();
        sum += across;
        right += across * c;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sum / static_cast<double>(views.size()));
    constexpr double kMinSpread = 1e-3;  // mean squared sine between the rays
    if (!(solver.eigenvalues()[0] > kMinSpread)) {
        return Error{"all photos are taken from one direction; give photos from all around the object"};
    }
    const Eigen::Vector3d p = sum.ldlt().solve(right);
    return glm::dvec3(p.x(), p.y(), p.z());
}

std::size_t count_in_front(std::span<const HullView> views, const glm::dvec3& point) {
    return static_cast<std::size_t>(
        std::ranges::count_if(views, [&](const HullView& view) { return view.camera.project(point).z > 0; }));
}

Result<VisualHull> carve_visual_hull(std::span<const HullView> views, const glm::dvec3& target, const glm::dvec3& up,
                                     const HullCarving& carving) {
    const glm::dmat3 frame_from_world = upright_axes(up);
    RS_ASSIGN_OR_RETURN(VisualHull hull, carve_in_frame(views, frame_from_world * target, frame_from_world, carving));
    for (glm::dvec3& p : hull.voxels) p = glm::transpose(frame_from_world) * p;
    return hull;
}

Result<BoundingCylinder> carve_bounding_cylinder(std::span<const HullView> views, const glm::dvec3& target,
                                                 const glm::dvec3& up) {
    const glm::dmat3 frame_from_world = upright_axes(up);
    const glm::dmat3 world_from_frame = glm::transpose(frame_from_world);
    RS_ASSIGN_OR_RETURN(const VisualHull hull, carve_in_frame(views, frame_from_world * target, frame_from_world, {}));
    const std::vector<glm::dvec3>& kept = hull.voxels;
    const glm::dvec3& step = hull.step;
    BoundingCylinder cylinder = cylinder_of(kept, step);
    cylinder.beyond_hull.resize(views.size());
    for_each_index(std::ssize(views), 0, [&](std::int64_t i) {
        const auto view = static_cast<std::size_t>(i);
        cylinder.beyond_hull[view] =
            share_beyond(views[view], kept, world_from_frame, std::max({step.x, step.y, step.z}));
    });
    for (std::size_t i = 0; i < views.size(); ++i) {
        const glm::dvec3 off = frame_from_world * views[i].camera.centre() - cylinder.centre;
        if (std::hypot(off.x, off.z) < cylinder.radius && std::abs(off.y) < 0.5 * cylinder.height) {
            cylinder.cameras_inside.push_back(i);
        }
    }
    cylinder.centre = world_from_frame * cylinder.centre;
    return cylinder;
}

cv::Mat1b project_hull(const Camera& camera, const VisualHull& hull) {
    cv::Mat1b silhouette(camera.height, camera.width, std::uint8_t{0});
    const double side = std::max({hull.step.x, hull.step.y, hull.step.z});
    for (const glm::dvec3& p : hull.voxels) {
        const glm::dvec3 at = camera.project(p);
        if (!(at.z > 0 && at.x >= -64 && at.y >= -64 && at.x < camera.width + 64 && at.y < camera.height + 64))
            continue;
        const double reach = 0.5 * std::min(side * camera.fl_x / at.z, 64.0);
        const int left = static_cast<int>(std::floor(at.x - reach)), top = static_cast<int>(std::floor(at.y - reach));
        const int right = static_cast<int>(std::ceil(at.x + reach)), bottom = static_cast<int>(std::ceil(at.y + reach));
        const cv::Rect inside = cv::Rect(left, top, right - left, bottom - top) & cv::Rect({0, 0}, silhouette.size());
        if (!inside.empty()) silhouette(inside) = 255;
    }
    return silhouette;
}

}  // namespace rs::capture
