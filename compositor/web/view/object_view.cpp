#include "compositor/web/view/object_view.hpp"

#include "compositor/viewer/views/upright_image.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/geometry/ring_axes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::web {
namespace {

constexpr std::int64_t kDecodedBudget_bytes = std::int64_t{320} << 20;
constexpr double kUprightTolerance_rad = 1e-9;

// Everything that the photos show: the captured frame at the axis, as a cylinder.
compositor::BoundingCylinder bounds_of(const CapturedCamera& captured) {
    const double half_height = captured.tan_half_y * (captured.distance + 1) / std::cos(captured.elevation_rad);
    return {1.02, captured.target_height - half_height, captured.target_height + half_height};
}

// Camera of a stored photo.
struct UprightPhoto {
    glm::dvec3 eye{0};
    double axis_depth = 0;
    double fl_x = 0;
    double fl_y = 0;
    double cy = 0;
};

// Follows from a line of the photo (rayspace/api/types/ray_space_object.hpp), best from the one of the plane that the
// photo faces: with the plane's tangent t it has l1 = t . forward, q1 = fl_x * t . right, l0 = -eye . forward and
// q0 = -fl_x * eye . right.
UprightPhoto photo_of(const RaySpaceObject& object, const Ring& ring, std::uint16_t number) {
    const CapturedView& view = object.views[number];
    const auto faces_less = [](const CapturedLine& a, const CapturedLine& b) {
        return std::abs(a.q1_q16) < std::abs(b.q1_q16);
    };
    const auto line = std::max_element(view.lines.begin(), view.lines.end(), faces_less);
    const double turn = 2 * kPi * static_cast<double>(line - view.lines.begin()) / ring.planes;
    const glm::dvec3 tangent(std::cos(turn), 0, -std::sin(turn));
    const double along_forward = std::ldexp(line->l1_q30, -30);
    const double along_right =
        std::copysign(std::sqrt(std::max(1e-6, 1 - along_forward * along_forward)), static_cast<double>(line->q1_q16));
    const glm::dvec3 forward(along_forward * tangent.x + along_right * tangent.z, 0,
                             along_forward * tangent.z - along_right * tangent.x);
    const glm::dvec3 right(-forward.z, 0, forward.x);
    UprightPhoto photo;
    photo.axis_depth = std::ldexp(line->l0_q20, -20);
    photo.fl_x = std::ldexp(line->q1_q16, -16) / along_right;
    photo.fl_y = std::ldexp(view.fl_y_q16, -16);
    photo.cy = std::ldexp(view.cy_q16, -16);
    photo.eye = -photo.axis_depth * forward - std::ldexp(line->q0_q16, -16) / photo.fl_x * right;
    photo.eye.y = std::ldexp(view.height_q20, -20);
    return photo;
}

}  // namespace

double photo_azimuth_rad(const RaySpaceObject& object, const Ring& ring, std::uint16_t view) {
    const UprightPhoto photo = photo_of(object, ring, view);
    return std::atan2(photo.eye.x, photo.eye.z);
}

std::vector<CapturedCamera> captured_cameras(const RaySpaceObject& object) {
    const UprightPhoto first = photo_of(object, object.rings.front(), object.rings.front().views.front());
    const double target_height = first.eye.y + first.axis_depth * (first.cy - object.height / 2.0) / first.fl_y;
    std::vector<CapturedCamera> cameras;
    for (const Ring& ring : object.rings) {
        UprightPhoto photo =
            photo_of(object, ring, ring.views[ring.rotation.is_identity() ? 0 : ring.views.size() / 2]);
        photo.eye = glm::transpose(ring_from_object(ring.rotation)) * photo.eye;
        const double level = std::hypot(photo.eye.x, photo.eye.z);
        const double above = photo.eye.y - target_height;
        cameras.push_back({.distance = std::hypot(level, above),
                           .elevation_rad = std::atan2(above, level),
                           .azimuth_rad = std::atan2(photo.eye.x, photo.eye.z),
                           .target_height = target_height,
                           .tan_half_x = object.width / (2 * photo.fl_x),
                           .tan_half_y = object.height / (2 * photo.fl_y)});
    }
    return cameras;
}

ObjectView::ObjectView(engine::Renderer renderer)
    : renderer_(std::move(renderer)), captured_(captured_cameras(renderer_.object())) {}

Result<ObjectView> ObjectView::open(std::vector<std::byte> file, const std::string& name, int max_level) {
    RS_ASSIGN_OR_RETURN(const ContainerReader container, ContainerReader::over(std::move(file), name));
    RS_ASSIGN_OR_RETURN(
        RaySpaceObject object,
        read_object(container, {.max_level = max_level, .memory_cap_bytes = kPageMemoryCap_bytes, .decode = false}));
    RS_ASSIGN_OR_RETURN(engine::Renderer renderer,
                        engine::Renderer::create(std::move(object), {.decoded_budget_bytes = kDecodedBudget_bytes}));
    return ObjectView(std::move(renderer));
}

Result<ObjectView> ObjectView::create(RaySpaceObject object) {
    RS_ASSIGN_OR_RETURN(engine::Renderer renderer,
                        engine::Renderer::create(std::move(object), {.decoded_budget_bytes = kDecodedBudget_bytes,
                                                                     .arrival = engine::ImageArrival::later}));
    return ObjectView(std::move(renderer));
}

Camera ObjectView::camera_of(const OrbitView& view) const {
    const CapturedCamera& captured = captured_.front();
    const double level = view.distance * std::cos(view.elevation_rad);
    const glm::dvec3 target(0, captured.target_height, 0);
    const glm::dvec3 eye =
        target + glm::dvec3(level * std::sin(view.azimuth_rad), view.distance * std::sin(view.elevation_rad),
                            level * std::cos(view.azimuth_rad));
    // The larger of both angles of view is used, so that the whole captured frame fits.
    const double tan_half = std::max(captured.tan_half_x, captured.tan_half_y * view.width / view.height);
    Camera camera = look_at_camera(eye, target, 2 * std::atan(tan_half), view.width, view.height);
    if (std::abs(view.elevation_rad) < kUprightTolerance_rad) camera.world_from_camera[1] = {0, 1, 0, 0};
    return camera;
}

Result<PreparedView> ObjectView::prepare(const OrbitView& view) const {
    if (view.width < 1 || view.height < 1 || view.width > kMaxImageSide_px || view.height > kMaxImageSide_px) {
        return Error{"view: its size must be 1.." + std::to_string(kMaxImageSide_px) + " pixels"};
    }
    if (!(view.distance > 0) || !(std::abs(view.elevation_rad) < kPi / 2) || !std::isfinite(view.azimuth_rad)) {
        return Error{"view: its camera has parameters that are out of range"};
    }
    const double unit = object().units_per_radius;
    const auto in_rig = [&](Camera camera) {
        camera.world_from_camera[3] = glm::dvec4(camera.centre() * unit, 1);
        return camera;
    };
    PreparedView prepared;
    const Camera camera = camera_of(view);
    const compositor::ScreenRectangle whole{0, 0, view.width, view.height};
    auto upright =
        is_upright(camera) ? std::nullopt : compositor::upright_image(camera, whole, bounds_of(captured_.front()), 1);
    if (upright) prepared.rows = sampled_rows(upright->image_from_screen, view.width, view.height);
    if (!prepared.rows) upright.reset();
    RS_ASSIGN_OR_RETURN(prepared.rings,
                        engine::prepare_mixed_view(object(), in_rig(upright ? upright->camera : camera)));
    if (prepared.rings.second && !renderer_.has_images(prepared.rings.second->ring)) {
        prepared.rings = {std::move(prepared.rings.nearest), {}, 0};
    }
    return prepared;
}

Status ObjectView::render(const OrbitView& view) {
    RS_ASSIGN_OR_RETURN(const PreparedView prepared, prepare(view));
    image_ = Image<Rgba8>(view.width, view.height);
    lambda_q20_ = {};
    if (!prepared.rows) {
        renderer_.render(prepared.rings, image_);
        return {};
    }
    Image<Rgba8> level(prepared.rings.nearest.width, prepared.rings.nearest.height);
    renderer_.render(prepared.rings, level);
    resample(level, *prepared.rows, image_);
    return {};
}

Status ObjectView::render_registers(const engine::ViewRegisters& registers) {
    RS_TRY(engine::check_registers(object(), registers));
    image_ = Image<Rgba8>(registers.width, registers.height);
    lambda_q20_ = Image<std::int32_t>(registers.width, registers.height);
    renderer_.render(registers, image_, lambda_q20_);
    return {};
}

}  // namespace rs::web
