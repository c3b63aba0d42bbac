#include "compositor/scene/light/prefiltered_reflections.hpp"
#include "compositor/viewer/drawing/passes/geometry_passes.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/parallel.hpp"
#include "rayspace/image/linear_light.hpp"
#include "rayspace/light/directions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::compositor {
namespace {

constexpr int kFaceSide_px = 128;

struct CapturedFace {
    Camera camera;
    Image<Rgba8> image;
    std::vector<float> depths;  // 0 where nothing was drawn
};

// In the order +X, -X, +Y, -Y, +Z, -Z.
glm::dvec3 face_axis(std::size_t face) {
    glm::dvec3 axis(0);
    axis[static_cast<int>(face / 2)] = face % 2 == 0 ? 1 : -1;
    return axis;
}

CapturedFace capture_face(FrameContext& frame, const FrameTarget& target, const Camera& camera) {
    const FrameView view = view_of_frame(camera);
    target.drawn.begin(frame.background.zenith());
    frame.geometry.surfaces().draw_opaque(view, false, OpaqueMode::kSurroundings);
    if (frame.geometry.floor() != nullptr) frame.geometry.floor()->draw(view);
    if (!frame.background.plain()) frame.background.draw(camera, BackgroundArea::kBehindGeometry);
    frame.area_lights.draw(view, frame.fog);
    return {camera, target.drawn.read_image(),
            target.drawn.depths_at(0, 0, kFaceSide_px, kFaceSide_px, target.shown())};
}

Result<std::vector<CapturedFace>> capture_cube(FrameContext& frame) {
    const glm::dvec3 centre = frame.geometry.surfaces().reflective_bounds().middle();
    RS_ASSIGN_OR_RETURN(const auto target, FrameTarget::create(kFaceSide_px, kFaceSide_px, 1));
    std::vector<CapturedFace> faces;
    for (std::size_t face = 0; face < 6; ++face) {
        const Camera camera = look_at_camera(centre, centre + face_axis(face), 0.5 * kPi, kFaceSide_px, kFaceSide_px);
        faces.push_back(capture_face(frame, target, camera));
    }
    return faces;
}

// Mean radiance of the environment in one of the pixels of the reflection map.
glm::vec3 environment_radiance(const EnvironmentLight& light, int x, int y) {
    const Image<RgbaF>& map = *light.pixels;
    const float turn = light.turn_rad / (2 * kPiF);
    const int across = std::clamp(map.width() / kReflectionWidth, 1, 16);
    glm::vec3 sum(0);
    for (int i = 0; i < across * across; ++i) {
        const glm::vec2 inside = (glm::vec2(i % across, i / across) + 0.5F) / static_cast<float>(across);
        sum += radiance_in_map(map, {(static_cast<float>(x) + inside.x) / kReflectionWidth + turn,
                                     (static_cast<float>(y) + inside.y) / kReflectionHeight});
    }
    return sum * (light.scale / static_cast<float>(across * across));
}

glm::vec3 surroundings_at(const std::vector<CapturedFace>& cube, const EnvironmentLight* environment, int x, int y) {
    const glm::dvec3 d = direction_in_map(glm::vec2(x, y) + 0.5F, {kReflectionWidth, kReflectionHeight});
    const glm::dvec3 a = glm::abs(d);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    const CapturedFace& face = cube[static_cast<std::size_t>(2 * axis + (d[axis] < 0 ? 1 : 0))];
    const glm::dvec3 at = face.camera.project(face.camera.centre() + d);
    const int column = std::clamp(static_cast<int>(at.x), 0, kFaceSide_px - 1);
    const int row = std::clamp(static_cast<int>(at.y), 0, kFaceSide_px - 1);
    if (environment != nullptr && face.depths[static_cast<std::size_t>(row * kFaceSide_px + column)] == 0) {
        return environment_radiance(*environment, x, y);
    }
    const Rgba8 p = face.image(column, row);
    return {linear_from_srgb8(p.r), linear_from_srgb8(p.g), linear_from_srgb8(p.b)};
}

}  // namespace

Status ReflectionPass::run(FrameContext& frame) {
    SurfaceRenderer& surfaces = frame.geometry.surfaces();
    // Under a traced image only transparent surfaces are lit.
    const bool lights_something = frame.traced == nullptr || surfaces.has_transparent();
    if (captured_ || !lights_something || surfaces.reflective_bounds().empty()) return {};
    RS_ASSIGN_OR_RETURN(const auto cube, capture_cube(frame));
    const auto& environment = frame.geometry.environment();
    Image<RgbaF> radiance(kReflectionWidth, kReflectionHeight);
    for_each_index(kReflectionHeight, 0, [&](std::int64_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < kReflectionWidth; ++x) {
            constexpr float kMaxHalf = 65504;
            const glm::vec3 c = glm::min(surroundings_at(cube, environment ? &*environment : nullptr, x, y), kMaxHalf);
            radiance(x, y) = {c.r, c.g, c.b, 1};
        }
    });
    surfaces.set_reflections(prefilter_reflections(std::move(radiance)));
    captured_ = true;
    return {};
}

}  // namespace rs::compositor
