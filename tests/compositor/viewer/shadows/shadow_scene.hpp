#pragma once
// Scenes for comparing shadow maps with traced shadows.

#include "compositor/scene/scene.hpp"
#include "compositor/traced/traced_renderer.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "rayspace/image/linear_light.hpp"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace rs::test {

inline compositor::GeometryNode matte_box(const glm::dvec3& size, const glm::dvec3& at, double turn_rad = 0) {
    compositor::GeometryNode node;
    auto mesh = std::make_shared<compositor::Mesh>(compositor::box_mesh(size));
    mesh->two_sided = false;
    node.mesh = mesh;
    node.material.diffuse = glm::vec3(0.9F);
    node.material.ambient = 0;
    node.world_from_node =
        compositor::NodeTransform{.translation = at, .angle_rad = turn_rad}.parent_from_node().matrix();
    return node;
}

inline Light spot_light(const glm::dvec3& location, const glm::dvec3& at, double cut_off_rad) {
    Light light;
    light.kind = LightKind::kSpot;
    light.location = location;
    light.towards = glm::normalize(at - location);
    light.cut_off_rad = light.beam_width_rad = cut_off_rad;
    return light;
}

// Boxes on a board, one of them floating, lit by one light.
inline compositor::Scene boxes(const Light& light) {
    compositor::Scene scene;
    scene.lights = {light};
    scene.geometry = {matte_box({8, 0.2, 8}, {0, -0.1, 0}), matte_box({1, 1, 1}, {-0.8, 0.5, 0.2}, 0.4),
                      matte_box({0.4, 2, 0.4}, {0.9, 1, -0.6}), matte_box({0.8, 0.1, 0.6}, {0.6, 0.8, 0.9}, -0.3)};
    return scene;
}

// Red channel of the geometry in linear light.
inline Image<float> red_of(const Image<Rgba8>& image) {
    Image<float> red(image.width(), image.height());
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) red(x, y) = linear_from_srgb8(image(x, y).r);
    }
    return red;
}

inline Image<Rgba8> raster_image(const compositor::Scene& scene, const std::vector<compositor::PlacedObject>& objects,
                                 const Camera& camera, bool shadows) {
    auto frames = compositor::FrameCompositor::create(
        scene, objects, {.width = camera.width, .height = camera.height, .samples = 1, .shadows = shadows});
    RS_CHECK(frames.ok());
    Result<Image<Rgba8>> image = frames->compose(camera);
    RS_CHECK(image.ok());
    return std::move(*image);
}

// Agreement of raster and traced shadows on pixels that are lit without occluders.
struct ShadowAgreement {
    int compared = 0;  // at least 1.5 pixels from an edge of the traced shadow
    int alike = 0;
    int shaded = 0;  // in the traced image
    [[nodiscard]] double share() const { return static_cast<double>(alike) / compared; }
};

inline ShadowAgreement shadow_agreement(const compositor::Scene& scene,
                                        const std::vector<compositor::PlacedObject>& objects, const Camera& camera) {
    auto tracer = compositor::TracedRenderer::create(scene, objects, {.method = compositor::TracedMethod::kWhitted});
    RS_CHECK(tracer.ok());
    tracer->begin_image(camera);
    RS_CHECK(tracer->add_pass());
    const Image<RgbaF> traced = tracer->radiance();
    const Image<float> open = red_of(raster_image(scene, {}, camera, false));
    const Image<float> shadowed = red_of(raster_image(scene, objects, camera, true));
    const Image<Rgba8> objects_seen = raster_image(scene, objects, camera, false);
    const Image<Rgba8> geometry_seen = raster_image(scene, {}, camera, false);
    Image<std::uint8_t> by_rays(camera.width, camera.height, 0);  // 1 lit, 2 shaded, 0 neither
    constexpr float kLit = 0.03F;
    for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
            if (traced(x, y).a > 0.5F && open(x, y) > kLit) by_rays(x, y) = traced(x, y).r > 0.5F * open(x, y) ? 1 : 2;
        }
    }
    ShadowAgreement found;
    for (int y = 1; y + 1 < camera.height; ++y) {
        for (int x = 1; x + 1 < camera.width; ++x) {
            const std::uint8_t here = by_rays(x, y);
            if (here == 0 || objects_seen(x, y) != geometry_seen(x, y)) continue;
            bool at_edge = false;
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx) at_edge |= by_rays(x + dx, y + dy) != here;
            }
            if (at_edge) continue;
            ++found.compared;
            found.shaded += here == 2 ? 1 : 0;
            found.alike += (shadowed(x, y) > 0.5F * open(x, y)) == (here == 1) ? 1 : 0;
        }
    }
    return found;
}

}  // namespace rs::test
