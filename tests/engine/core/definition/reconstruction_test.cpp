// Tests of the normative arithmetic against floating-point geometry, and against the stored images at captured poses.

#include "engine/core/definition/ray_setup.hpp"
#include "engine/core/definition/reconstruct.hpp"
#include "engine/core/views/orbit.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/geometry/ray_space.hpp"
#include "tests/support/plane_ray.hpp"
#include "tests/support/ring_object.hpp"
#include "tests/support/sphere_object.hpp"

#include <gtest/gtest.h>

namespace rs::engine {
namespace {

Image<Rgba8> reconstructed(const RaySpaceObject& object, const Camera& camera) {
    const Result<ViewRegisters> registers = prepare_view(object, camera);
    EXPECT_TRUE(registers.ok());
    Image<Rgba8> image(camera.width, camera.height);
    reconstruct_scalar(object, *registers, image);
    return image;
}

class CapturedPose : public testing::TestWithParam<int> {};

// At a captured pose geometry and column look-up are exact for any number of planes: every pixel is reproduced.
TEST_P(CapturedPose, GivesBackTheStoredImage) {
    for (const double camera_height : {0.0, 0.3}) {
        const test::RingObjectOptions options{
            .views = 90, .width = 64, .height = 64, .fl_px = 90, .planes = GetParam(), .camera_height = camera_height};
        const RaySpaceObject object = test::ring_object(options);
        const Rig rig = test::ring_rig(options);
        for (std::size_t i = 0; i < rig.views.size(); ++i) {
            SCOPED_TRACE(i);
            ASSERT_EQ(reconstructed(object, rig.views[i].camera), rgba_from_planar(object.images[i]));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Planes, CapturedPose, testing::Values(3, 4, 8, 12, 13, 64));

TEST(Reconstruction, AnObjectOfTheEncoderIsValid) {
    for (const int planes : {3, 4, 12, 64}) {
        const Status status = validate_object(test::ring_object({.planes = planes}), "ring");
        EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().message);
    }
}

// Integer set-up of random rays against the same geometry in doubles.
TEST(ReconstructionProperty, AgreesWithFloatingPointGeometry) {
    const test::RingObjectOptions options{.views = 40, .width = 512, .height = 512, .fl_px = 700, .planes = 8};
    const Rig rig = test::ring_rig(options);
    RaySpaceObject object = test::ring_object({.views = 40, .width = 16, .height = 16, .fl_px = 20, .planes = 8});
    object.width = options.width;
    object.height = options.height;
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        object.views[i] = *encode::captured_view(rig.views[i].camera, options.planes);
    }
    object.images.clear();
    int compared = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937_64 engine(seed);
        const auto in = [&](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(engine);
        };
        const double angle = in(0, 2 * kPi), distance = in(1.5, 30);
        const glm::dvec3 eye(distance * std::sin(angle), in(-1.5, 1.5), distance * std::cos(angle));
        const Camera camera = look_at_camera(eye, {in(-0.3, 0.3), in(-0.3, 0.3), in(-0.3, 0.3)},
                                             2 * std::atan(in(0.6, 1.2) / distance), 256, 256);
        const Result<ViewRegisters> registers = prepare_view(object, camera);
        ASSERT_TRUE(registers.ok());
        for (int n = 0; n < 50; ++n) {
            const int i = static_cast<int>(in(0, 255)), j = static_cast<int>(in(0, 255));
            const RaySetup setup = set_up_ray(object, *registers, i, j);
            if (setup.image < 0) continue;
            const test::Ray ray{camera.centre(), camera.ray(i + 0.5, j + 0.5)};
            const ReferencePlane plane =
                reference_plane(test::most_perpendicular_plane(ray.direction, options.planes), options.planes);
            const auto place = test::to_ray_space(ray, plane);
            ASSERT_TRUE(place);
            const glm::dvec3 p = place->x * plane.tangent + glm::dvec3(0, place->y, 0);
            const glm::dvec3 pixel = rig.views[static_cast<std::size_t>(setup.image)].camera.project(p);
            EXPECT_NEAR(setup.column + 0.5, pixel.x, 0.51);
            const double row = static_cast<double>(setup.row_0_q16 + j * setup.row_step_q16) / 65536;
            EXPECT_NEAR(row, pixel.y, 0.02);
            ++compared;
        }
    }
    EXPECT_GT(compared, 5000);
}

TEST(Reconstruction, AViewFromInsideOrFarAwayStaysDefined) {
    const RaySpaceObject object = test::ring_object({});
    for (const glm::dvec3 eye : {glm::dvec3(0, 0, 0.001), glm::dvec3(0.1, 5, 0), glm::dvec3(0, -40, 0.5),
                                 glm::dvec3(1e3, 0, 0), glm::dvec3(0, 1e-7, 2.01)}) {
        const Camera camera = look_at_camera(eye, {0, 0, -0.5}, radians(50), 33, 17);
        const Image<Rgba8> image = reconstructed(object, camera);
        for (const Rgba8& p : image.pixels()) {
            if (p.a == 0) {
                EXPECT_EQ(p, Rgba8{});
            }
        }
    }
}

TEST(Reconstruction, ADistantViewpointKeepsTheObjectsImage) {
    const RaySpaceObject object = test::ring_object({.views = 36, .width = 96, .height = 96, .fl_px = 130});
    // 190 radii are within the limit of 200; 1900 radii with ten times the focal length are moved to it and show the
    // same.
    const auto at = [&](double distance) {
        Camera camera = look_at_camera({0, 0, distance}, {0.1, 0, 0}, radians(20), 64, 64);
        camera.fl_x = camera.fl_y = 25 * distance;
        return reconstructed(object, camera);
    };
    const Image<Rgba8> near = at(190), far = at(1900);
    int shown = 0, different = 0;
    for (std::size_t i = 0; i < near.pixels().size(); ++i) {
        shown += near.pixels()[i].a != 0;
        different += !(near.pixels()[i] == far.pixels()[i]);
    }
    EXPECT_GT(shown, 500);
    EXPECT_LT(different, shown / 4);  // noise images: a slight shift changes a pixel
}

TEST(PrepareView, RejectsCamerasBeyondTheNumberRanges) {
    const RaySpaceObject object = test::ring_object({});
    const Camera good = look_at_camera({0, 0, 3}, {0, 0, 0}, radians(40), 32, 32);
    const auto message = [&](const Camera& camera) {
        const Result<ViewRegisters> registers = prepare_view(object, camera);
        return registers ? std::string() : registers.error().message;
    };
    EXPECT_EQ(message(good), "");
    Camera camera = good;
    camera.fl_x = camera.fl_y = 1;
    EXPECT_NE(message(camera).find("too wide"), std::string::npos);
    camera = good;
    camera.world_from_camera[3].z = 1e6;
    EXPECT_NE(message(camera).find("few pixels"), std::string::npos);
    camera = good;
    camera.fl_y = -5;
    EXPECT_NE(message(camera).find("focal length"), std::string::npos);
    camera = good;
    camera.width = 9000;
    EXPECT_NE(message(camera).find("9000x32"), std::string::npos);
    camera = good;
    camera.world_from_camera[3].x = std::nan("");
    EXPECT_NE(message(camera).find("not finite"), std::string::npos);
    camera = good;
    camera.world_from_camera[0] *= 2;
    EXPECT_NE(message(camera).find("rotation"), std::string::npos);
}

TEST(PrepareView, ChoosesTheFilterByTheSizeOfTheView) {
    const test::RingObjectOptions options;
    RaySpaceObject object = test::ring_object(options);
    const auto filter_at = [&](double scale) {
        Camera camera = test::ring_rig(options).views[3].camera;
        camera.fl_x *= scale;
        camera.fl_y *= scale;
        return prepare_view(object, camera)->filter;
    };
    EXPECT_EQ(filter_at(1), TexelFilter::kBilinear) << "there is no shape map";
    object.rings[0].shape = test::empty_shape(test::ring_rig(options), object.rings[0], 2, 16, 16);
    EXPECT_EQ(filter_at(3), TexelFilter::kSharp);
    EXPECT_EQ(filter_at(0.96), TexelFilter::kSharp);
    EXPECT_EQ(filter_at(0.94), TexelFilter::kBilinear);
    EXPECT_EQ(filter_at(0.76), TexelFilter::kBilinear);
    EXPECT_EQ(filter_at(0.74), TexelFilter::kSmooth);
    EXPECT_EQ(prepare_view(object, test::ring_rig(options).views[3].camera, TexelFilter::kSmooth)->filter,
              TexelFilter::kSmooth);
}

TEST(PrepareView, TakesTheRingNearestInElevation) {
    RaySpaceObject object = test::ring_object({});
    object.rings.push_back(object.rings.front());
    object.rings[1].elevation_udeg = 40'000'000;
    const auto ring_at = [&](double elevation) {
        const double angle = radians(elevation);
        return prepare_view(object, look_at_camera({0, 3 * std::sin(angle), 3 * std::cos(angle)}, {0, 0, 0}, 0.7, 8, 8))
            ->ring;
    };
    EXPECT_EQ(ring_at(19.9), 0);
    EXPECT_EQ(ring_at(20.1), 1);
}

TEST(Orbit, StartsAtTheFirstCapturedViewAndTurnsLikeTheCapture) {
    const test::RingObjectOptions options{.views = 12};
    const RaySpaceObject object = test::ring_object(options);
    const Rig rig = test::ring_rig(options);
    const Result<std::vector<Camera>> cameras = orbit_cameras(object, 12, {});
    ASSERT_TRUE(cameras.ok());
    for (std::size_t i = 0; i < 12; ++i) {
        for (int c = 0; c < 4; ++c) {
            EXPECT_NEAR(glm::distance(glm::dvec3((*cameras)[i].world_from_camera[c]),
                                      glm::dvec3(rig.views[i].camera.world_from_camera[c])),
                        0, 1e-9);
        }
    }
}

}  // namespace
}  // namespace rs::engine
