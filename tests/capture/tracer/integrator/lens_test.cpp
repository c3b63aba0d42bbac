// Depth of field, motion blur and soft shadows against analytic formulas.

#include "rayspace/light/directions.hpp"
#include "tests/capture/tracer/test_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace rs::capture::test {
namespace {

RenderOptions many_rays(RenderMethod method, int samples) {
    RenderOptions options;
    options.method = method;
    options.samples_per_pixel = samples;
    return options;
}

// Diameter in px of a uniform disc with the same variance about its centroid; `own` is the variance without blur.
double disc_of(const Image<RgbaF>& image, double own_variance) {
    glm::dvec2 middle(0);
    double sum = 0, spread = 0;
    const auto each = [&](const auto& visit) {
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                const RgbaF& p = image(x, y);
                visit(glm::dvec2(x + 0.5, y + 0.5), static_cast<double>(p.g) * static_cast<double>(p.a));
            }
        }
    };
    each([&](const glm::dvec2& at, double light) {
        sum += light;
        middle += light * at;
    });
    middle /= sum;
    each([&](const glm::dvec2& at, double light) { spread += light * glm::dot(at - middle, at - middle); });
    return 2 * std::sqrt(2 * (spread / sum - own_variance));
}

TEST(ThinLens, ABlurCircleIsAsWideAsTheLensFormulaSays) {
    constexpr double kFocus = 3;
    for (const RenderMethod method : {RenderMethod::kToon, RenderMethod::kPath}) {
        for (const double z : {1.5, 5.0, 30.0}) {
            for (const double aperture : {0.05, 0.2}) {
                // A small emissive quad.
                const double side = 0.004 * z;
                Material speck = material_of(SurfaceKind::diffuse, glm::vec3(0.0F));
                speck.emission = glm::vec3(1.0F);
                const auto half = static_cast<float>(side / 2);
                Scene scene = scene_of(make_quad({-half, -half, 0}, {2 * half, 0, 0}, {0, 2 * half, 0}), speck);
                const Camera camera = front_camera(z, 20, 96);
                RenderOptions options = many_rays(method, 256);
                options.lens = {aperture, kFocus};
                options.toon.edge_radius = 0;
                const double expected = aperture * camera.fl_x * std::abs(z - kFocus) / (z * kFocus);
                if (expected < 4 || expected > 80) continue;
                const double side_px = side * camera.fl_x / z;
                const double own = 2 * (1 + side_px * side_px) / 12;  // variance of the pixels and of the quad
                const double found = disc_of(render(std::move(scene), camera, options).image, own);
                EXPECT_NEAR(found, expected, 0.03 * expected) << z << " " << aperture;
                if (method == RenderMethod::kToon) {
                    std::printf("blur circle at %.1f: %.2f px, %.2f by the formula\n", z, found, expected);
                }
            }
        }
    }
}

TEST(ThinLens, WhatIsInFocusIsAsSharpAsThroughAPinhole) {
    const auto image = [](double aperture) {
        Scene scene = scene_of(make_quad({-0.5F, -0.5F, 0}, {1, 0, 0}, {0, 1, 0}), material_of(SurfaceKind::diffuse));
        scene.lights = {directional_light({0, 0, -1}, glm::vec3(1))};
        RenderOptions options = many_rays(RenderMethod::kWhitted, 64);
        options.lens = {aperture, 4};
        return render(std::move(scene), front_camera(4, 20, 64), options).image;
    };
    const Image<RgbaF> pinhole = image(0), lens = image(0.5);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) EXPECT_NEAR(pinhole(x, y).a, lens(x, y).a, 0.1) << x << " " << y;
    }
}

// Visible share of a lamp along a row of a floor shaded by a half plane.
double penumbra(RenderMethod method, double lamp_width, double lamp_height, double edge_height) {
    const auto row = [&](bool shaded) {
        Scene scene = scene_of(make_quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -100}), material_of(SurfaceKind::diffuse));
        if (shaded)
            scene.meshes.push_back(make_quad({0, static_cast<float>(edge_height), -50}, {0, 0, 100}, {50, 0, 0}));
        const auto w = static_cast<float>(lamp_width);
        scene.lights = {rectangle_light({-w / 2, lamp_height, -w / 2}, {w, 0, 0}, {0, 0, w}, glm::vec3(5.0F))};
        RenderOptions options = many_rays(method, 1024);
        options.soft_shadows = true;
        options.max_bounces = 1;  // direct light only
        const Camera camera = look_at_camera({0, 0.9 * edge_height, 1e-4}, {0, 0, 0}, radians(60), 256, 1);
        const Image<RgbaF> image = render(std::move(scene), camera, options).image;
        std::vector<double> light;
        for (int x = 0; x < 256; ++x) light.push_back(static_cast<double>(image(x, 0).g));
        return light;
    };
    const std::vector<double> shaded = row(true), open = row(false);
    const double px = 2 * 0.9 * edge_height * std::tan(radians(30)) / 256;
    // Penumbra: a linear falloff.
    const auto place_of = [&](double share) {
        std::size_t x = 0;
        while (x + 1 < shaded.size() && shaded[x + 1] / open[x + 1] > share) ++x;
        const double here = shaded[x] / open[x], next = shaded[x + 1] / open[x + 1];
        return static_cast<double>(x) + (here - share) / (here - next);
    };
    return (place_of(0.2) - place_of(0.8)) * px / 0.6;
}

TEST(SoftShadows, APenumbraIsAsWideAsSimilarTrianglesSay) {
    for (const RenderMethod method : {RenderMethod::kWhitted, RenderMethod::kPath}) {
        for (const double width : {0.3, 0.6}) {
            for (const double edge : {1.0, 1.5}) {
                const double expected = width * edge / (4 - edge);
                const double found = penumbra(method, width, 4, edge);
                std::printf("penumbra of %.1f under %.1f: %.4f, %.4f by the formula\n", width, edge, found, expected);
                EXPECT_NEAR(found, expected, 0.05 * expected);
            }
        }
    }
}

TEST(SoftShadows, SurfacesThatShineLightFromAllOver) {
    // At 0.6 above the floor, the centre alone would be a poor approximation of the integral.
    const auto brightness = [](RenderMethod method) {
        Scene scene = scene_of(make_quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -100}), material_of(SurfaceKind::diffuse));
        Material lamp = material_of(SurfaceKind::diffuse, glm::vec3(0.0F));
        lamp.emission = glm::vec3(2.0F);
        scene.materials.push_back(lamp);
        scene.meshes.push_back(make_quad({-0.5F, 0.6F, -0.5F}, {1, 0, 0}, {0, 0, 1}));
        scene.meshes.back().material = 1;
        RenderOptions options = many_rays(method, 4096);
        options.soft_shadows = true;
        options.max_bounces = 1;
        return mean_radiance(
                   render(std::move(scene), look_at_camera({0, 0.3, 0.01}, {0, 0, 0}, radians(0.1), 2, 2), options)
                       .image)
            .g;
    };
    const double truth = brightness(RenderMethod::kPath);
    EXPECT_NEAR(brightness(RenderMethod::kWhitted), truth, 0.01 * truth);
}

TEST(Shutter, AStreakIsAsLongAsTheWayOfWhatMoves) {
    for (const RenderMethod method : {RenderMethod::kToon, RenderMethod::kPath}) {
        for (const double way : {0.2, 0.5}) {
            Material speck = material_of(SurfaceKind::diffuse, glm::vec3(0.0F));
            speck.emission = glm::vec3(1.0F);
            Scene scene;
            scene.materials = {speck};
            scene.parts = {{"speck", {make_quad({-0.05F, -0.2F, 0}, {0.1F, 0, 0}, {0, 0.4F, 0})}}};
            Instance moves;
            moves.world_from_part[3] = {-way / 2, 0, 0, 1};
            moves.at_close = glm::dmat4(1);
            (*moves.at_close)[3] = {way / 2, 0, 0, 1};
            scene.instances = {moves};
            const Camera camera = front_camera(3, 20, 128);
            RenderOptions options = many_rays(method, 256);
            options.toon.edge_radius = 0;
            const Image<RgbaF> image = render(std::move(scene), camera, options).image;
            // The width at half maximum equals the distance moved, independent of the object's width.
            const auto light = [&](int x) { return static_cast<double>(image(x, 64).a * image(x, 64).g); };
            double most = 0, length = 0;
            for (int x = 0; x < 128; ++x) most = std::max(most, light(x));
            for (int x = 0; x + 1 < 128; ++x) {
                const double a = light(x) - most / 2, b = light(x + 1) - most / 2;
                if ((a < 0) != (b < 0)) length += (a < 0 ? -1 : 1) * (x + a / (a - b));
            }
            const double expected = way * camera.fl_x / 3;
            std::printf("streak: %.2f px, %.2f by the way\n", length, expected);
            EXPECT_NEAR(length, expected, 1);
        }
    }
}

}  // namespace
}  // namespace rs::capture::test
