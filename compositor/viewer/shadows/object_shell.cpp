#include "compositor/viewer/shadows/object_shell.hpp"

#include "compositor/viewer/views/screen_rectangle.hpp"
#include "engine/core/definition/view_registers.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/parallel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace rs::compositor {
namespace {

constexpr int kAround = 12;             // views per elevation
constexpr std::size_t kElevations = 3;  // at most
constexpr double kSteepest_rad = kPi / 3;
constexpr double kDistance = 6;    // of the viewpoint from the axis, object radii
constexpr double kAcross_px = 64;  // larger side of the bounds in the image
constexpr int kFrame_px = 2048;    // larger than any view
constexpr std::uint8_t kSolidAlpha = 128;
constexpr double kJump_px = 8;  // depth step between neighbours that separates surfaces, in pixel footprints

struct ShellView {
    Camera camera;  // object radii
    Image<Rgba8> image;
    Image<float> depths;  // object radii; 0 if none

    [[nodiscard]] bool solid(int x, int y) const { return image(x, y).a >= kSolidAlpha && depths(x, y) > 0; }
    [[nodiscard]] glm::dvec3 point(double x, double y, double depth) const {
        return camera.centre() + depth * camera.ray(x, y);
    }
    // True if the view shows the object at the point's projection or at a neighbouring pixel.
    [[nodiscard]] bool may_hold(const glm::dvec3& p) const {
        const glm::dvec3 at = camera.project(p);
        if (!(at.z > 0)) return false;
        const int column = static_cast<int>(std::floor(at.x));
        const int row = static_cast<int>(std::floor(at.y));
        for (int y = std::max(row - 1, 0); y <= std::min(row + 1, image.height() - 1); ++y) {
            for (int x = std::max(column - 1, 0); x <= std::min(column + 1, image.width() - 1); ++x) {
                if (image(x, y).a >= kSolidAlpha) return true;
            }
        }
        return false;
    }
};

// Level camera, so that the engine renders it by columns; the object may be off the image centre.
std::optional<ShellView> view_from(const ViewableObject& object, double azimuth_rad, double elevation_rad) {
    const BoundingCylinder& bounds = object.bounds;
    const double side = std::max({2 * bounds.radius, bounds.top - bounds.bottom, 1e-6});
    const double level = kDistance * std::cos(elevation_rad);
    const glm::dvec3 back(std::sin(azimuth_rad), 0, std::cos(azimuth_rad));
    const glm::dvec3 up(0, 1, 0);
    const glm::dvec3 eye =
        level * back + (0.5 * (bounds.top + bounds.bottom) + kDistance * std::sin(elevation_rad)) * up;
    ShellView view;
    Camera& camera = view.camera;
    camera.width = camera.height = kFrame_px;
    camera.fl_x = camera.fl_y = kAcross_px * level / side;
    camera.cx = camera.cy = kFrame_px / 2.0;
    camera.world_from_camera =
        glm::dmat4(glm::dvec4(glm::cross(up, back), 0), glm::dvec4(up, 0), glm::dvec4(back, 0), glm::dvec4(eye, 1));
    const auto covered = covering_rectangle(bounds, camera);
    if (!covered) return std::nullopt;
    camera.width = covered->width;
    camera.height = covered->height;
    camera.cx -= covered->x;
    camera.cy -= covered->y;
    const RaySpaceObject& description = object.renderer.object();
    Camera in_rig = camera;
    in_rig.world_from_camera[3] = glm::dvec4(eye * description.units_per_radius, 1);
    const auto registers = engine::prepare_view(description, in_rig);
    if (!registers) return std::nullopt;
    view.image = Image<Rgba8>(camera.width, camera.height);
    Image<std::int32_t> lambda(camera.width, camera.height);
    object.renderer.render(*registers, view.image.view(), lambda.view());
    view.depths = engine::depth_image(description, in_rig, lambda);
    for (float& depth : view.depths.pixels()) depth /= static_cast<float>(description.units_per_radius);
    return view;
}

// Elevations of the capture rings, at most kElevations: the lowest, the highest and those between.
std::vector<double> elevations_of(const RaySpaceObject& object) {
    std::vector<double> all;
    for (const Ring& ring : object.rings) {
        if (!ring.rotation.is_identity()) continue;
        all.push_back(std::clamp(radians(ring.elevation_udeg * 1e-6), -kSteepest_rad, kSteepest_rad));
    }
    std::ranges::sort(all);
    if (all.size() <= kElevations) return all;
    return {all.front(), all[all.size() / 2], all.back()};
}

class ShellBuilder {
public:
    explicit ShellBuilder(std::vector<ShellView> views) : views_(std::move(views)) {}

    ObjectShell make() {
        for (const ShellView& view : views_) add(view);
        return std::move(shell_);
    }

private:
    std::uint32_t add_corner(const glm::dvec3& p) {
        shell_.corners.emplace_back(p);
        return static_cast<std::uint32_t>(shell_.corners.size() - 1);
    }

    void add_triangles(std::initializer_list<std::uint32_t> corners) {
        shell_.triangles.insert(shell_.triangles.end(), corners);
    }

    [[nodiscard]] bool in_hull(const glm::dvec3& p) const {
        return std::ranges::all_of(views_, [&](const ShellView& view) { return view.may_hold(p); });
    }

    void add(const ShellView& view) {
        constexpr std::uint32_t kNone = ~0U;
        const int width = view.image.width();
        const int height = view.image.height();
        Image<std::uint32_t> corners(width, height, kNone);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                if (!view.solid(x, y)) continue;
                const glm::dvec3 p = view.point(x + 0.5, y + 0.5, view.depths(x, y));
                if (in_hull(p)) corners(x, y) = add_corner(p);
            }
        }
        Image<std::uint8_t> squares(width, height, 0);  // number of squares of one surface around each pixel
        for (int y = 0; y + 1 < height; ++y) {
            for (int x = 0; x + 1 < width; ++x) {
                const std::array<glm::ivec2, 4> at{{{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}};
                if (!std::ranges::all_of(at, [&](const glm::ivec2& p) { return corners(p.x, p.y) != kNone; })) continue;
                const auto [nearest, farthest] = std::minmax(
                    {view.depths(x, y), view.depths(x + 1, y), view.depths(x + 1, y + 1), view.depths(x, y + 1)});
                if (farthest - nearest > kJump_px * nearest / view.camera.fl_x) continue;
                for (const glm::ivec2& p : at) ++squares(p.x, p.y);
                const std::uint32_t first = corners(x, y);
                const std::uint32_t opposite = corners(x + 1, y + 1);
                add_triangles({first, corners(x + 1, y), opposite, first, opposite, corners(x, y + 1)});
            }
        }
        // Edges and thin features.
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                if (corners(x, y) != kNone && squares(x, y) < 4) add_square(view, x, y);
            }
        }
    }

    void add_square(const ShellView& view, int x, int y) {
        const double depth = view.depths(x, y);
        const std::uint32_t a = add_corner(view.point(x, y, depth));
        const std::uint32_t b = add_corner(view.point(x + 1, y, depth));
        const std::uint32_t c = add_corner(view.point(x + 1, y + 1, depth));
        const std::uint32_t d = add_corner(view.point(x, y + 1, depth));
        add_triangles({a, b, c, a, c, d});
    }

    std::vector<ShellView> views_;
    ObjectShell shell_;
};

}  // namespace

ObjectShell object_shell(const ViewableObject& object) {
    if (object.bounds.empty()) return {};
    const std::vector<double> elevations = elevations_of(object.renderer.object());
    std::vector<std::optional<ShellView>> made(elevations.size() * kAround);
    for_each_index(static_cast<std::int64_t>(made.size()), 0, [&](std::int64_t i) {
        const double azimuth = 2 * kPi * static_cast<double>(i % kAround) / kAround;
        made[static_cast<std::size_t>(i)] =
            view_from(object, azimuth, elevations[static_cast<std::size_t>(i / kAround)]);
    });
    std::vector<ShellView> views;
    for (std::optional<ShellView>& view : made) {
        if (view) views.push_back(std::move(*view));
    }
    return ShellBuilder(std::move(views)).make();
}

}  // namespace rs::compositor
