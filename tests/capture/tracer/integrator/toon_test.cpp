// Toon tones against the angles of their thresholds.

#include "tests/capture/tracer/test_shapes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

namespace rs::capture::test {
namespace {

RenderOptions toon(float edge_radius = 0.0F) {
    RenderOptions options;
    options.method = RenderMethod::kToon;
    options.samples_per_pixel = 1;
    options.filter_radius_px = 0.001F;
    options.toon.edge_radius = edge_radius;
    return options;
}

std::set<std::tuple<float, float, float>> colours_of(const Image<RgbaF>& image) {
    std::set<std::tuple<float, float, float>> colours;
    for (const RgbaF& p : image.pixels()) {
        if (p.a > 0) colours.emplace(p.r, p.g, p.b);
    }
    return colours;
}

// Cosine at the hit of a pixel position's ray with the unit sphere; NaN for a miss.
double cosine_at(const Camera& camera, double x, double y, const glm::dvec3& to_light) {
    const glm::dvec3 d = glm::normalize(camera.ray(x, y)), o = camera.centre();
    const double b = glm::dot(o, d), under_root = b * b - glm::dot(o, o) + 1;
    return under_root > 0 ? glm::dot(o + d * (-b - std::sqrt(under_root)), to_light) : std::nan("");
}

// Position in row y at which the cosine crosses `value`, between two pixel centres.
double crossing_of(const Camera& camera, double x0, double x1, double y, const glm::dvec3& to_light, double value) {
    const bool rises = cosine_at(camera, x1, y, to_light) > cosine_at(camera, x0, y, to_light);
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (x0 + x1);
        ((cosine_at(camera, middle, y, to_light) < value) == rises ? x0 : x1) = middle;
    }
    return x0;
}

TEST(Toon, BandsOfASphereLieAtTheAnglesOfTheThresholds) {
    Scene scene = scene_of(make_sphere(6), material_of(SurfaceKind::diffuse, {0.9F, 0.5F, 0.2F}));
    const glm::dvec3 to_light = glm::normalize(glm::dvec3(1, 0, 0.4));
    scene.lights = {directional_light(-to_light, glm::vec3(0.37F))};
    const Camera camera = front_camera(6, 21, 512);
    const Image<RgbaF> image = render(std::move(scene), camera, toon()).image;
    EXPECT_EQ(colours_of(image).size(), 5U);

    const ToonStyle style;
    std::array<double, 4> error{}, count{};
    for (int y = 100; y < 412; ++y) {  // where the bands are steep
        for (int x = 0; x + 1 < 512; ++x) {
            const double here = cosine_at(camera, x + 0.5, y + 0.5, to_light);
            const double next = cosine_at(camera, x + 1.5, y + 0.5, to_light);
            if (image(x, y).a < 1 || image(x + 1, y).a < 1 || std::isnan(here) || std::isnan(next)) continue;
            for (std::size_t k = 0; k < 4; ++k) {
                const float colour = std::max(image(x, y).r, image(x + 1, y).r);
                if (image(x, y).r == image(x + 1, y).r || std::abs(colour - 0.9F * style.values[k]) > 1e-4F) continue;
                // A band may be narrower than a pixel: then both thresholds are in it.
                const double value = style.thresholds[k];
                const double found = x + 1, near = std::abs(here - value) < std::abs(next - value) ? here : next;
                const double slope = std::abs(next - here);
                error[k] += (here < value) != (next < value)
                                ? std::abs(crossing_of(camera, x + 0.5, x + 1.5, y + 0.5, to_light, value) - found)
                                : 0.5 + std::abs(near - value) / slope;
                ++count[k];
            }
        }
    }
    const std::array<double, 4> degrees{18.19, 60, 72.54, 87.13};
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(std::acos(style.thresholds[k]) * 180 / kPi, degrees[k], 0.01);
        ASSERT_GT(count[k], k == 0 ? 150 : 300) << degrees[k];
        std::printf("band at %.2f degrees: mean error %.3f px of %.0f\n", degrees[k], error[k] / count[k], count[k]);
        EXPECT_LT(error[k] / count[k], 0.5) << degrees[k];
    }
}

TEST(Toon, IntensityCountsNotHowBrightALightIsButWhatItIsBesideOthers) {
    const auto tone = [](std::vector<Light> lights, float ambient, glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
        Scene scene = scene_of(make_quad(corner, u, v), material_of(SurfaceKind::diffuse, glm::vec3(0.5F)));
        scene.lights = std::move(lights);
        RenderOptions options = toon();
        options.ambient = glm::vec3(ambient);
        options.toon.thresholds = {0.8F, 0.6F, 0.4F, 0.2F};
        const glm::vec3 normal = glm::normalize(glm::cross(u, v)), middle = corner + 0.5F * (u + v);
        const Camera camera = look_at_camera(glm::dvec3(middle + normal), glm::dvec3(middle), radians(0.1), 2, 2);
        return mean_radiance(render(std::move(scene), camera, options).image).g / 0.5;
    };
    const auto up = [&](std::vector<Light> lights, float ambient = 0) {
        return tone(std::move(lights), ambient, {-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
    };
    const auto down = [&](std::vector<Light> lights, float ambient = 0) {
        return tone(std::move(lights), ambient, {-5, 0, -5}, {10, 0, 0}, {0, 0, 10});
    };
    const auto sun = [](glm::dvec3 towards, float bright) { return directional_light(towards, glm::vec3(bright)); };
    EXPECT_NEAR(up({sun({0, -1, 0}, 0.01F)}), 1, 1e-5);
    EXPECT_NEAR(up({sun({0, -1, 0}, 100)}), 1, 1e-5);
    EXPECT_NEAR(up({point_light({0, 2, 0}, glm::vec3(7))}), 1, 1e-5);
    EXPECT_NEAR(up({sun({1, -1, 0}, 3)}), 0.8, 1e-5);                       // 0.71
    EXPECT_NEAR(up({sun({1, -1, 0}, 3), sun({-1, -1, 0}, 3)}), 1, 1e-5);    // the maximum
    EXPECT_NEAR(up({sun({0, -1, 0}, 3), sun({0, 1, 0}, 1)}), 1, 1e-5);      // 3 of 2,
    EXPECT_NEAR(down({sun({0, -1, 0}, 3), sun({0, 1, 0}, 1)}), 0.5, 1e-5);  // 1 of 2
    EXPECT_NEAR(down({sun({0, -1, 0}, 3)}), 0.1, 1e-5);                     // nothing
    EXPECT_NEAR(down({sun({0, -1, 0}, 3)}, 3 / kPiF), 0.5, 1e-5);           // half of it isotropic
    EXPECT_NEAR(up({}, 1), 1, 1e-5);
}

TEST(Toon, TheEnvironmentIsALightFromWhereItShinesTheMost) {
    Scene scene = scene_of(make_sphere(5), material_of(SurfaceKind::diffuse, glm::vec3(0.5F)));
    scene.environment = constant_environment(3.0F);
    const Image<RgbaF> even = render(std::move(scene), front_camera(4, 34, 64), toon()).image;
    EXPECT_EQ(colours_of(even).size(), 1U);  // isotropic

    Scene under_sky = scene_of(make_sphere(5), material_of(SurfaceKind::diffuse, glm::vec3(0.5F)));
    under_sky.environment.pixels = Image<RgbaF>(64, 32);
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 64; ++x) under_sky.environment.pixels(x, y) = {2, 2, 2, 1};
    }
    RenderOptions two_tones = toon();
    two_tones.toon.thresholds = {0.5F};
    two_tones.toon.values = {1.0F, 0.1F};
    const Image<RgbaF> image = render(std::move(under_sky), front_camera(4, 34, 64), two_tones).image;
    EXPECT_NEAR(image(32, 6).g, 0.5, 1e-5);    // above
    EXPECT_NEAR(image(32, 58).g, 0.05, 1e-5);  // below
    for (int x = 25; x < 39; ++x) EXPECT_EQ(image(x, 20).g, image(63 - x, 20).g);
}

TEST(Toon, MirrorsAndGlassShowTones) {
    // A sphere above a horizontal mirror; both show tones of the sphere only.
    Scene scene = scene_of(make_sphere(5), material_of(SurfaceKind::diffuse, glm::vec3(0.8F)));
    scene.materials.push_back(material_of(SurfaceKind::mirror, glm::vec3(1.0F)));
    scene.meshes.push_back(make_quad({-9, -1.2F, 9}, {18, 0, 0}, {0, 0, -18}));
    scene.meshes.back().material = 1;
    scene.lights = {directional_light({-1, -0.2, -1}, glm::vec3(1))};
    const Image<RgbaF> image =
        render(std::move(scene), look_at_camera({0, 3, 6}, {0, -1, 0}, radians(40), 128, 128), toon()).image;
    for (const auto& [r, g, b] : colours_of(image)) {
        bool known = r == 0;  // background, in the mirror
        for (const float value : ToonStyle{}.values) known = known || std::abs(r - 0.8F * value) < 1e-5F;
        EXPECT_TRUE(known) << r;
    }
    EXPECT_GE(colours_of(image).size(), 5U);
}

TEST(Toon, PixelsAreMeasuredAtTheMedianDistance) {
    // A near wall covers the image from the left up to `share` of its width, a far one all of it.
    const auto pixel_size = [](float share, const Camera& camera) {
        Scene scene = scene_of(make_quad({-9, -9, -6}, {18, 0, 0}, {0, 18, 0}), material_of(SurfaceKind::diffuse));
        const auto half_width = static_cast<float>(0.5 * camera.width * 4 / camera.fl_x);
        scene.meshes.push_back(make_quad({-9, -9, 0}, {9 + (2 * share - 1) * half_width, 0, 0}, {0, 18, 0}));
        const Result<Tracer> tracer = Tracer::create(std::move(scene));
        EXPECT_TRUE(tracer) << tracer.error().message;
        return tracer->median_pixel_size(camera);
    };
    const Camera camera = front_camera(4, 10, 100);
    EXPECT_NEAR(pixel_size(0.7F, camera) * camera.fl_x, 4, 0.04);
    EXPECT_NEAR(pixel_size(0.3F, camera) * camera.fl_x, 10, 0.1);
    const Camera away = look_at_camera({0, 0, 4}, {0, 0, 8}, radians(10), 100, 100);
    EXPECT_NEAR(pixel_size(0.7F, away) * away.fl_x, 7, 0.1);  // centre of the bounds: z = -3, x near 0
}

TEST(Toon, SteppedColoursDependOnTheBrightnessOfLights) {
    const auto wall = [](float radiance, float brightness) {
        // 0.8 is the largest component of the wall's colour.
        Scene scene = scene_of(make_quad({-5, -5, 0}, {10, 0, 0}, {0, 10, 0}),
                               material_of(SurfaceKind::diffuse, {0.8F, 0.4F, 0}));
        scene.lights = {directional_light({0, 0, -1}, glm::vec3(radiance * kPiF / 0.8F))};
        RenderOptions options = toon();
        options.toon.steps = ToonStyle::Steps::colour;
        options.toon.brightness = brightness;
        return mean_radiance(render(std::move(scene), front_camera(4, 10, 4), options).image);
    };
    for (const auto& [radiance, tone] : {std::pair(3.0F, 1.0), {0.6F, 0.8}, {0.4F, 0.5}, {0.1F, 0.3}}) {
        const glm::dvec3 colour = wall(radiance, 1);
        EXPECT_NEAR(colour.r, tone, 1e-5) << radiance;
        EXPECT_NEAR(colour.g, tone / 2, 1e-5) << radiance;
        EXPECT_EQ(colour.b, 0);
    }
    EXPECT_NEAR(wall(0.6F, 0.5F).r, 0.5, 1e-5);  // 1.2 after an exposure of one stop
}

TEST(Toon, SoftShadowsHaveTonesToo) {
    const auto floor_under_block = [](int shadow_rays) {
        Scene scene = scene_of(make_quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}), material_of(SurfaceKind::diffuse));
        scene.meshes.push_back(make_quad({0, 1, -5}, {0, 0, 10}, {5, 0, 0}));
        scene.lights = {rectangle_light({-0.5F, 2, -0.5F}, {1, 0, 0}, {0, 0, 1}, glm::vec3(2.0F))};
        RenderOptions options = toon();
        options.toon.shadow_rays = shadow_rays;
        return render(std::move(scene), look_at_camera({0, 0.9, 0.01}, {0, 0, 0}, radians(90), 96, 96), options).image;
    };
    const auto tones_of_row = [](const Image<RgbaF>& image) {
        std::set<float> tones;
        for (int x = 0; x < 96; ++x) tones.insert(image(x, 48).g);
        return tones;
    };
    const Image<RgbaF> hard = floor_under_block(0), soft = floor_under_block(64);
    EXPECT_LE(colours_of(soft).size(), 5U);
    EXPECT_EQ(tones_of_row(soft).size(), 5U);  // all of them, one after the other,
    int dark = 0;
    for (int x = 44; x < 52; ++x) dark += hard(x, 48).g < 0.2F;
    EXPECT_EQ(dark, 4);  // a hard shadow has a single step
}

}  // namespace
}  // namespace rs::capture::test
