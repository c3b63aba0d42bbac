// Tests of the scalar definition of rendering with a shape map (engine/RECONSTRUCTION.md, sections 5 to 8): against the
// stored images at captured poses, and against floating-point geometry on a ball.
#include "engine/core/definition/shape_pixel.hpp"
#include "engine/core/definition/reconstruct.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/format/object_file.hpp"
#include "tests/engine/core/definition/shape_pixels.hpp"
#include "tests/support/sphere_object.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace rs::engine {
namespace {

using test::pixel_at;
using test::registers_of;
using test::RingObjectOptions;
using test::Texel;
Image<Rgba8> rendered(const RaySpaceObject& object, const Camera& camera) {
    Image<Rgba8> image(camera.width, camera.height);
    reconstruct_scalar(object, registers_of(object, camera), image);
    return image;
}

Texel stored(const RaySpaceObject& object) {
    return [&](int view, int column, int row) {
        return rgba_at(object.images[static_cast<std::size_t>(view)], column, row);
    };
}

// --- A captured pose ------------------------------------------------------------------------------------------------

class CapturedPoseWithShape : public testing::TestWithParam<int> {};

TEST_P(CapturedPoseWithShape, GivesBackTheStoredImageWhateverTheCells) {
    const RingObjectOptions options{
        .views = 24, .width = 40, .height = 40, .fl_px = 56, .planes = GetParam(), .camera_height = 0.3};
    const Rig rig = test::ring_rig(options);
    RaySpaceObject object = test::ring_object(options);
    ShapeMap& shape = object.rings[0].shape;
    shape = test::empty_shape(rig, object.rings[0], 2, 16, 16);
    std::mt19937_64 random(7);
    for (const char* const cells : {"empty", "wrong"}) {
        SCOPED_TRACE(cells);
        const Status status = validate_object(object, "noise");
        ASSERT_TRUE(status.ok()) << status.error().message;
        for (std::size_t i = 0; i < rig.views.size(); ++i) {
            ASSERT_EQ(rendered(object, rig.views[i].camera), rgba_from_planar(object.images[i])) << i;
        }
        for (ShapeCell& cell : shape.cells) {
            const std::uint64_t bits = random();
            if (bits % 4 == 0) continue;
            cell = {std::uint8_t(bits >> 8), std::uint8_t(bits % 4)};
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Planes, CapturedPoseWithShape, testing::Values(3, 4, 12, 13, 64));

// --- Position of a sample -------------------------------------------------------------------------------------------

// Texels encode their own position, so that a bilinear sample of them is its position.
TEST(ShapeSample, PositionEqualsFloatingPointProjection) {
    const RingObjectOptions options{
        .views = 36, .width = 120, .height = 120, .fl_px = 180, .planes = 8, .camera_height = 0.2};
    const Rig rig = test::ring_rig(options);
    RaySpaceObject object = test::ring_object(options);
    object.rings[0].shape = test::empty_shape(rig, object.rings[0], 2, 16, 16);
    const Texel place = [](int, int column, int row) {
        return Rgba8{std::uint8_t(2 * column), std::uint8_t(2 * row), 0, 255};
    };
    std::mt19937_64 engine(3);
    const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); };
    int compared = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const double angle = in(0, 2 * kPi), distance = in(1.5, 12);
        const glm::dvec3 eye(distance * std::sin(angle), in(-1, 1), distance * std::cos(angle));
        const Camera camera = look_at_camera(eye, {0, 0, 0}, 2 * std::atan(0.9 / distance), 64, 64);
        const ViewRegisters registers = registers_of(object, camera);
        for (int n = 0; n < 60; ++n) {
            const int i = static_cast<int>(in(0, 64)), j = static_cast<int>(in(0, 64)),
                      d_q3 = static_cast<int>(in(0, 8 * 255));
            const ShapeSetup setup = set_up_shape(object, registers, i, j);
            if (!setup.has_shape()) continue;
            // Ray scaled to horizontal length 1, foot, and point at depth d.
            const glm::dvec3 ray = camera.ray(i + 0.5, j + 0.5) /
                                   std::hypot(camera.ray(i + 0.5, j + 0.5).x, camera.ray(i + 0.5, j + 0.5).z);
            const double to_foot = -(eye.x * ray.x + eye.z * ray.z);
            const double depth = std::ldexp(object.rings[0].shape.depth_low_q20, -20) +
                                 d_q3 * std::ldexp(object.rings[0].shape.depth_step_q24, -27);
            const glm::dvec3 point = eye + (to_foot + depth) * ray;
            const auto y_q16 = static_cast<std::int32_t>(std::lround(std::ldexp(point.y, 16)));
            for (const ShapeImage& image : {setup.first, setup.second}) {
                const glm::dvec3 pixel = rig.views[static_cast<std::size_t>(image.view)].camera.project(point);
                const SampleSum sum =
                    sample_image(object, image, d_q3, y_q16, TexelFilter::kBilinear, test::PlainTexels{place});
                const bool inside = pixel.x > 1 && pixel.x < 119 && pixel.y > 1 && pixel.y < 119;
                if (!inside) continue;
                ASSERT_TRUE(sum.exists);
                EXPECT_EQ(sum.a, 64 * 255);
                EXPECT_NEAR(0.5 * sum.r / sum.a + 0.5, pixel.x, 0.125);
                EXPECT_NEAR(0.5 * sum.g / sum.a + 0.5, pixel.y, 0.125);
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 2000);
}

// --- The ball -------------------------------------------------------------------------------------------------------

struct Differences {
    int compared = 0;
    double mean_depth = 0, most_depth = 0, mean_grey = 0;
};

// Compares with ray casting over the pixels whose rays pass the ball's centre at less than 0.8 of its radius.
Differences against_ray_casting(const RaySpaceObject& object, const test::Sphere& sphere, const Camera& camera) {
    Differences result;
    const Texel texel = stored(object);
    for (int j = 0; j < camera.height; j += 3) {
        for (int i = 0; i < camera.width; i += 3) {
            const glm::dvec3 ray = camera.ray(i + 0.5, j + 0.5);
            if (!hit(test::Sphere{sphere.centre, 0.8 * sphere.radius}, camera.centre(), ray)) continue;
            const double truth = hit(sphere, camera.centre(), ray)->enters;
            const ShapePixel pixel = pixel_at(object, camera, i, j, texel);
            EXPECT_GE(pixel.colour.a, 250) << i << " " << j;
            const double off = std::abs(std::ldexp(pixel.lambda_q20, -20) - truth) * glm::length(ray);
            result.most_depth = std::max(result.most_depth, off);
            result.mean_depth += off;
            result.mean_grey += std::abs(pixel.colour.g - test::grey_at(camera.centre() + truth * ray));
            ++result.compared;
        }
    }
    result.mean_depth /= std::max(1, result.compared);
    result.mean_grey /= std::max(1, result.compared);
    return result;
}

class Ball : public testing::Test {
protected:
    test::Sphere sphere_;
    RingObjectOptions options_ = test::sphere_options();
    RaySpaceObject object_ = test::sphere_object(options_, sphere_);
};

TEST_F(Ball, IsAValidObject) {
    const Status status = validate_object(object_, "ball");
    EXPECT_TRUE(status.ok()) << status.error().message;
}

// The surface is bilinear between cells of 1/31 object radius; a depth step is 0.008. From other heights the band is a
// first-order approximation, so the error is at most that of a march step of half a band.
TEST_F(Ball, ViewsFromAllDirectionsMeetItsSurface) {
    const auto expect_near = [&](const char* what, const Camera& camera) {
        SCOPED_TRACE(what);
        const Differences off = against_ray_casting(object_, sphere_, camera);
        EXPECT_GT(off.compared, 150);
        EXPECT_LT(off.mean_depth, 0.02);
        EXPECT_LT(off.most_depth, 0.07);
        EXPECT_LT(off.mean_grey, 2);
    };
    const auto at = [&](double azimuth_deg, double distance, double height) {
        const double a = radians(azimuth_deg);
        return test::upright_at(options_, {distance * std::sin(a), height, distance * std::cos(a)});
    };
    const auto tilted = [&](double azimuth_deg, double distance, double height) {
        const double a = radians(azimuth_deg);
        return look_at_camera({distance * std::sin(a), height, distance * std::cos(a)}, sphere_.centre,
                              2 * std::atan(0.7 / distance), options_.width, options_.height);
    };
    expect_near("midway", test::between_views(options_, 3, 0.5));
    expect_near("nearer", at(47, 1.8, 0.3));
    expect_near("farther", at(123, 9, 0.3));
    expect_near("higher", at(208, 3.5, 1.1));
    expect_near("lower", at(331, 3.5, -0.8));
    expect_near("nearer and tilted", tilted(66, 2, 0.8));
    expect_near("farther and tilted", tilted(187, 20, 5));
}

// --- Extreme numbers ------------------------------------------------------------------------------------------------

// Numbers of the map and of the views at the ends of their ranges or random within them; useful with UBSan.
TEST(ShapePixelProperty, ExtremeNumbersStayDefined) {
    const RingObjectOptions options{
        .views = 6, .width = 8, .height = 8, .fl_px = 11, .planes = 4, .x_cells = 16, .u_cells = 16};
    const Rig rig = test::ring_rig(options);
    RaySpaceObject original = test::ring_object(options);
    original.rings[0].shape = test::empty_shape(rig, original.rings[0], 1, 1, 4);
    int rays = 0;
    std::int64_t shown = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937_64 random(seed);
        const auto in = [&](std::int32_t low, std::int32_t high) {
            if (random() % 3 == 0) return std::uniform_int_distribution<std::int32_t>(low, high)(random);
            return random() % 2 == 0 ? low : high;
        };
        const auto below = [&](std::int32_t limit) { return in(1 - limit, limit - 1); };
        constexpr std::int32_t k20 = 1 << 20, k28 = 1 << 28, k30 = 1 << 30;
        RaySpaceObject object = original;
        ShapeMap& shape = object.rings[0].shape;
        // Every other object keeps its cameras, every other its bands; otherwise few rays would reach a texel.
        if (random() % 2 == 0) {
            shape.bands_per_unit_q12 = in(1, 1 << 26);
            shape.h_low_q20 = below(k28);
            shape.reference_distance_q20 = in(k20 + 1, k28 - 1);
            shape.reference_height_q20 = below(k28);
        }
        if (random() % 2 == 0) shape.depth_low_q20 = below((1 << 21) + (1 << 16) + 1);
        if (random() % 2 == 0) shape.depth_step_q24 = in(1, 1 << 18);
        shape.jump = in(1, 255);
        for (NormalLine& line : shape.normal_lines) {
            if (random() % 4 == 0) line.a_q20 = below(k28);
            if (random() % 4 == 0) line.c_q20 = below(k28);
        }
        if (random() % 2 == 0) {
            for (NormalLine& line : shape.normal_lines) {
                line.l2_q30 = below(k30 + 1);
                line.q2_q16 = below(k30);
            }
            for (CapturedView& view : object.views) {
                view.cx_q16 = below(k30);
                view.cy_q16 = below(k30);
                view.fl_y_q16 = in(1, k30 - 1);
                view.height_q20 = below(k28);
                for (CapturedLine& line : view.lines) {
                    line = {in(2 * k20 + (k20 >> 3), k28 - 1), below(k30 + 1),
                            below(std::numeric_limits<std::int32_t>::max()), below(k30)};
                }
            }
        }
        for (ShapeCell& cell : shape.cells) {
            cell = {std::uint8_t(in(0, 255)), std::uint8_t(in(1, 3))};
        }
        const Status status = validate_object(object, "extreme");
        ASSERT_TRUE(status.ok()) << status.error().message;
        // Rays from nearly overhead have the least horizontal length.
        const double beside = random() % 2 == 0 ? 0.12 : 1;
        const glm::dvec3 eye(beside * (0.4 + 0.1 * double(random() % 10)), 0.2 * double(random() % 21) - 2,
                             beside * (0.2 * double(random() % 15) + 0.1));
        const double scale = random() % 4 == 0 ? 90 : 1;
        Camera camera = look_at_camera(scale * eye, {0, 0, 0}, random() % 2 == 0 ? 0.7 : 2.6, 16, 16);
        if (random() % 2 == 0) camera.cx = 0.5;
        const Result<ViewRegisters> registers = prepare_view(object, camera);
        if (!registers) continue;
        Image<Rgba8> image(16, 16);
        reconstruct_scalar(object, *registers, image);
        for (const Rgba8& p : image.pixels()) shown += p.a != 0;
        for (int i = 0; i < 16; ++i) rays += set_up_shape(object, *registers, i, 8).has_shape();
    }
    EXPECT_GT(rays, 1000);
    EXPECT_GT(shown, 3000);
}

}  // namespace
}  // namespace rs::engine
