// Phong's formula, spots and fog as rendered by the driver, against double precision.
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "rayspace/image/linear_light.hpp"
#include "tests/compositor/gl_test.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace rs::compositor {
namespace {

using PhongTest = test::GlTest;
using glm::dvec3;

constexpr double kSide = 20;  // of the plane y = 0

// Plane whose normals diverge, so that interpolated normals are not of unit length.
std::shared_ptr<const Mesh> plane() {
    auto mesh = std::make_shared<Mesh>();
    for (const glm::vec2 corner : {glm::vec2(-1, 1), {1, 1}, {1, -1}, {-1, -1}}) {
        MeshVertex vertex;
        vertex.position = {corner.x * kSide, 0, corner.y * kSide};
        vertex.normal = glm::normalize(glm::vec3(0.5F * corner.x, 1, 0.5F * corner.y));
        mesh->vertices.push_back(vertex);
    }
    mesh->indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

// Interpolates like the driver: linearly in each of the two triangles.
dvec3 normal_at(const dvec3& p) {
    const dvec3 a = glm::normalize(dvec3(-0.5, 1, 0.5));
    const dvec3 b = glm::normalize(dvec3(0.5, 1, 0.5));
    const dvec3 c = glm::normalize(dvec3(0.5, 1, -0.5));
    const dvec3 d = glm::normalize(dvec3(-0.5, 1, -0.5));
    const double u = (p.x / kSide + 1) / 2;
    const double v = (1 - p.z / kSide) / 2;  // from the near edge
    // Triangles a b c (u >= v) and a c d.
    const dvec3 n = u >= v ? a * (1 - u) + b * (u - v) + c * v : a * (1 - v) + c * u + d * (v - u);
    return glm::normalize(n);
}

Scene scene_of_lights() {
    Scene scene;
    scene.shading = Shading::kPhong;
    scene.background.sky = {glm::vec3(0)};
    scene.lights.clear();
    Light sun;
    sun.towards = glm::normalize(dvec3(0.4, -1, -0.3));
    sun.colour = {0.2F, 0.18F, 0.15F};
    sun.ambient = {0.3F, 0.25F, 0.2F};
    scene.lights.push_back(sun);
    Light point;
    point.kind = LightKind::kPoint;
    point.location = {-3, 2, 1};
    point.colour = {0.6F, 0.2F, 0.1F};
    point.ambient = {9, 9, 9};                // not used by the formula
    point.attenuation = {0.2F, 0.05F, 0.1F};  // above 1 nearby, where it is clamped
    scene.lights.push_back(point);
    Light spot;
    spot.kind = LightKind::kSpot;
    spot.location = {3, 4, 2};
    spot.towards = glm::normalize(dvec3(-0.2, -1, -0.3));
    spot.colour = {0.3F, 0.5F, 0.9F};
    spot.attenuation = {0.5F, 0.1F, 0};
    spot.beam_width_rad = radians(20);
    spot.cut_off_rad = radians(35);
    scene.lights.push_back(spot);
    GeometryNode node;
    node.mesh = plane();
    node.material.diffuse = {0.6F, 0.5F, 0.4F};
    node.material.specular = {0.4F, 0.3F, 0.5F};
    node.material.emissive = {0.01F, 0.02F, 0};
    node.material.phong = PhongTerms{{0.1F, 0.3F, 0.2F}, 14.5F};
    scene.geometry.push_back(node);
    return scene;
}

// Formulas term by term; I is the direction towards the light, Os the reflected view direction.
dvec3 expected_at(const Scene& scene, const dvec3& p, const dvec3& eye) {
    const Material& material = scene.geometry[0].material;
    const dvec3 n = normal_at(p);
    const dvec3 to_eye = glm::normalize(eye - p);
    const dvec3 os = 2 * glm::dot(n, to_eye) * n - to_eye;
    dvec3 sum(material.emissive);
    dvec3 ambient(0);
    for (const Light& light : scene.lights) {
        if (light.kind == LightKind::kDirectional) ambient += dvec3(light.ambient);
        dvec3 i = -light.towards;
        double strength = 1;
        if (light.kind != LightKind::kDirectional) {
            const double r = glm::distance(light.location, p);
            i = (light.location - p) / r;
            const dvec3 c(light.attenuation);
            strength = std::min(1 / (c.z * r * r + c.y * r + c.x), 1.0);
        }
        if (light.kind == LightKind::kSpot) {
            const double angle = std::acos(glm::dot(-i, light.towards));
            const double width = light.cut_off_rad - light.beam_width_rad;
            strength *= std::clamp((light.cut_off_rad - angle) / width, 0.0, 1.0);
        }
        const dvec3 e = strength * dvec3(light.colour);
        if (glm::dot(n, i) <= 0) continue;
        sum += dvec3(material.diffuse) * e * glm::dot(n, i);
        sum += dvec3(material.specular) * e *
               std::pow(std::max(glm::dot(i, os), 0.0), static_cast<double>(material.phong->exponent));
    }
    return sum + dvec3(material.phong->ambient) * ambient;
}

// Largest difference of a channel over all pixels, in steps of 1/255.
int difference(const Scene& scene) {
    const Camera camera = look_at_camera({2, 5, 11}, {0, 0, 0}, radians(60), 320, 200);
    auto compositor =
        FrameCompositor::create(scene, std::vector<PlacedObject>{}, {.width = 320, .height = 200, .samples = 1});
    EXPECT_TRUE(compositor);
    if (!compositor) return 255;
    const auto image = compositor->compose(camera);
    EXPECT_TRUE(image);
    int greatest = 0;
    int counted = 0;
    for (int y = 0; y < 200; ++y) {
        for (int x = 0; x < 320; ++x) {
            const dvec3 ray = camera.ray(x + 0.5, y + 0.5);
            if (ray.y > -1e-3) continue;
            const dvec3 p = camera.centre() + ray * (-camera.centre().y / ray.y);
            if (std::max(std::abs(p.x), std::abs(p.z)) > kSide * 0.98) continue;
            dvec3 colour = expected_at(scene, p, camera.centre());
            if (scene.fog) {
                const double d = glm::distance(p, camera.centre());
                const double v = scene.fog->visibility;
                const double kept = d >= v                                ? 0
                                    : scene.fog->kind == FogKind::kLinear ? (v - d) / v
                                                                          : std::exp(-d / (v - d));
                colour = glm::mix(dvec3(scene.fog->colour), colour, kept);
            }
            const Rgba8& seen = (*image)(x, y);
            const int channels[] = {seen.r, seen.g, seen.b};
            for (int k = 0; k < 3; ++k) {
                const int expected = srgb8_from_linear(static_cast<float>(std::min(colour[k], 1.0)));
                greatest = std::max(greatest, std::abs(channels[k] - expected));
            }
            ++counted;
        }
    }
    EXPECT_GT(counted, 30000);
    return greatest;
}

TEST_F(PhongTest, LightsSpotsAndHighlightsAreTheFormulas) {
    EXPECT_LE(difference(scene_of_lights()), 1);
}

TEST_F(PhongTest, FogIsTheFormulas) {
    Scene scene = scene_of_lights();
    scene.fog = Fog{FogKind::kExponential, {0.5F, 0.55F, 0.6F}, 60};
    EXPECT_LE(difference(scene), 1);
    scene.fog->kind = FogKind::kLinear;
    EXPECT_LE(difference(scene), 1);
}

// The comparison is sensitive: VRML97's half vector gives other values.
TEST_F(PhongTest, TheHalfVectorIsAnotherFormula) {
    Scene scene = scene_of_lights();
    scene.shading = Shading::kVrml;
    EXPECT_GT(difference(scene), 8);
}

}  // namespace
}  // namespace rs::compositor
