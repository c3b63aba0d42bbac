// Composited frames against references of the same room, in small size; bench_truth is the full comparison. Skipped
// without OpenGL.

#include "tests/compositor/gl_test.hpp"
#include "tests/compositor/occlusion_scene.hpp"
#include "tests/compositor/truth_comparison.hpp"
#include "tests/compositor/truth_scene.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

namespace rs::test {
namespace {

constexpr int kTruthWidth = 320;
constexpr int kTruthHeight = 180;

class Truth : public GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        if (!context_) return;
        // The room's own objects take minutes to capture; the signpost replaces them.
        Result<compositor::Scene> scene = write_truth_room(folder_.path());
        ASSERT_TRUE(scene) << scene.error().message;
        scene_ = std::move(*scene);
        for (const compositor::RaySpaceNode& node : scene_.objects) {
            placed_.push_back(compositor::place(captured_signpost().viewable, node));
            traced_.push_back({captured_signpost().traced, placed_.back().world_from_object});
        }
    }

    TemporaryFolder folder_;
    compositor::Scene scene_;
    std::vector<compositor::PlacedObject> placed_;
    std::vector<TracedNode> traced_;
};

TEST_F(Truth, FramesAreNearIt) {
    auto comparison = TruthComparison::create(scene_, placed_, traced_, {.width = kTruthWidth, .height = kTruthHeight});
    ASSERT_TRUE(comparison) << comparison.error().message;
    const std::vector<TruthViewpoint> walk = truth_walk(kTruthWidth, kTruthHeight);
    int cuts = 0;
    for (const std::size_t i : {0, 1, 5}) {
        const Result<TruthDifference> found =
            comparison->compare(walk[i].camera, {.samples = 16, .paths_per_sample = 1});
        ASSERT_TRUE(found) << found.error().message;
        std::printf("%-20s objects %.2f dB, elsewhere %.2f dB, %d cuts, farthest %.2f px\n", walk[i].what.c_str(),
                    found->objects_db, found->elsewhere_db, found->cuts.places, found->cuts.largest_px);
        EXPECT_GE(found->objects_db, 25) << walk[i].what;
        EXPECT_GE(found->elsewhere_db, 37) << walk[i].what;
        EXPECT_LE(found->cuts.largest_px, 1.5) << walk[i].what;
        EXPECT_GT(found->object_share, 0.01) << walk[i].what << ": it must show objects";
        cuts += found->cuts.places;
    }
    EXPECT_GT(cuts, 50) << "geometry must cut objects";
}

// The comparison detects displaced objects, and geometry that hides too much.
TEST_F(Truth, ErrorsAreSeen) {
    const Camera camera = truth_walk(kTruthWidth, kTruthHeight)[0].camera;
    const TruthOptions options{.samples = 8, .paths_per_sample = 1};
    const compositor::FrameOptions frame{.width = kTruthWidth, .height = kTruthHeight};
    auto right = TruthComparison::create(scene_, placed_, traced_, frame);
    ASSERT_TRUE(right);
    const double objects_db = right->compare(camera, options)->objects_db;
    auto one_sample = TruthComparison::create(scene_, placed_, traced_,
                                              {.width = kTruthWidth, .height = kTruthHeight, .object_samples = 1});
    ASSERT_TRUE(one_sample);
    EXPECT_LT(one_sample->compare(camera, options)->objects_db, objects_db - 1) << "far objects are averaged";
    for (TracedNode& node : traced_) node.world_from_object.translation.x += 0.015;  // about two pixels
    auto moved = TruthComparison::create(scene_, placed_, traced_, frame);
    ASSERT_TRUE(moved);
    EXPECT_LT(moved->compare(camera, options)->objects_db, objects_db - 3);
    // Nearer to the eye and smaller: the same image, but in front of the pillars.
    const compositor::Similarity nearer{glm::dmat3(1.0), camera.centre() * 0.7, 0.3};
    for (compositor::PlacedObject& object : placed_) object.world_from_object = nearer * object.world_from_object;
    auto before = TruthComparison::create(scene_, placed_, traced_, frame);
    ASSERT_TRUE(before);
    EXPECT_GT(before->compare(camera, options)->cuts.largest_px, 1.5);
}

}  // namespace
}  // namespace rs::test
