// Luminaires and scenes with many lights against radiometric formulas.

#include "capture/tracer/light/light_set.hpp"
#include "tests/capture/tracer/test_shapes.hpp"
#include "tests/support/random.hpp"
#include "tests/support/real_data.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace rs::capture::test {
namespace {

std::shared_ptr<const Luminaire> luminaire_of(const std::string& text) {
    auto read = parse_ies(text, "test.ies");
    EXPECT_TRUE(read) << (read ? "" : read.error().message);
    return std::make_shared<const Luminaire>(std::move(read).value());
}

// Asymmetric web: 0 to 90 degrees from the nadir, 4 different planes.
std::shared_ptr<const Luminaire> asymmetric_luminaire() {
    return luminaire_of(
        "TILT=NONE\n1 -1 10 3 5 1 2 0 0 0 1 1 9\n0 45 90\n0 90 180 270 360\n"
        "100 80 10 100 120 30 100 40 5 100 60 20 100 80 10\n");
}

Light light_of(std::shared_ptr<const Luminaire> luminaire, const glm::dvec3& location) {
    Light light;
    light.kind = LightKind::kLuminaire;
    light.location = location;
    light.luminaire = std::move(luminaire);
    return light;
}

// Compares I cos / d^2 of a web that is linear between its angles at positions on the floor in all directions.
TEST(LuminaireLight, LightsTheFloorByTheInverseSquareLaw) {
    const std::array<double, 4> at_45 = {800, 1200, 400, 600}, at_90 = {100, 300, 50, 200};
    for (const double turn_deg : {0.0, 45.0, 90.0, 200.0, 300.0}) {
        for (const double out : {0.0, 0.4, 1.0, 2.5}) {
            Scene scene = scene_of(make_quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -100}),
                                   material_of(SurfaceKind::diffuse, glm::vec3(0.5F)));
            const double turn = radians(turn_deg), height = 2;
            const glm::dvec3 place(out * std::cos(turn), 0, -out * std::sin(turn));
            scene.lights.push_back(light_of(asymmetric_luminaire(), {0, height, 0}));
            const Camera camera = look_at_camera(place + glm::dvec3(0, 1, 1e-3), place, radians(0.05), 2, 2);
            RenderOptions options;
            options.samples_per_pixel = 16;
            const double mean = mean_radiance(render(std::move(scene), camera, options).image).g;

            const auto plane = static_cast<std::size_t>(turn_deg / 90);
            const double share = turn_deg / 90 - static_cast<double>(plane);
            const double theta_deg = degrees(std::atan2(out, height));
            const auto between = [share, plane](const std::array<double, 4>& values) {
                return (1 - share) * values[plane % 4] + share * values[(plane + 1) % 4];
            };
            const double t = theta_deg / 45;
            const double candela =
                t <= 1 ? (1 - t) * 1000 + t * between(at_45) : (2 - t) * between(at_45) + (t - 1) * between(at_90);
            const double d2 = out * out + height * height;
            const double irradiance = candela / 179 * (height / std::sqrt(d2)) / d2;
            EXPECT_NEAR(mean, 0.5 / kPi * irradiance, 1e-3 * mean) << turn_deg << " degrees, " << out;
        }
    }
}

// Indirect irradiance in a sphere: flux * r / (4 pi R^2 (1 - r)), independent of the web.
void expect_sphere_is_filled(const std::shared_ptr<const Luminaire>& luminaire, RenderMethod method) {
    SCOPED_TRACE(method == RenderMethod::kPath ? "path" : "radiosity");
    const double albedo = 0.5, radius = 1;
    Scene scene = scene_of(make_sphere(5), material_of(SurfaceKind::diffuse, glm::vec3(albedo)));
    scene.lights.push_back(light_of(luminaire, {0, 0, 0}));
    // Uniform directions: equal steps of height and azimuth.
    // Noise of virtual lights is correlated over an image, so the number of passes matters there, pixels elsewhere.
    const bool radiosity = method == RenderMethod::kRadiosity;
    const int side = radiosity ? 8 : 96;
    RayImage rays{2 * side, side, glm::dvec3(0), {0, 0, -1}, [side](double x, double y) {
                      const double h = 1 - 2 * y / side, turn = kPi * x / side,
                                   across = std::sqrt(std::max(1 - h * h, 0.0));
                      return glm::dvec3(across * std::cos(turn), h, across * std::sin(turn));
                  }};
    RenderOptions options;
    options.method = method;
    options.samples_per_pixel = radiosity ? 512 : 16;
    options.max_bounces = 24;
    auto tracer = Tracer::create(std::move(scene));
    ASSERT_TRUE(tracer) << tracer.error().message;
    const double mean = mean_radiance(tracer->render(rays, options).image).g;
    const double wall = 4 * kPi * radius * radius;
    const double flux = luminaire->web.lumens() / kLumensPerWatt;
    const double indirect = mean * kPi / albedo - flux / wall;
    EXPECT_NEAR(indirect, flux * albedo / (wall * (1 - albedo)), 0.01 * indirect);
}

TEST(LuminaireLight, FillsASphereAsItsFluxSays) {
    expect_sphere_is_filled(asymmetric_luminaire(), RenderMethod::kPath);
    expect_sphere_is_filled(asymmetric_luminaire(), RenderMethod::kRadiosity);
}

TEST(LuminaireLightRealData, FillsASphereAsItsFluxSays) {
    const auto folder = RS_REAL_DATA_OR_SKIP("ies");
    for (int i = 1; i <= 8; ++i) {
        SCOPED_TRACE(i);
        auto read = read_luminaire(folder / (std::to_string(i) + ".IES"));
        ASSERT_TRUE(read) << read.error().message;
        const auto luminaire = std::make_shared<const Luminaire>(std::move(read).value());
        expect_sphere_is_filled(luminaire, RenderMethod::kPath);
        // Takes seconds each; only photons and light samples depend on the web, so two webs suffice.
        if (i % 4 == 1) expect_sphere_is_filled(luminaire, RenderMethod::kRadiosity);
    }
}

// Lights of every kind together: the mean of the samples equals the sum of the sources, and every source is sampled.
TEST(LightSetProperty, DrawsAreUnbiasedWhereverTheyAreNeeded) {
    Scene scene = scene_of(make_quad({-9, -1, 9}, {18, 0, 0}, {0, 0, -18}), material_of(SurfaceKind::diffuse));
    scene.lights.push_back(directional_light({-1, -2, 0}, glm::vec3(0.4F)));
    scene.lights.push_back(point_light({2, 1, 0}, glm::vec3(3.0F)));
    Light spot = point_light({-2, 2, 0}, glm::vec3(8.0F));
    spot.kind = LightKind::kSpot;
    spot.towards = {0, -1, 0};
    spot.beam_width_rad = 0.3;
    spot.cut_off_rad = 0.6;
    scene.lights.push_back(spot);
    scene.lights.push_back(light_of(asymmetric_luminaire(), {0, 3, 2}));
    Light disc;
    disc.kind = LightKind::kDisc;
    disc.location = {0, 2, -2};
    disc.half_u = {0.3, 0, 0};
    disc.half_v = {0, 0, 0.3};
    scene.lights.push_back(disc);
    const LightSet lights(scene, {}, {glm::vec3(0), 10.0F});
    rs::test::Random random(3);
    for (int place = 0; place < 40; ++place) {
        const glm::vec3 position(random.real(-3, 3), random.real(-0.9, 3.5), random.real(-3, 3));
        double expected = 0;
        for (const Light& light : scene.lights) {
            if (light.kind != LightKind::kDisc) expected += irradiance_at(light, position).g;
        }
        const LightSet::Selection selection = lights.select({position});
        double drawn = 0, squares = 0;
        constexpr int kDraws = 20000;
        for (int i = 0; i < kDraws; ++i) {
            const auto sample =
                lights.sample(selection, static_cast<float>(random.real(0, 1)), {random.real(0, 1), random.real(0, 1)});
            if (!sample || !sample->delta) continue;
            const double value = sample->radiance.g / sample->pdf;
            drawn += value / kDraws;
            squares += value * value / kDraws;
        }
        const double deviation = std::sqrt(std::max(squares - drawn * drawn, 0.0) / kDraws);
        EXPECT_NEAR(drawn, expected, 4.5 * deviation + 1e-6) << position.x << " " << position.y << " " << position.z;
    }
}

// E = pi L sin^2 of the half angle, below its centre; nothing behind.
TEST(DiscLight, GivesItsFormFactorAndIsSeenInMirrors) {
    for (const bool mirror : {false, true}) {
        Scene scene = scene_of(make_quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -100}),
                               material_of(mirror ? SurfaceKind::mirror : SurfaceKind::diffuse, glm::vec3(0.5F)));
        Light disc;
        disc.kind = LightKind::kDisc;
        disc.location = {0, 1.5, 0};
        disc.half_u = {2, 0, 0};
        disc.half_v = {0, 0, 2};
        disc.colour = glm::vec3(4.0F);
        scene.lights.push_back(disc);
        const Camera camera = look_at_camera({0, 1, 0.05}, {0, 0, 0}, radians(1.0), 8, 8);
        RenderOptions options;
        options.samples_per_pixel = 256;
        const double mean = mean_radiance(render(Scene(scene), camera, options).image).g;
        EXPECT_NEAR(mean, mirror ? 0.5 * 4 : 0.5 * 4 * (4 / (4 + 2.25)), 0.01);
        std::swap(scene.lights[0].half_u, scene.lights[0].half_v);
        EXPECT_EQ(mean_radiance(render(std::move(scene), camera, options).image).g, 0);
    }
}

// A hall with lamps 10 m apart: the noise below each lamp equals that of a single lamp.
TEST(LightSet, ALampAmongManyIsFoundWhereItShines) {
    const auto error_below = [](int lamps) {
        Scene scene = scene_of(make_quad({-400, 0, 400}, {800, 0, 0}, {0, 0, -800}), material_of(SurfaceKind::diffuse));
        for (int i = 0; i < lamps; ++i) scene.lights.push_back(point_light({10.0 * i, 2, 0}, glm::vec3(5.0F)));
        const Camera camera = look_at_camera({0, 1, 0.05}, {0, 0, 0}, radians(1.0), 16, 16);
        RenderOptions options;
        options.samples_per_pixel = 16;
        const auto image = render(std::move(scene), camera, options).image;
        const double mean = mean_radiance(image).g;
        double squares = 0;
        for (const RgbaF& p : image.pixels()) squares += (p.g - mean) * (p.g - mean);
        return std::sqrt(squares / 256) / mean;
    };
    EXPECT_LT(error_below(49), 0.25);  // 1.7 with uniform selection
}

}  // namespace
}  // namespace rs::capture::test
