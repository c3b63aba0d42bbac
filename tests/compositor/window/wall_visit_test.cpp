// Visit with a window per wall on a virtual display. Skipped without Xvfb.

#include "compositor/window/wall_visit.hpp"

#include "rayspace/image_io/image_io.hpp"
#include "tests/compositor/objects.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/virtual_display.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

namespace rs::compositor {
namespace {

using ::testing::HasSubstr;

class WallWindows : public ::testing::Test {
protected:
    static void SetUpTestSuite() { display_ = std::make_unique<test::VirtualDisplay>(); }
    static void TearDownTestSuite() { display_.reset(); }

    void SetUp() override {
        if (!display_->ready()) GTEST_SKIP() << "Xvfb cannot be started (Debian: xvfb)";
        for (const char* name : {"left", "front"}) {
            options_.display.walls.push_back({name,
                                              {-1.5, 0, name[0] == 'l' ? 1.5 : -1.5},
                                              {name[0] == 'l' ? -1.5 : 1.5, 0, -1.5},
                                              {-1.5, 3, name[0] == 'l' ? 1.5 : -1.5},
                                              120,
                                              90});
        }
        options_.heads = {Head{.position = {0, 1.5, 0}}};
        options_.images = work_.path();
        options_.frame.samples = 1;
        options_.window.vertical_sync = false;
        options_.window.context = {.debug = true, .at_end = [this](const std::vector<std::string>& left) {
                                       left_.insert(left_.end(), left.begin(), left.end());
                                   }};
    }
    void TearDown() override {
        visit_.reset();
        EXPECT_THAT(left_, ::testing::IsEmpty());
    }

    Result<std::unique_ptr<WallVisit>> opened() {
        Scene scene;
        GeometryNode box;
        box.mesh = std::make_shared<const Mesh>(box_mesh({0.5, 0.5, 0.5}));
        box.material.lit = false;
        box.material.diffuse = {1, 0, 0};
        box.world_from_node[3] = glm::dvec4(0, 1.5, -4, 1);
        scene.geometry.push_back(box);
        box.mesh = std::make_shared<const Mesh>(box_mesh({30, 0.1, 30}));  // a lit ground with the box's shadow
        box.material = {};
        box.world_from_node[3] = glm::dvec4(0, 0, 0, 1);
        scene.geometry.push_back(box);
        Viewpoint there;
        there.world_from_camera[3] = glm::dvec4(0, 1.5, 10, 1);
        scene.viewpoints = {there};
        return WallVisit::create(scene, std::make_unique<Showroom>(scene, ShowroomOptions{.waits = true}), options_);
    }
    void open() {
        auto visit = opened();
        ASSERT_TRUE(visit.ok()) << visit.error().message;
        visit_ = std::move(*visit);
        ASSERT_TRUE(step());
    }
    bool step(double seconds = 0.1) {
        const auto goes_on = visit_->step(seconds);
        EXPECT_TRUE(goes_on.ok()) << goes_on.error().message;
        return goes_on.ok() && *goes_on;
    }
    void press(Key key, std::size_t window = 0) {
        visit_->windows()[window].inject(KeyEvent{key, true});
        visit_->windows()[window].inject(KeyEvent{key, false});
    }
    [[nodiscard]] double red_middle(std::size_t wall) const {
        const Image<Rgba8>& image = visit_->images()[wall];
        double sum = 0, count = 0;
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                if (image(x, y).r < 200 || image(x, y).g > 60) continue;
                sum += x;
                count += 1;
            }
        }
        return count > 0 ? sum / count : -1;
    }

    static inline std::unique_ptr<test::VirtualDisplay> display_;
    test::TemporaryFolder work_;
    WallVisitOptions options_;
    std::vector<std::string> left_;  // errors and objects of OpenGL after the windows were destroyed
    std::unique_ptr<WallVisit> visit_;
};

TEST_F(WallWindows, EachShowsItsWall) {
    open();
    ASSERT_EQ(visit_->windows().size(), 2U);
    EXPECT_NEAR(red_middle(1), 60, 1);
    EXPECT_EQ(red_middle(0), -1);
}

TEST_F(WallWindows, KeysDriveTheRoomAndMoveTheHead) {
    open();
    visit_->windows()[1].inject(KeyEvent{Key::kTurnRight, true});
    for (int i = 0; i < 5; ++i) ASSERT_TRUE(step(0.2));
    visit_->windows()[1].inject(KeyEvent{Key::kTurnRight, false});
    EXPECT_NE(red_middle(0), -1);  // now it is to the left
    press(Key::kHome);
    press(Key::kExamine);
    visit_->windows()[0].inject(KeyEvent{Key::kRight, true});
    ASSERT_TRUE(step(0.2));
    ASSERT_TRUE(step(0.2));
    EXPECT_GT(visit_->head().position.x, 0.01);
    EXPECT_EQ(visit_->place().position, glm::dvec3(0));
    EXPECT_GT(red_middle(1), 60);  // objects behind the wall move with the head
    // Walls block the head.
    visit_->windows()[0].inject(KeyEvent{Key::kRight, false});
    visit_->windows()[0].inject(KeyEvent{Key::kForward, true});
    for (int i = 0; i < 60; ++i) ASSERT_TRUE(step(0.2));
    EXPECT_GT(visit_->head().position.z, -1.5);
    EXPECT_LT(visit_->head().position.z, -1.3);
}

TEST_F(WallWindows, FollowATrackedHeadButThroughNoWall) {
    std::optional<Head> tracked;
    options_.tracked = [&tracked] { return std::exchange(tracked, std::nullopt); };
    open();
    const double before = red_middle(1);
    const RoomPose place = visit_->place();
    tracked = Head{.position = {0.5, 1.5, 0.2}, .heading_rad = 0.4};
    ASSERT_TRUE(step());
    EXPECT_EQ(visit_->head().position, glm::dvec3(0.5, 1.5, 0.2));
    EXPECT_EQ(visit_->head().heading_rad, 0.4);
    EXPECT_GT(red_middle(1), before + 2);  // objects behind the wall move with the head
    // The room does not move.
    EXPECT_NEAR(glm::distance(visit_->place().position, place.position), 0, 1e-12);
    EXPECT_NEAR(visit_->place().heading_rad, place.heading_rad, 1e-12);
    // Behind the front wall, and in the plane of the left one: the last valid head is kept.
    for (const glm::dvec3& behind : {glm::dvec3(0, 1.5, -1.6), glm::dvec3(-1.5, 1.5, 0)}) {
        tracked = Head{.position = behind};
        ASSERT_TRUE(step());
        EXPECT_EQ(visit_->head().position, glm::dvec3(0.5, 1.5, 0.2));
    }
    // Nothing new: it is kept, too.
    ASSERT_TRUE(step());
    EXPECT_EQ(visit_->head().position, glm::dvec3(0.5, 1.5, 0.2));
}

TEST_F(WallWindows, GoToViewpointsTakeImagesAndLeave) {
    options_.stereo = StereoForm::kAnaglyph;
    open();
    press(Key::kNextViewpoint);
    press(Key::kScreenshot, 1);
    ASSERT_TRUE(step());
    EXPECT_EQ(visit_->place().position.z, 10);
    EXPECT_TRUE(read_image(work_.path() / "wall-front-1.png").ok());
    EXPECT_TRUE(read_image(work_.path() / "wall-left-1.png").ok());
    press(Key::kQuit, 1);
    EXPECT_FALSE(step());
}

TEST_F(WallWindows, TraceLightWhileNothingMoves) {
    options_.stereo = StereoForm::kSideBySide;
    options_.tracing.method = TracedMethod::kWhitted;
    open();
    const std::vector<Image<Rgba8>> raster = visit_->images();
    press(Key::kTrace);
    const auto patience = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    const auto trace = [&] {
        do {
            ASSERT_TRUE(step(0.001));
        } while (visit_->passes() < 4 && std::chrono::steady_clock::now() < patience);  // in the second round
        ASSERT_GE(visit_->passes(), 4);
    };
    trace();
    EXPECT_TRUE(visit_->is_traced());
    for (const std::size_t wall : {0U, 1U}) {
        EXPECT_EQ(visit_->images()[wall].width(), raster[wall].width());
        EXPECT_NE(visit_->images()[wall], raster[wall]);
    }
    visit_->windows()[0].inject(KeyEvent{Key::kForward, true});
    ASSERT_TRUE(step(0.05));
    EXPECT_EQ(visit_->passes(), 0);
    visit_->windows()[0].inject(KeyEvent{Key::kForward, false});
    press(Key::kHome);
    trace();
    press(Key::kTrace);
    ASSERT_TRUE(step(0.001));
    EXPECT_EQ(visit_->images(), raster);
}

TEST_F(WallWindows, TwoFoldersAreNoWindow) {
    options_.stereo = StereoForm::kFolders;
    const auto visit = opened();
    ASSERT_FALSE(visit.ok());
    EXPECT_THAT(visit.error().message, HasSubstr("--stereo folders is for -o"));
}

}  // namespace
}  // namespace rs::compositor
