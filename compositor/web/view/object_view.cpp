#include "compositor/web/view/object_view.hpp"

#include "compositor/viewer/views/upright_image.hpp"
#include "engine/core/definition/view_registers.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/format/object_file.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::web {
namespace {

constexpr std::int64_t kDecodedBudget_bytes = std::int64_t{320} << 20;
constexpr double kUprightTolerance_rad = 1e-9;

// Bilinear sample of an image with straight alpha, weighted by alpha; transparent outside.
Rgba8 sample_bilinear(ConstImageView<Rgba8> image, double x, double y) {
    const double left = std::floor(x - 0.5);
    const double top = std::floor(y - 0.5);
    if (!(left >= -1 && top >= -1 && left < image.width() && top < image.height())) return {};
    const auto fraction_x = static_cast<std::uint32_t>((x - 0.5 - left) * 256);
    const auto fraction_y = static_cast<std::uint32_t>((y - 0.5 - top) * 256);
    std::uint32_t r = 0;
    std::uint32_t g = 0;
    std::uint32_t b = 0;
    std::uint32_t a = 0;
    for (int n = 0; n < 4; ++n) {
        const int column = static_cast<int>(left) + (n & 1);
        const int row = static_cast<int>(top) + (n >> 1);
        if (column < 0 || row < 0 || column >= image.width() || row >= image.height()) continue;
        const Rgba8 p = image(column, row);
        const std::uint32_t weight =
            ((n & 1) != 0 ? fraction_x : 256 - fraction_x) * ((n & 2) != 0 ? fraction_y : 256 - fraction_y) * p.a >> 8;
        r += weight * p.r;
        g += weight * p.g;
        b += weight * p.b;
        a += weight;
    }
    if (a == 0) return {};
    const auto channel = [&](std::uint32_t sum) { return static_cast<std::uint8_t>((sum + a / 2) / a); };
    return {channel(r), channel(g), channel(b), static_cast<std::uint8_t>((a + 128) >> 8)};
}

void warp(ConstImageView<Rgba8> from, const glm::dmat3& from_screen, ImageView<Rgba8> to) {
    for (int j = 0; j < to.height(); ++j) {
        glm::dvec3 at = from_screen * glm::dvec3(0.5, j + 0.5, 1);
        for (int i = 0; i < to.width(); ++i) {
            to(i, j) = at.z > 0 ? sample_bilinear(from, at.x / at.z, at.y / at.z) : Rgba8{};
            at += from_screen[0];
        }
    }
}

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

// Level camera whose image is resampled; nullopt if the camera itself is upright.
std::optional<compositor::UprightImage> upright_source(const Camera& camera, const CapturedCamera& captured) {
    if (is_upright(camera)) return std::nullopt;
    const compositor::ScreenRectangle whole{0, 0, camera.width, camera.height};
    return compositor::upright_image(camera, whole, bounds_of(captured), 1);
}

Status check_view(const OrbitView& view) {
    if (view.width < 1 || view.height < 1 || view.width > kMaxImageSide_px || view.height > kMaxImageSide_px) {
        return Error{"view: its size must be 1.." + std::to_string(kMaxImageSide_px) + " pixels"};
    }
    if (!(view.distance > 0) || !(std::abs(view.elevation_rad) < kPi / 2) || !std::isfinite(view.azimuth_rad)) {
        return Error{"view: its camera has parameters that are out of range"};
    }
    return {};
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
        const UprightPhoto photo = photo_of(object, ring, ring.views.front());
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

Result<engine::ViewRegisters> ObjectView::registers_of(const Camera& camera) const {
    Camera in_rig = camera;
    in_rig.world_from_camera[3] = glm::dvec4(camera.centre() * object().units_per_radius, 1);
    return engine::prepare_view(object(), in_rig);
}

Result<engine::ViewRegisters> ObjectView::upright_registers(const OrbitView& view) const {
    RS_TRY(check_view(view));
    const Camera camera = camera_of(view);
    const auto upright = upright_source(camera, captured_.front());
    return registers_of(upright ? upright->camera : camera);
}

Status ObjectView::render(const OrbitView& view) {
    RS_TRY(check_view(view));
    const Camera camera = camera_of(view);
    image_ = Image<Rgba8>(view.width, view.height);
    lambda_q20_ = {};
    const auto upright = upright_source(camera, captured_.front());
    RS_ASSIGN_OR_RETURN(const engine::ViewRegisters registers, registers_of(upright ? upright->camera : camera));
    if (!upright) {
        renderer_.render(registers, image_);
        return {};
    }
    Image<Rgba8> level(upright->camera.width, upright->camera.height);
    renderer_.render(registers, level);
    warp(level, upright->image_from_screen, image_);
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
