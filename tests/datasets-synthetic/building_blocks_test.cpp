// Building blocks of objects: random numbers, shapes, paint, letters.

#include "datasets-synthetic/objects/petal.hpp"
#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/shapes/noise.hpp"
#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/shapes/portable_math.hpp"
#include "datasets-synthetic/shapes/random.hpp"
#include "datasets-synthetic/shapes/surfaces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rs::synthetic {
namespace {

using capture::Mesh;
using glm::vec2;
using glm::vec3;

double area(const Mesh& mesh) {
    double sum = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const vec3 a = mesh.positions[t.x];
        sum += 0.5 * static_cast<double>(glm::length(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a)));
    }
    return sum;
}

TEST(PortableMath, AgreesWithTheCLibrary) {
    Random random(1);
    for (int k = 0; k < 20000; ++k) {
        const auto x = static_cast<double>(random.uniform(-300.0F, 300.0F));
        const auto y = static_cast<double>(random.uniform(-3.0F, 3.0F));
        ASSERT_NEAR(portable::sin(x), std::sin(x), 1e-13) << x;
        ASSERT_NEAR(portable::exp(x) / std::exp(x), 1, 1e-12) << x;
        ASSERT_NEAR(portable::cos(x), std::cos(x), 1e-13) << x;
        ASSERT_NEAR(portable::atan2(y, x), std::atan2(y, x), 1e-14) << y << " " << x;
    }
    EXPECT_EQ(portable::atan2(0.0, 0.0), 0.0);
    EXPECT_NEAR(portable::atan2(0.0, -1.0), kPi, 1e-15);
    for (int v = 0; v <= 255; ++v) {
        const double s = v / 255.0;
        const double exact = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
        ASSERT_NEAR(portable::srgb_to_linear(s), exact, 1e-14) << v;
    }
}

// First numbers of the PCG32 reference implementation for seed 42, stream 54.
TEST(Random, IsPcg32) {
    Random random(42, 54);
    for (const std::uint32_t expected : {0xA15C02B7U, 0x7B47F409U, 0xBA1D3330U, 0x83D2F293U, 0xBFA4784BU, 0xCBED606EU})
        EXPECT_EQ(random.next(), expected);
}

TEST(Random, DistributionsAreWhatTheySay) {
    Random random(5);
    constexpr int kDraws = 40000;
    double sum = 0;
    double sum_squares = 0;
    vec3 mean_direction{0.0F};
    int counts[5] = {};
    for (int k = 0; k < kDraws; ++k) {
        const auto bell = static_cast<double>(random.bell());
        sum += bell;
        sum_squares += bell * bell;
        const vec3 d = random.direction();
        ASSERT_NEAR(glm::length(d), 1.0F, 1e-5F);
        mean_direction += d / static_cast<float>(kDraws);
        const float u = random.uniform();
        ASSERT_TRUE(u >= 0.0F && u < 1.0F);
        ++counts[random.below(5)];
    }
    EXPECT_NEAR(sum / kDraws, 0.0, 0.02);
    EXPECT_NEAR(sum_squares / kDraws, 1.0, 0.03);
    EXPECT_LT(glm::length(mean_direction), 0.02F);
    for (const int count : counts) EXPECT_NEAR(count, kDraws / 5, 400);
}

TEST(Noise, RepeatsWithItsPeriodAndIsContinuous) {
    float largest = 0.0F;
    for (int k = 0; k < 500; ++k) {
        const vec3 p{0.37F * static_cast<float>(k % 19), 0.61F * static_cast<float>(k % 23),
                     0.11F * static_cast<float>(k)};
        const float value = gradient_noise(p, 9, 6);
        EXPECT_NEAR(value, gradient_noise(p + vec3{6, 0, 0}, 9, 6), 1e-4F);
        EXPECT_NEAR(value, gradient_noise(p + vec3{1e-4F, 0, 0}, 9, 6), 1e-3F);
        EXPECT_LE(std::abs(value), 1.1F);
        largest = std::max(largest, std::abs(value));
    }
    EXPECT_GT(largest, 0.4F);
}

TEST(Shapes, HaveTheAreasOfGeometry) {
    Mesh cylinder;
    const std::vector<vec2> profile{{2.0F, 0.0F}, {2.0F, 1.0F}, {2.0F, 3.0F}};
    append_lathe(cylinder, profile, {.segments = 256});
    EXPECT_NEAR(area(cylinder), 2.0 * kPi * 2.0 * 3.0, 0.01);

    Mesh sphere;
    append_ellipsoid(sphere, {{}, vec3{1.5F}}, 128, 64);
    EXPECT_NEAR(area(sphere), 4.0 * kPi * 1.5 * 1.5, 0.05);

    Mesh torus;
    std::vector<vec3> ring;
    for (int k = 0; k < 200; ++k) {
        const double a = 2.0 * kPi * k / 200;
        ring.push_back({2.0F * static_cast<float>(std::sin(a)), 0.0F, 2.0F * static_cast<float>(std::cos(a))});
    }
    const float radius = 0.5F;
    append_tube(torus, ring, {&radius, 1}, {.sides = 64, .closed = true});
    EXPECT_NEAR(area(torus), 4.0 * kPi * kPi * 2.0 * 0.5, 0.1);
}

TEST(Shapes, LookOutwards) {
    Mesh lathe;
    append_lathe(lathe, std::vector<vec2>{{0, -1}, {1, -1}, {1, 1}, {0, 1}});
    Mesh capsule;
    const float radius = 0.3F;
    append_tube(capsule, std::vector<vec3>{{0, -0.5F, 0}, {0.1F, 0.5F, 0}}, {&radius, 1});
    for (const Mesh* mesh : {&lathe, &capsule}) {
        for (std::size_t i = 0; i < mesh->positions.size(); ++i)
            EXPECT_GT(glm::dot(mesh->positions[i], mesh->normals[i]), 0.0F);
    }
}

TEST(Shapes, ALatheKeepsItsCreases) {
    Mesh mesh;
    append_lathe(mesh, std::vector<vec2>{{0, -1}, {1, -1}, {1, 1}, {0, 1}});
    for (const vec3& n : mesh.normals) {
        const float along_axis = std::abs(n.y);
        EXPECT_TRUE(along_axis < 1e-4F || along_axis > 0.9999F) << "a rounded corner, y = " << n.y;
    }
}

TEST(Shapes, PetalStartsAtItsBaseAndCurlsBack) {
    Mesh mesh;
    PetalShape shape{.length = 2.0F, .curl_rad = 0.5F * static_cast<float>(kPi)};
    append_petal(mesh, {}, shape);
    const vec3 tip = mesh.positions.back();
    const float radius = 2.0F / (0.5F * static_cast<float>(kPi));
    EXPECT_LT(glm::length(tip - vec3{0.0F, radius, -radius}), 1e-4F);
    EXPECT_LT(std::abs(mesh.positions.front().y), 1e-4F);
    EXPECT_GT(mesh.normals[static_cast<std::size_t>(shape.columns / 2)].z, 0.9F);
}

TEST(Shapes, StrandHasItsTrianglesAndTip) {
    Mesh mesh;
    append_strand(mesh, {.root = {1, 2, 3}, .direction = {0, 1, 0}, .bend = {0.5F, 0, 0}, .length = 0.2F}, 4);
    EXPECT_EQ(mesh.triangles.size(), 7U);
    EXPECT_LT(glm::length(mesh.positions.back() - vec3{1.1F, 2.2F, 3.0F}), 1e-6F);
}

TEST(Shapes, KeptSurfacePointsAreUniformByArea) {
    const Ellipsoid disc{{}, {1.0F, 0.05F, 1.0F}};
    Random random(3);
    int inner = 0;
    int kept = 0;
    while (kept < 20000) {
        const RejectionSample draw = sample_surface(disc, random);
        if (!draw.keep) continue;
        ASSERT_NEAR(disc.level(draw.point.position), 1.0F, 1e-4F);
        const vec3 p = draw.point.position;
        inner += p.x * p.x + p.z * p.z < 0.25F ? 1 : 0;
        ++kept;
    }
    // A flat ellipsoid is two discs: a quarter of their area lies within half the radius.
    EXPECT_NEAR(static_cast<double>(inner) / kept, 0.25, 0.015);
}

TEST(Curve, PassesThroughItsControls) {
    const std::vector<vec2> controls{{0, 0}, {1, 3}, {2, 3.1F}, {5, 0}};
    const std::vector<vec2> curve = smooth_curve<vec2>(controls, 5);
    ASSERT_EQ(curve.size(), 16U);
    for (std::size_t k = 0; k < controls.size(); ++k) EXPECT_EQ(curve[5 * k], controls[k]);
    EXPECT_EQ(smooth_curve<vec2>(controls, 5, true).size(), 20U);
}

float green_at(const capture::Texture& texture, int x, int y_up) {
    return texture.pixels(x, texture.pixels.height() - 1 - y_up).g;
}

TEST(Paint, StrokesCoverTheirWidthAndWrapAround) {
    Canvas canvas(64, 32, vec3{0.0F});
    const std::vector<vec2> path{{60.0F, 10.0F}, {70.0F, 10.0F}};
    const float radius_px = 3.0F;
    canvas.stroke(path, {&radius_px, 1}, {.colour = vec3{0.8F}});
    const capture::Texture texture = std::move(canvas).texture("test");
    EXPECT_FLOAT_EQ(green_at(texture, 62, 9), 0.8F);
    EXPECT_FLOAT_EQ(green_at(texture, 3, 9), 0.8F) << "beyond the right edge";
    EXPECT_FLOAT_EQ(green_at(texture, 62, 14), 0.0F);
    EXPECT_FLOAT_EQ(green_at(texture, 30, 9), 0.0F);
}

TEST(Paint, OverlapsInAStrokeCountOnce) {
    Canvas canvas(32, 32, vec3{0.0F});
    const std::vector<vec2> there_and_back{{8, 16}, {24, 16}, {8, 16}};
    const float radius_px = 4.0F;
    canvas.stroke(there_and_back, {&radius_px, 1}, {.colour = vec3{0.8F}, .density = 0.5F});
    EXPECT_FLOAT_EQ(green_at(std::move(canvas).texture("test"), 16, 16), 0.4F);
}

TEST(Paint, ATaperedStrokeIsAsWideAsItsRadii) {
    Canvas canvas(64, 64, vec3{0.0F});
    canvas.stroke(std::vector<vec2>{{10, 32}, {50, 32}}, std::vector<float>{1.0F, 9.0F}, {.colour = vec3{0.8F}});
    const capture::Texture texture = std::move(canvas).texture("test");
    EXPECT_FLOAT_EQ(green_at(texture, 50, 39), 0.8F);
    EXPECT_FLOAT_EQ(green_at(texture, 12, 39), 0.0F);
    EXPECT_FLOAT_EQ(green_at(texture, 10, 32), 0.8F);
}

TEST(Paint, FillKeepsToItsOutline) {
    Canvas canvas(32, 32, vec3{0.0F});
    canvas.fill(std::vector<vec2>{{8, 8}, {24, 8}, {24, 24}, {8, 24}}, {.colour = vec3{1.0F}});
    const capture::Texture texture = std::move(canvas).texture("test");
    EXPECT_FLOAT_EQ(green_at(texture, 16, 16), 0.9F) << "clamped: no paint is whiter";
    EXPECT_FLOAT_EQ(green_at(texture, 4, 16), 0.0F);
    EXPECT_FLOAT_EQ(green_at(texture, 16, 28), 0.0F);
}

TEST(Paint, ColoursAreLinear) {
    EXPECT_FLOAT_EQ(srgb(0xFF0080).x, 1.0F);
    EXPECT_NEAR(srgb(0xFF0080).z, 0.2158605F, 1e-6F);
    EXPECT_LT(glm::length(hue_colour(1.0F / 3.0F, 1.0F, 1.0F) - vec3{0, 1, 0}), 1e-5F);
    EXPECT_LT(glm::length(hue_colour(1.0F / 6.0F, 1.0F, 1.0F) - vec3{1, 1, 0}), 1e-5F);
}

TEST(Lettering, EveryLetterFillsItsBox) {
    for (char c = 'A'; c <= 'Z'; ++c) {
        const Letter letter = pen_letter(c);
        float low = 1.0F;
        float high = 0.0F;
        for (const auto& stroke : letter.strokes) {
            for (const vec2& p : stroke) {
                low = std::min(low, p.y);
                high = std::max(high, p.y);
                EXPECT_TRUE(p.x >= -0.05F && p.x <= letter.width) << c;
            }
        }
        EXPECT_NEAR(low, 0.0F, 0.07F) << c;
        EXPECT_NEAR(high, 1.0F, 0.07F) << c;
        EXPECT_GT(letter.width, 0.3F) << c;
    }
}

}  // namespace
}  // namespace rs::synthetic
