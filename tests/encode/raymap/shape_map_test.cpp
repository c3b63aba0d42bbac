// Shape maps estimated from images, for regular and unusual sets.

#include "encode/raymap/shape_map.hpp"

#include "encode/build.hpp"
#include "engine/core/fast/renderer.hpp"
#include "engine/core/views/compare.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/format/object_file.hpp"
#include "tests/encode/raymap/drawn_views.hpp"
#include "tests/encode/raymap/striped_ball.hpp"
#include "tests/support/drawn_set.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>

#include <functional>
#include <random>

namespace rs::encode {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

BuiltObject build(const std::filesystem::path& folder, MapKind kind = MapKind::kShape, Progress* progress = nullptr) {
    const Result<CaptureSet> set = open_capture_set(folder);
    EXPECT_TRUE(set.ok()) << set.error().message;
    BuildOptions options;
    options.raymap = kind;
    options.map = default_plane_map(kind);
    Result<BuiltObject> built = build_object(*set, options, progress);
    EXPECT_TRUE(built.ok()) << built.error().message;
    const Status valid = validate_object(built->object, "built");
    EXPECT_TRUE(valid.ok()) << valid.error().message;
    return std::move(*built);
}

double psnr_of(const BuiltObject& built, const std::filesystem::path& truth) {
    const Result<engine::Renderer> renderer = engine::Renderer::create(built.object);
    EXPECT_TRUE(renderer.ok());
    const Result<engine::Comparison> comparison = engine::compare_with_set(*renderer, truth);
    EXPECT_TRUE(comparison.ok()) << comparison.error().message;
    return comparison->mean_psnr_db;
}

// `count` cameras above the object, the first at an azimuth.
Rig ring_above(int count, double first_deg, double elevation_deg) {
    return make_ring({.count = count,
                      .distance = 3.5,
                      .elevation_rad = radians(elevation_deg),
                      .fl_px = 180,
                      .width = 128,
                      .height = 112,
                      .first_rad = radians(first_deg)});
}

TEST(ShapeMap, BeatsThePlaneHalfwayAndKeepsCapturedImages) {
    const test::TemporaryFolder folder;
    test::write_drawn_set(folder / "set", drawn_ring(24));
    test::write_drawn_set(folder / "halfway", drawn_ring(24, 7.5));
    const BuiltObject shape = build(folder / "set");
    const BuiltObject plane = build(folder / "set", MapKind::kPlane);
    EXPECT_THAT(shape.warnings, IsEmpty());
    EXPECT_EQ(shape.depths.size(), 4U);
    const double shape_db = psnr_of(shape, folder / "halfway");
    EXPECT_GT(shape_db, psnr_of(plane, folder / "halfway") + 5);
    EXPECT_GT(shape_db, 24);
    EXPECT_NEAR(psnr_of(shape, folder / "set"), psnr_of(plane, folder / "set"), 1e-9);
}

TEST(ShapeMap, RingsHelpOneAnother) {
    const test::TemporaryFolder folder;
    Rig rings;
    for (const double elevation_deg : {2.0, 10.0, 18.0}) {
        const Rig more = ring_above(16, 0, elevation_deg);
        rings.views.insert(rings.views.end(), more.views.begin(), more.views.end());
    }
    rings.object_radius = 0.9;
    test::write_drawn_set(folder / "set", rings, striped_ball);
    Rig between = ring_above(12, 4, 6);
    between.object_radius = 0.9;
    test::write_drawn_set(folder / "between", between, striped_ball);
    EXPECT_GT(psnr_of(build(folder / "set"), folder / "between"), 17);
}

TEST(ShapeMap, ARingThatContradictsIsLeftOut) {
    const test::TemporaryFolder folder;
    Rig one = ring_above(16, 0, 2);
    one.object_radius = 0.9;
    Rig two = one;
    Rig turned_wrong = ring_above(16, 0, 10);
    for (RigView& view : turned_wrong.views) view.camera.cx += 12;
    two.views.insert(two.views.end(), turned_wrong.views.begin(), turned_wrong.views.end());
    // Images are drawn with the correct cameras; the second ring then gets wrong parameters.
    Rig right = two;
    for (RigView& view : right.views) view.camera.cx = one.views[0].camera.cx;
    test::write_drawn_set(folder / "one", one, striped_ball);
    test::write_drawn_set(folder / "two", right, striped_ball);
    for (std::size_t i = 0; i < two.views.size(); ++i) two.views[i].file_path = std::to_string(i) + ".png";
    ASSERT_TRUE(write_rig(folder / "two" / kRigFileName, two).ok());
    Rig between = ring_above(8, 11.25, 2);
    between.object_radius = 0.9;
    test::write_drawn_set(folder / "between", between, striped_ball);
    EXPECT_GT(psnr_of(build(folder / "two"), folder / "between"),
              psnr_of(build(folder / "one"), folder / "between") - 0.5);
}

TEST(ShapeMap, APartThatOneCutOutLacksIsNotLostSeenFromElsewhere) {
    const test::TemporaryFolder folder;
    test::write_drawn_set(folder / "set", drawn_ring(24), striped_ball);
    Rig halfway = drawn_ring(24, 7.5);
    halfway.views.erase(halfway.views.begin() + 6, halfway.views.begin() + 18);
    test::write_drawn_set(folder / "halfway", halfway, striped_ball);
    const double whole_db = psnr_of(build(folder / "set"), folder / "halfway");
    const std::filesystem::path lacking = folder / "set" / "12.png";
    Result<Image<Rgba8>> image = read_image(lacking);
    ASSERT_TRUE(image.ok());
    for (int y = 20; y < 44; ++y) {
        for (int x = 52; x < 76; ++x) (*image)(x, y) = {};
    }
    ASSERT_TRUE(write_png(lacking, *image).ok());
    EXPECT_GT(psnr_of(build(folder / "set"), folder / "halfway"), whole_db - 0.02);  // 0.06 less if it is lost
}

// Makes a square of an image of a set transparent.
void make_transparent(const std::filesystem::path& image_file, int left, int top, int side) {
    Result<Image<Rgba8>> image = read_image(image_file);
    ASSERT_TRUE(image.ok());
    for (int y = top; y < top + side; ++y) {
        for (int x = left; x < left + side; ++x) (*image)(x, y) = {};
    }
    ASSERT_TRUE(write_png(image_file, *image).ok());
}

TEST(ShapeMap, ALargePartThatFewCutOutsLackIsPaintedFromThoseBeside) {
    const test::TemporaryFolder folder;
    test::write_drawn_set(folder / "set", drawn_ring(24), mottled_ball);
    test::write_drawn_set(folder / "whole", drawn_ring(24), mottled_ball);
    for (const char* const lacking : {"7.png", "15.png"}) make_transparent(folder / "set" / lacking, 48, 40, 32);
    const BuiltObject built = build(folder / "set");
    std::vector<int> completed;
    for (const auto& [view, image] : built.completed) completed.push_back(view);
    EXPECT_EQ(completed, (std::vector<int>{7, 15}));
    EXPECT_THAT(built.warnings, Contains(HasSubstr("2 masks lack a large part")));
    EXPECT_GT(psnr_of(built, folder / "whole"), psnr_of(built, folder / "set"));
    const Result<CaptureSet> whole = open_capture_set(folder / "whole");
    ASSERT_TRUE(whole.ok());
    const Result<Image<Rgba8>> truth = read_upright_image(*whole, 7);
    ASSERT_TRUE(truth.ok());
    int lost = 0, back = 0;
    for (int y = 40; y < 72; ++y) {
        for (int x = 48; x < 80; ++x) {
            if ((*truth)(x, y).a < 255) continue;
            ++lost;
            back += built.completed.at(7)(x, y).a >= 128 ? 1 : 0;
        }
    }
    EXPECT_GT(lost, 400);
    EXPECT_GT(back, lost * 3 / 4);  // its corners are rounded
}

TEST(ShapeMap, ExactSilhouettesAreNotSearchedForWhatTheyLack) {
    class LabelRecorder final : public Progress {
    public:
        void start(const std::string& label, std::int64_t) override { labels.push_back(label); }
        void advance(std::int64_t) override {}
        void finish() override {}
        std::vector<std::string> labels;
    };
    const test::TemporaryFolder folder;
    test::write_drawn_set(folder / "set", drawn_ring(24), mottled_ball);
    LabelRecorder whole, lacking;
    build(folder / "set", MapKind::kShape, &whole);
    EXPECT_THAT(whole.labels, Contains("depth"));
    EXPECT_THAT(whole.labels, Not(Contains("depth at half size")));
    make_transparent(folder / "set" / "7.png", 20, 56, 32);
    build(folder / "set", MapKind::kShape, &lacking);
    EXPECT_THAT(lacking.labels, Contains("depth at half size"));
    // Inaccurate cameras: the silhouettes agree within some pixels only.
    Rig off = drawn_ring(24);
    for (std::size_t i = 0; i < off.views.size(); ++i) {
        off.views[i].camera.cx += i % 2 == 0 ? 2 : -2;
        off.views[i].file_path = std::to_string(i) + ".png";
    }
    test::write_drawn_set(folder / "off", drawn_ring(24), mottled_ball);
    ASSERT_TRUE(write_rig(folder / "off" / kRigFileName, off).ok());
    LabelRecorder wide;
    build(folder / "off", MapKind::kShape, &wide);
    EXPECT_THAT(wide.labels, Contains("depth at half size"));
}

TEST(ShapeMap, WhereManyCutOutsSeemToLackAPartTheRigIsAtFault) {
    const test::TemporaryFolder folder;
    test::write_drawn_set(folder / "set", drawn_ring(24), mottled_ball);
    const auto cut = [&](int view) { make_transparent(folder / "set" / (std::to_string(view) + ".png"), 40, 32, 48); };
    for (const int view : {0, 5, 10, 14}) cut(view);
    EXPECT_EQ(build(folder / "set").completed.size(), 4U);
    cut(19);
    EXPECT_TRUE(build(folder / "set").completed.empty());
}

TEST(ShapeMap, IsTheSameEveryTime) {
    const test::TemporaryFolder folder;
    test::write_drawn_set(folder / "set", drawn_ring(10));
    EXPECT_EQ(build(folder / "set").object.rings, build(folder / "set").object.rings);
}

TEST(ShapeMap, LevelsAndLinesFollowUnequalSteps) {
    const test::TemporaryFolder folder;
    Rig rig = drawn_ring(36);
    // 10-degree steps with gaps of 20 and 30 degrees.
    rig.views.erase(rig.views.begin() + 7);
    rig.views.erase(rig.views.begin() + 20, rig.views.begin() + 22);
    test::write_drawn_set(folder / "set", rig);
    test::write_drawn_set(folder / "halfway", drawn_ring(36, 5));
    const BuiltObject shape = build(folder / "set");
    EXPECT_THAT(shape.warnings, IsEmpty());
    const auto& gaps = shape.object.rings[0].shape.gaps;
    EXPECT_EQ(gaps[0].lines, 4);  // 2 degrees apart, also from the captured images
    EXPECT_EQ(gaps[6].lines, 9);
    EXPECT_EQ(gaps[19].lines, 14);
    EXPECT_GT(psnr_of(shape, folder / "halfway"),
              psnr_of(build(folder / "set", MapKind::kPlane), folder / "halfway") + 4);
}

TEST(ShapeMap, AMissingSectorIsSaidAndNotInvented) {
    const test::TemporaryFolder folder;
    Rig rig = drawn_ring(36);
    rig.views.erase(rig.views.begin() + 10, rig.views.begin() + 19);
    test::write_drawn_set(folder / "set", rig);
    const BuiltObject shape = build(folder / "set");
    EXPECT_THAT(shape.warnings, Contains(HasSubstr("no images between 90 and 190 degrees")));
    EXPECT_EQ(shape.object.rings[0].shape.gaps[9].lines, 0);
}

TEST(ShapeMap, TwoViews) {
    const test::TemporaryFolder folder;
    Rig rig = drawn_ring(36);
    rig.views.resize(2);
    test::write_drawn_set(folder / "two", rig);
    const BuiltObject two = build(folder / "two");
    EXPECT_THAT(two.warnings, Contains(HasSubstr("no images between 10 and 0 degrees")));
    EXPECT_NEAR(psnr_of(two, folder / "two"), psnr_of(build(folder / "two", MapKind::kPlane), folder / "two"), 1e-9);
    Rig between = drawn_ring(36, 5);
    between.views.resize(1);
    test::write_drawn_set(folder / "between", between);
    EXPECT_GT(psnr_of(two, folder / "between"), 18);
}

TEST(ShapeMap, AnEmptyImageIsNamedAndHurtsNobodyElse) {
    const test::TemporaryFolder folder;
    const Rig rig = drawn_ring(24);
    test::write_drawn_set(folder / "set", rig);
    ASSERT_TRUE(write_png(folder / "set" / "5.png", Image<Rgba8>(128, 112)).ok());
    const BuiltObject shape = build(folder / "set");
    EXPECT_THAT(shape.warnings, Contains(HasSubstr("5.png shows no object")));
    Rig opposite = drawn_ring(24, 7.5);
    opposite.views.erase(opposite.views.begin(), opposite.views.begin() + 12);
    test::write_drawn_set(folder / "halfway", opposite);
    EXPECT_GT(psnr_of(shape, folder / "halfway"), 24);
}

TEST(ShapeMap, AnObjectThatLeavesTheFrameKeepsWhatIsSeen) {
    const test::TemporaryFolder folder;
    const auto narrow = [](double first_deg) {
        Rig rig = make_ring(
            {.count = 36, .distance = 3.5, .fl_px = 330, .width = 128, .height = 72, .first_rad = radians(first_deg)});
        rig.object_radius = 0.9;
        return rig;
    };
    test::write_drawn_set(folder / "set", narrow(0));
    test::write_drawn_set(folder / "halfway", narrow(5));
    const BuiltObject shape = build(folder / "set");
    EXPECT_GT(psnr_of(shape, folder / "halfway"), 20);
    EXPECT_GT(psnr_of(shape, folder / "halfway"),
              psnr_of(build(folder / "set", MapKind::kPlane), folder / "halfway") + 3);
}

// A ball above a floor with a soft blue stain around it, which covers less than half everywhere.
Image<Rgba8> ball_over_stain(const Camera& camera) {
    Image<Rgba8> image(camera.width, camera.height);
    constexpr double kRadius = 0.35;
    constexpr double kFloor = -0.35;
    constexpr double kStain = 0.9;
    const glm::dvec3 eye = camera.centre();
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const glm::dvec3 ray = glm::normalize(camera.ray(x + 0.5, y + 0.5));
            const double along = -glm::dot(ray, eye);
            const double inside = kRadius * kRadius + along * along - glm::dot(eye, eye);
            if (inside >= 0) {
                const glm::dvec3 hit = eye + (along - std::sqrt(inside)) * ray;
                const auto code = [](double wave) { return static_cast<std::uint8_t>(160 + std::lround(90 * wave)); };
                image(x, y) = {code(std::sin(25 * hit.x)), code(std::cos(25 * hit.y)), code(std::sin(25 * hit.z)), 255};
                continue;
            }
            if (ray.y >= 0) continue;
            const glm::dvec3 floor = eye + ((kFloor - eye.y) / ray.y) * ray;
            const double out = (floor.x * floor.x + floor.z * floor.z) / (kStain * kStain);
            if (out >= 1) continue;
            image(x, y) = {30, 80, 250, static_cast<std::uint8_t>(std::lround(110 * (1 - out)))};
        }
    }
    return image;
}

TEST(ShapeMap, WhatIsSoftIsShownBetweenImages) {
    const test::TemporaryFolder folder;
    Rig rig = ring_above(24, 0, 20);
    rig.object_radius = 0.9;
    test::write_drawn_set(folder / "set", rig, ball_over_stain);
    Rig halfway = ring_above(24, 7.5, 20);
    halfway.object_radius = 0.9;
    test::write_drawn_set(folder / "halfway", halfway, ball_over_stain);
    EXPECT_GT(psnr_of(build(folder / "set"), folder / "halfway"), 25) << "the ball alone: 18";
}

}  // namespace
}  // namespace rs::encode
