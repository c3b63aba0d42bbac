#include "engine/core/definition/view_registers.hpp"

#include "engine/core/definition/ring_choice.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/ray_space.hpp"
#include "rayspace/geometry/ring_axes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

namespace rs::engine {
namespace {

constexpr double kMaxViewpointDistance = 200;  // object radii; farther viewpoints are moved to it
// Bound of N, T, S. The margin to 8 covers the rounding over a whole view, and N^2 + T^2 stays within 63 bits.
constexpr double kLargestDirection = 8 - 1.0 / 1024;
constexpr double kLargestRowStep = 2;  // bound of sy
// Views of at least kSharpFrom times the scale of the captured images are sharpened, of at most kSmoothUpTo smoothed.
constexpr double kSharpFrom = 0.95;
constexpr double kSmoothUpTo = 0.75;

std::int64_t fixed(double value, int fractional_bits) {
    return std::llround(std::ldexp(value, fractional_bits));
}

Error view_error(const std::string& what) {
    return Error{"view: " + what};
}

// Moves a distant camera to kMaxViewpointDistance on the line to the origin. Points near the origin keep their pixels:
// the focal length is scaled with the distance, and the principal point is moved so that the origin keeps its pixel.
Camera limit_viewpoint_distance(Camera camera) {
    const glm::dvec3 centre = camera.centre();
    const double distance = glm::length(centre);
    if (distance <= kMaxViewpointDistance) return camera;
    const double scale = kMaxViewpointDistance / distance;
    const double depth = -glm::dot(centre, camera.forward());
    if (depth > 0) {
        camera.cx += camera.fl_x * (1 - scale) * -glm::dot(centre, camera.right()) / depth;
        camera.cy -= camera.fl_y * (1 - scale) * -glm::dot(centre, camera.up()) / depth;
    }
    camera.fl_x *= scale;
    camera.fl_y *= scale;
    camera.world_from_camera[3] = glm::dvec4(centre * scale, 1);
    return camera;
}

// Linear form of direction . axis over the pixels of the camera; empty if it is out of range at a corner.
std::optional<LinearForm> form_along(const Camera& camera, const glm::dvec3& axis) {
    const glm::dvec3 origin = camera.ray(0.5, 0.5);
    const glm::dvec3 per_column = camera.right() / camera.fl_x;
    const glm::dvec3 per_row = -camera.up() / camera.fl_y;
    for (const int i : {0, camera.width - 1}) {
        for (const int j : {0, camera.height - 1}) {
            const double value = glm::dot(origin + double(i) * per_column + double(j) * per_row, axis);
            if (!(std::abs(value) < kLargestDirection)) return std::nullopt;
        }
    }
    if (!(std::abs(glm::dot(per_column, axis)) < kLargestDirection) ||
        !(std::abs(glm::dot(per_row, axis)) < kLargestDirection)) {
        return std::nullopt;
    }
    return LinearForm{fixed(glm::dot(origin, axis), 32), fixed(glm::dot(per_column, axis), 32),
                      fixed(glm::dot(per_row, axis), 32)};
}

// The same bounds for a given form.
bool is_in_range(const LinearForm& form, int width, int height) {
    const auto largest = static_cast<std::int64_t>(std::ldexp(kLargestDirection, 32)) + (std::int64_t{1} << 14);
    const auto fits = [&](std::int64_t value) { return value > -largest && value < largest; };
    if (!fits(form.at_origin) || !fits(form.per_column) || !fits(form.per_row)) return false;
    for (const int i : {0, width - 1}) {
        for (const int j : {0, height - 1}) {
            if (!fits(form.at(i, j))) return false;
        }
    }
    return true;
}

// Pixels per object radius at the axis in the view, relative to the captured images.
double magnification(const RaySpaceObject& object, const Ring& ring, const Camera& camera) {
    const CapturedView& captured = object.views[ring.views.front()];
    const double distance = std::ldexp(std::hypot(captured.lines.front().l0_q20, captured.height_q20), -20);
    const double captured_px = std::ldexp(captured.fl_y_q16, -16) / distance;
    return camera.fl_y / glm::length(camera.centre()) / captured_px;
}

TexelFilter best_filter(const RaySpaceObject& object, const Ring& ring, const Camera& camera) {
    const double scale = magnification(object, ring, camera);
    if (scale >= kSharpFrom) return TexelFilter::kSharp;
    return scale <= kSmoothUpTo ? TexelFilter::kSmooth : TexelFilter::kBilinear;
}

// Viewpoint of prepare_view in object radii: the camera's centre, moved to at most 200 radii.
glm::dvec3 prepared_viewpoint(const RaySpaceObject& object, const Camera& camera) {
    const glm::dvec3 centre = camera.centre() / object.units_per_radius;
    return centre * std::min(1.0, kMaxViewpointDistance / glm::length(centre));
}

}  // namespace

bool ViewRegisters::upright() const {
    return rise.per_column == 0 && std::all_of(planes.begin(), planes.end(), [](const PlaneRegisters& plane) {
               return plane.along_normal.per_row == 0 && plane.along_tangent.per_row == 0;
           });
}

Status check_registers(const RaySpaceObject& object, const ViewRegisters& r) {
    if (r.width < 1 || r.height < 1 || r.width > kMaxImageSide_px || r.height > kMaxImageSide_px) {
        return view_error("its size of " + std::to_string(r.width) + "x" + std::to_string(r.height) +
                          " is outside 1.." + std::to_string(kMaxImageSide_px) + " pixels");
    }
    if (r.ring < 0 || static_cast<std::size_t>(r.ring) >= object.rings.size()) {
        return view_error("ring " + std::to_string(r.ring) + " does not exist; the object has " +
                          std::to_string(object.rings.size()) + " rings");
    }
    if (static_cast<int>(r.filter) > static_cast<int>(TexelFilter::kSmooth)) {
        return view_error("its filter is unknown; use 0 (bilinear), 1 (sharp) or 2 (smooth)");
    }
    const auto planes = static_cast<std::size_t>(object.rings[static_cast<std::size_t>(r.ring)].planes);
    if (r.planes.size() != planes) {
        return view_error("it has registers for " + std::to_string(r.planes.size()) + " planes; the ring has " +
                          std::to_string(planes));
    }
    const auto place_fits = [](std::int32_t q20) { return q20 > -(1 << 28) && q20 < (1 << 28); };
    if (!place_fits(r.b_q20)) return view_error("register b is out of range");
    if (!is_in_range(r.rise, r.width, r.height) ||
        std::abs(r.rise.per_row) >= static_cast<std::int64_t>(std::ldexp(kLargestRowStep, 32))) {
        return view_error("registers s0, sx, sy are out of range");
    }
    for (std::size_t k = 0; k < planes; ++k) {
        const PlaneRegisters& plane = r.planes[k];
        if (!place_fits(plane.a_q20) || !place_fits(plane.c_q20) ||
            !is_in_range(plane.along_normal, r.width, r.height) ||
            !is_in_range(plane.along_tangent, r.width, r.height)) {
            return view_error("a register of plane " + std::to_string(k) + " is out of range");
        }
    }
    return {};
}

namespace {

// The camera in object radii, at most kMaxViewpointDistance away.
Result<Camera> camera_in_radii(const RaySpaceObject& object, const Camera& camera_in_rig) {
    if (object.rings.empty()) return view_error("the object has no ring of views");
    if (camera_in_rig.width < 1 || camera_in_rig.height < 1 || camera_in_rig.width > kMaxImageSide_px ||
        camera_in_rig.height > kMaxImageSide_px) {
        return view_error("its size of " + std::to_string(camera_in_rig.width) + "x" +
                          std::to_string(camera_in_rig.height) + " is outside 1.." + std::to_string(kMaxImageSide_px) +
                          " pixels");
    }
    if (!(camera_in_rig.fl_x > 0) || !(camera_in_rig.fl_y > 0)) return view_error("its focal length must be above 0");
    if (!(rotation_error(camera_in_rig) < 1e-3))
        return view_error("its camera matrix is not a rotation and a position");

    Camera camera = camera_in_rig;
    camera.world_from_camera[3] = glm::dvec4(camera.centre() / object.units_per_radius, 1);
    if (!std::isfinite(glm::length(camera.centre())) || !std::isfinite(camera.cx) || !std::isfinite(camera.cy)) {
        return view_error("its camera has parameters that are not finite");
    }
    return limit_viewpoint_distance(camera);
}

// Registers of a view by one ring. `is_narrowed`: the viewpoint was moved, and the field of view narrowed.
Result<ViewRegisters> registers_of_ring(const RaySpaceObject& object, const Camera& in_object, int ring_index,
                                        bool is_narrowed, std::optional<TexelFilter> filter) {
    const Ring& ring = object.rings[static_cast<std::size_t>(ring_index)];
    const Camera camera = in_ring_axes(in_object, ring.rotation);
    ViewRegisters registers;
    registers.width = camera.width;
    registers.height = camera.height;
    registers.ring = ring_index;
    if (!ring.shape.empty()) registers.filter = filter.value_or(best_filter(object, ring, camera));
    registers.b_q20 = static_cast<std::int32_t>(fixed(camera.centre().y, 20));

    const std::string too_wide =
        is_narrowed
            ? "the object covers only a few pixels at this distance and field of view; narrow the field of view"
            : "its field of view is too wide (a ray deviates from the viewing axis by a tangent of more than 8); use a "
              "longer focal length";
    const auto rise = form_along(camera, {0, 1, 0});
    if (!rise || std::abs(camera.up().y / camera.fl_y) >= kLargestRowStep) return view_error(too_wide);
    registers.rise = *rise;
    for (int k = 0; k < ring.planes; ++k) {
        const ReferencePlane plane = reference_plane(k, ring.planes);
        const ViewpointLine line = viewpoint_line(camera.centre(), plane);
        const auto along_normal = form_along(camera, plane.normal);
        const auto along_tangent = form_along(camera, plane.tangent);
        if (!along_normal || !along_tangent) return view_error(too_wide);
        registers.planes.push_back({static_cast<std::int32_t>(fixed(line.a, 20)),
                                    static_cast<std::int32_t>(fixed(line.c, 20)), *along_normal, *along_tangent});
    }
    return registers;
}

}  // namespace

Result<ViewRegisters> prepare_view(const RaySpaceObject& object, const Camera& camera_in_rig,
                                   std::optional<TexelFilter> filter) {
    RS_ASSIGN_OR_RETURN(const Camera camera, camera_in_radii(object, camera_in_rig));
    return registers_of_ring(object, camera, choose_rings(object, camera.centre()).nearest,
                             camera.fl_x < camera_in_rig.fl_x, filter);
}

Result<MixedView> prepare_mixed_view(const RaySpaceObject& object, const Camera& camera_in_rig,
                                     std::optional<TexelFilter> filter) {
    RS_ASSIGN_OR_RETURN(const Camera camera, camera_in_radii(object, camera_in_rig));
    const RingChoice rings = choose_rings(object, camera.centre());
    const auto registers = [&](int ring) {
        return registers_of_ring(object, camera, ring, camera.fl_x < camera_in_rig.fl_x, filter);
    };
    MixedView view;
    RS_ASSIGN_OR_RETURN(view.nearest, registers(rings.nearest));
    if (rings.second < 0) return view;
    RS_ASSIGN_OR_RETURN(view.second, registers(rings.second));
    view.weight_q8 = rings.weight_q8;
    return view;
}

DepthScale depth_scale(const RaySpaceObject& object, const Camera& camera) {
    const glm::dvec3 centre = camera.centre() / object.units_per_radius;
    return {glm::dot(prepared_viewpoint(object, camera) - centre, camera.forward()), object.units_per_radius};
}

Image<float> depth_image(const RaySpaceObject& object, const Camera& camera, ConstImageView<std::int32_t> lambda_q20) {
    const DepthScale scale = depth_scale(object, camera);
    Image<float> depth(lambda_q20.width(), lambda_q20.height());
    for (int j = 0; j < depth.height(); ++j) {
        for (int i = 0; i < depth.width(); ++i) {
            const std::int32_t lambda = lambda_q20(i, j);
            if (lambda == 0) continue;
            depth(i, j) = static_cast<float>((std::ldexp(static_cast<double>(lambda), -20) + scale.to_viewpoint) *
                                             scale.units_per_radius);
        }
    }
    return depth;
}

}  // namespace rs::engine
