// Normal and bump maps, raster and traced. Skipped without OpenGL.

#include "compositor/scene/material.hpp"
#include "rayspace/base/conventions.hpp"
#include "tests/compositor/gl_test.hpp"
#include "tests/compositor/viewer/shadows/shadow_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace rs::compositor {
namespace {

constexpr int kSide_px = 96;

SceneTexture even_image(Rgba8 colour) {
    SceneTexture texture;
    texture.image = Image<Rgba8>(8, 8, colour);
    return texture;
}

// Textured square about the origin that faces +Z, lit from one side.
Scene square(std::shared_ptr<const NormalMap> normals) {
    Scene scene;
    scene.lights = {directional_light({-1, 0, -1}, glm::vec3(2.5F))};
    auto mesh = std::make_shared<Mesh>();
    for (const glm::vec2 at : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
        mesh->vertices.push_back({glm::vec3(at, 0), {0, 0, 1}, at * 0.5F + 0.5F});
    }
    mesh->indices = {0, 1, 2, 0, 2, 3};
    GeometryNode node;
    node.mesh = mesh;
    node.material.diffuse = glm::vec3(0.7F);
    node.material.specular = glm::vec3(0.2F);
    node.material.normals = std::move(normals);
    scene.geometry = {node};
    return scene;
}

Camera before(double from_side = 0.4) {
    return look_at_camera({from_side, 0.3, 2.2}, {0, 0, 0}, radians(50), kSide_px, kSide_px);
}

Image<RgbaF> traced(const Scene& scene, TracedMethod method) {
    auto tracer = TracedRenderer::create(scene, {}, {.method = method});
    RS_CHECK(tracer.ok());
    tracer->begin_image(before());
    for (int pass = 0; pass < 4; ++pass) RS_CHECK(tracer->add_pass());
    return tracer->radiance();
}

using Relief = test::GlTest;

TEST_F(Relief, AFlatMapGivesTheImageWithoutBitForBit) {
    for (const auto& flat :
         {normal_map(even_image({128, 128, 255, 255}), 2), normal_map_of_heights(even_image({77, 130, 12, 255}), 3)}) {
        EXPECT_TRUE(std::ranges::equal(test::raster_image(square(flat), {}, before(), false).pixels(),
                                       test::raster_image(square(nullptr), {}, before(), false).pixels()));
        for (const TracedMethod method : {TracedMethod::kWhitted, TracedMethod::kPath}) {
            EXPECT_TRUE(
                std::ranges::equal(traced(square(flat), method).pixels(), traced(square(nullptr), method).pixels()));
        }
    }
}

// A normal map tilted towards +X gives the same brightness as a tilted square.
TEST_F(Relief, TiltsTheNormalAlongTheTexturesAxes) {
    const auto red_in_the_middle = [](const Scene& scene) {
        return test::red_of(test::raster_image(scene, {}, before(), false))(kSide_px / 2, kSide_px / 2);
    };
    const glm::dvec3 to_light = glm::normalize(glm::dvec3(1, 0, 1));
    for (const glm::ivec2 tilt : {glm::ivec2(40, 0), {-60, 0}, {0, 50}, {30, -40}}) {
        SceneTexture image =
            even_image({static_cast<std::uint8_t>(128 + tilt.x), static_cast<std::uint8_t>(128 + tilt.y), 255, 255});
        Scene scene = square(normal_map(image, 1.5F));
        scene.geometry[0].material.specular = glm::vec3(0);
        const glm::dvec3 n = glm::normalize(glm::dvec3(1.5 * tilt.x / 127.0, 1.5 * tilt.y / 127.0, 1));
        const double expected = 0.7 * 2.5 / kPi * std::max(glm::dot(n, to_light), 0.0);
        EXPECT_NEAR(red_in_the_middle(scene), expected, 0.006) << tilt.x << " " << tilt.y;
        EXPECT_NEAR(traced(scene, TracedMethod::kWhitted)(kSide_px / 2, kSide_px / 2).r, expected, 0.003)
            << tilt.x << " " << tilt.y;
    }
}

TEST_F(Relief, HeightsRiseTowardsWhite) {
    SceneTexture image;
    image.image = Image<Rgba8>(64, 64);
    image.repeat_s = image.repeat_t = false;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const auto height = static_cast<std::uint8_t>(4 * x);  // slope towards -X
            image.image(x, y) = {height, height, height, 255};
        }
    }
    const auto map = normal_map_of_heights(image, 2);
    const RgbaF& middle = map->directions(32, 32);
    EXPECT_NEAR(middle.r, -2 * 8 * 4 / 255.0, 1e-6);
    EXPECT_EQ(middle.g, 0);
    EXPECT_EQ(middle.b, 1);
    image.image = Image<Rgba8>(1, 1, Rgba8{9, 9, 9, 255});
    EXPECT_EQ(normal_map_of_heights(image, 2)->directions(0, 0), (RgbaF{0, 0, 1, 1}));
}

}  // namespace
}  // namespace rs::compositor
