// Occlusion: frames of an object among geometry against reviewed images in golden/. Skipped without OpenGL.
//
// After an intended change, RAYSPACE_UPDATE_GOLDEN=1 test_compositor --gtest_filter='Occlusion*' rewrites the images;
// review them before committing (RAYSPACE_TRUTH_FOLDER=FOLDER writes the reference of each beside it), and state the
// reason. Tolerance: drivers rasterise edges differently, so one pixel in a hundred may differ, all others by up to
// kTolerance codes.

#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/image/image_metrics.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/compositor/gl_test.hpp"
#include "tests/compositor/occlusion_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <tuple>

namespace rs::compositor {
namespace {

constexpr int kGoldenWidth = 160;
constexpr int kGoldenHeight = 120;
constexpr int kTolerance = 6;
constexpr double kMayDiffer = 0.01;         // fraction of the pixels
constexpr double kUprightMayLose_db = 1.1;  // loss by resampling an upright image
constexpr glm::vec3 kWall{0.7F, 0.66F, 0.55F};
constexpr glm::vec3 kGreen{0.1F, 0.5F, 0.2F};

Camera seen(const glm::dvec3& eye, const glm::dvec3& at = {0, 0, 0}, double fov_deg = 40) {
    return look_at_camera(eye, at, radians(fov_deg), kGoldenWidth, kGoldenHeight);
}

double share_different(const Image<Rgba8>& a, const Image<Rgba8>& b) {
    int count = 0;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) {
            const Rgba8 p = a(x, y);
            const Rgba8 q = b(x, y);
            count += std::max({std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b)}) > kTolerance;
        }
    }
    return static_cast<double>(count) / (a.width() * a.height());
}

Image<Rgba8> flipped(const Image<Rgba8>& image) {
    Image<Rgba8> result(image.width(), image.height());
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) result(x, y) = image(image.width() - 1 - x, y);
    }
    return result;
}

// Frame of golden/NAME.png.
struct Case {
    std::string name;
    Scene scene;
    std::vector<PlacedObject> objects;
    Camera camera;
    double least_truth_db;  // against the meshes; about 2 dB below the measured value
    ObjectDepth depth = ObjectDepth::kPlane;
};

class Occlusion : public test::GlTest {
protected:
    static PlacedObject placed(const NodeTransform& transform = {}) {
        return {test::captured_signpost().viewable, transform.parent_from_node()};
    }

    static Image<Rgba8> compose(const Scene& scene, const std::vector<PlacedObject>& objects, const Camera& camera,
                                ObjectDepth depth = ObjectDepth::kPlane, bool upright = false) {
        Result<FrameCompositor> compositor = FrameCompositor::create(
            scene, objects,
            {.width = kGoldenWidth, .height = kGoldenHeight, .object_depth = depth, .upright_images = upright});
        RS_CHECK(compositor.ok());
        Result<Image<Rgba8>> frame = compositor->compose(camera);
        RS_CHECK(frame.ok());
        return std::move(*frame);
    }

    // Frame with meshes instead of the objects.
    static Image<Rgba8> truth(const Scene& scene, const std::vector<PlacedObject>& objects, const Camera& camera) {
        std::vector<test::TracedNode> nodes;
        for (const PlacedObject& object : objects) {
            nodes.push_back({test::captured_signpost().traced, object.world_from_object});
        }
        const auto traced = test::TruthScene::create(scene, nodes);
        RS_CHECK(traced.ok());
        return traced->render(camera, {}).image;
    }

    static double truth_db(const Image<Rgba8>& frame, const Image<Rgba8>& truth) {
        return compare_images_psnr(frame, truth).psnr_db();
    }

    static void expect_golden(const Case& made) {
        const Image<Rgba8> frame = compose(made.scene, made.objects, made.camera, made.depth);
        const Image<Rgba8> expected = truth(made.scene, made.objects, made.camera);
        const double db = truth_db(frame, expected);
        EXPECT_GE(db, made.least_truth_db) << made.name;
        const Image<Rgba8> upright = compose(made.scene, made.objects, made.camera, made.depth, true);
        EXPECT_GE(truth_db(upright, expected), db - kUprightMayLose_db) << made.name;
        const std::filesystem::path folder =
            std::filesystem::path(RAYSPACE_SOURCE_DIR) / "tests" / "compositor" / "golden";
        const std::filesystem::path file = folder / (made.name + ".png");
        if (std::getenv("RAYSPACE_UPDATE_GOLDEN") != nullptr) {
            ASSERT_TRUE(write_png(file, frame).ok());
            std::printf("%-20s %.2f dB from the truth\n", made.name.c_str(), db);
            if (const char* beside = std::getenv("RAYSPACE_TRUTH_FOLDER")) {
                ASSERT_TRUE(write_png(std::filesystem::path(beside) / (made.name + ".png"), expected).ok());
            }
            return;
        }
        const Result<Image<Rgba8>> golden = read_image(file);
        ASSERT_TRUE(golden) << golden.error().message;
        ASSERT_TRUE(golden->width() == kGoldenWidth && golden->height() == kGoldenHeight);
        EXPECT_LE(share_different(frame, *golden), kMayDiffer) << made.name;
    }
};

NodeTransform turned(const glm::dvec3& place, double angle_rad, double scale = 1, bool mirrored = false) {
    NodeTransform node{place, {0, 1, 0}, angle_rad, scale};
    node.mirrored = mirrored;
    return node;
}

Case with_boxes(Case made, const std::vector<std::tuple<glm::dvec3, glm::dvec3, glm::vec3, double>>& boxes) {
    for (const auto& [size, centre, colour, turn_rad] : boxes) {
        test::add_box(made.scene, size, centre, colour, turn_rad);
    }
    return made;
}

TEST_F(Occlusion, LooksAsInTheImages) {
    const Scene room = test::empty_room();
    const std::vector<PlacedObject> one = {placed()};
    const Camera front = seen({0.5, 0.6, 4.6});
    const Case cases[] = {
        with_boxes({"behind_a_wall", room, one, front, 30}, {{{1.6, 3, 0.1}, {0.5, 0, 1.6}, kWall, 0}}),
        with_boxes({"before_a_wall", room, one, front, 26}, {{{6, 3, 0.1}, {0.5, 0, -1.3}, kWall, 0}}),
        with_boxes({"half_behind_a_pillar", room, one, front, 26},
                   {{{0.5, 4, 0.5}, {-0.2, 0, 1.5}, kWall, 0.6}, {{0.3, 4, 0.3}, {1.1, 0, -1.2}, kGreen, 0}}),
        {"from_behind", room, one, seen({-0.6, 0.7, -4.6}), 26},
        with_boxes({"scaled",
                    room,
                    {placed(turned({-0.4, 0, 0}, 0.5, 0.5)), placed(turned({0.7, 0.45, 0}, -0.4, 1))},
                    seen({0.2, 0.6, 5.5}),
                    23},
                   {{{0.2, 2, 0.2}, {0.45, 0, 0.9}, kGreen, 0}, {{5, 0.1, 3}, {0, -0.62, 0}, kWall, 0}}),
        with_boxes({"mirrored",
                    room,
                    {placed(turned({-1.2, 0, 0}, 0.4, 0.8)), placed(turned({1.2, 0, 0}, -0.4, 0.8, true))},
                    seen({0, 0.7, 6}),
                    26},
                   {{{0.1, 3, 1.2}, {0, 0, 0}, kWall, 0}}),
        with_boxes({"inside_the_cylinder", room, one, seen({0.55, 0.35, 0.75}, {-0.3, 0.05, -0.2}, 60), 18},
                   {{{0.2, 3, 0.2}, {-0.2, 0, -1.4}, kGreen, 0}}),
        // From above, where no image was taken, little of the object remains; geometry must be complete.
        with_boxes({"straight_down", room, one, seen({0.2, 4.5, 0.1}, {0.2, 0, 0.1}), 15},
                   {{{4, 0.1, 4}, {0, -1.1, 0}, kWall, 0}, {{0.2, 0.2, 3}, {0.6, 1.3, 0}, kGreen, 0}}),
    };
    for (const Case& made : cases) expect_golden(made);
}

TEST_F(Occlusion, AMirroredNodeIsTheMirrorImage) {
    for (const ObjectDepth depth : {ObjectDepth::kPlane, ObjectDepth::kPixel}) {
        Scene scene = test::empty_room();
        scene.lights.clear();  // lights would not be mirrored
        Scene mirrored_scene = scene;
        test::add_box(scene, {0.2, 3, 0.2}, {0.9, 0, 0.6}, kGreen);
        test::add_box(mirrored_scene, {0.2, 3, 0.2}, {-0.9, 0, 0.6}, kGreen);
        for (const double distance : {4.0, 9.0}) {
            const Camera camera = seen({1, 0.5, distance}, {0.5, 0, 0});
            const Camera mirrored_camera = seen({-1, 0.5, distance}, {-0.5, 0, 0});
            const Image<Rgba8> plain = compose(scene, {placed(turned({0.3, 0, 0}, -0.3))}, camera, depth);
            const Image<Rgba8> image =
                compose(mirrored_scene, {placed(turned({-0.3, 0, 0}, 0.3, 1, true))}, mirrored_camera, depth);
            EXPECT_LT(share_different(flipped(plain), image), 0.002) << distance;
            EXPECT_GT(share_different(plain, image), 0.02) << "it must not look the same both ways";
        }
    }
}

// Cases that need per-pixel depth.
TEST_F(Occlusion, DepthsOfPixelsLetThingsReachIntoEachOther) {
    Case pole{"pole_plane", test::empty_room(), {placed()}, seen({4.5, 0.6, 0.5}), 20};
    // Behind the plane and the block, in front of the post.
    test::add_box(pole.scene, {0.1, 0.12, 2.4}, {-0.09, -0.45, 0}, kGreen);
    const Case crossing{"crossing_plane",
                        test::empty_room(),
                        {placed(turned({-0.25, 0, 0.1}, 0.3)), placed(turned({0.35, 0.05, -0.1}, 1.9))},
                        seen({0.3, 0.6, 4.8}),
                        20};
    for (const Case& plane : {pole, crossing}) {
        expect_golden(plane);
        Case pixel = plane;
        pixel.depth = ObjectDepth::kPixel;
        pixel.name = plane.name.substr(0, plane.name.find('_')) + "_pixel";
        pixel.least_truth_db = 24;
        expect_golden(pixel);
        const Image<Rgba8> expected = truth(plane.scene, plane.objects, plane.camera);
        const Image<Rgba8> by_plane = compose(plane.scene, plane.objects, plane.camera);
        const Image<Rgba8> by_pixel = compose(plane.scene, plane.objects, plane.camera, ObjectDepth::kPixel);
        EXPECT_GT(share_different(by_plane, by_pixel), 0.005) << plane.name;
        EXPECT_GT(truth_db(by_pixel, expected), truth_db(by_plane, expected) + 1.5) << plane.name;
    }
}

}  // namespace
}  // namespace rs::compositor
