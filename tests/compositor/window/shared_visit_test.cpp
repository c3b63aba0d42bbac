// Visits that lead, and visits that follow, in windows on a virtual display; the other side is a ViewLeader or a
// ViewFollower of the test. Skipped without Xvfb.

#include "compositor/viewer/views/framing.hpp"
#include "compositor/window/visit.hpp"
#include "compositor/window/wall_visit.hpp"
#include "tests/compositor/moving_boxes.hpp"
#include "tests/compositor/sharing/shared_views.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/virtual_display.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>

namespace rs::compositor {
namespace {

using test::kSharedScene;
using ::testing::HasSubstr;

NetworkEndpoint any_local_port() {
    return {"127.0.0.1", 0};
}

class SharedVisits : public ::testing::Test {
protected:
    static void SetUpTestSuite() { display_ = std::make_unique<test::VirtualDisplay>(); }
    static void TearDownTestSuite() { display_.reset(); }

    void SetUp() override {
        if (!display_->ready()) GTEST_SKIP() << "Xvfb cannot be started (Debian: xvfb)";
        auto leader = ViewLeader::listen(any_local_port(), kSharedScene);
        ASSERT_TRUE(leader.ok()) << leader.error().message;
        leader_ = std::make_shared<ViewLeader>(std::move(*leader));
        follower_ = std::make_shared<ViewFollower>(leader_->place(), kSharedScene,
                                                   FollowerTiming{.first_retry_s = 0.01, .last_retry_s = 0.05});
    }

    void open(const SharingPeers& peers) {
        VisitOptions options;
        options.sequence = sequence_;
        options.viewpoints = {viewpoint_of(camera_of(*sequence_, 0, 160, 120))};
        options.images = work_.path();
        options.frame.samples = 1;
        options.sharing = peers;
        auto window = Window::create({.title = "test", .width = 160, .height = 120, .vertical_sync = false});
        ASSERT_TRUE(window.ok()) << window.error().message;
        auto visit =
            Visit::create(std::move(*window), sequence_->scene,
                          std::make_unique<Showroom>(sequence_->scene, ShowroomOptions{.waits = true}), options);
        ASSERT_TRUE(visit.ok()) << visit.error().message;
        visit_ = std::move(*visit);
        visit_->panel().playback->stop();
    }
    void step() {
        const auto goes_on = visit_->step(0.001);
        ASSERT_TRUE(goes_on.ok()) << goes_on.error().message;
    }
    void press(Key key) {
        visit_->window().inject(KeyEvent{key, true});
        visit_->window().inject(KeyEvent{key, false});
    }
    static bool until(const std::function<bool()>& is_done) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        while (!is_done()) {
            if (std::chrono::steady_clock::now() > end) return false;
        }
        return true;
    }
    // The lights of the sequence's scene, dimmed, as a leader sends them.
    [[nodiscard]] std::string dimmed_lights() const {
        LightEditor editor(sequence_->scene, 0, "lights.json");
        LightEntry light = editor.edits().state().entries.at(0);
        light.colour = {0.2, 0.5, 0.1};
        editor.edits().set_light(0, light);
        return light_list_to_json(list_of(editor.edits().state()), "lights.json").value();
    }

    static inline std::unique_ptr<test::VirtualDisplay> display_;
    test::TemporaryFolder work_;
    const std::shared_ptr<const Sequence> sequence_ = test::moving_boxes(4, 3);
    std::shared_ptr<ViewLeader> leader_;
    std::shared_ptr<ViewFollower> follower_;
    std::unique_ptr<Visit> visit_;
};

TEST_F(SharedVisits, ALeaderSendsWhatItShows) {
    open({leader_, nullptr, "scene.wrl"});
    press(Key::kFrameOn);
    press(Key::kWireFrame);
    LightEntry light = visit_->lights().edits().state().entries.at(0);
    light.colour = {0.2, 0.5, 0.1};
    visit_->lights().edits().set_light(0, light);
    std::optional<std::string> lights;
    ASSERT_TRUE(until([&] {
        step();
        EXPECT_TRUE(follower_->poll().ok());
        if (auto newest = follower_->take_lights()) lights = newest;
        return follower_->view() && follower_->view()->frame == 1 && lights;
    }));
    const SharedView& view = *follower_->view();
    const Viewpoint shown = viewpoint_of(camera_of(*sequence_, 1, 160, 120));
    EXPECT_EQ(view.world_from_camera, shown.world_from_camera);
    EXPECT_DOUBLE_EQ(view.field_of_view_rad, shown.field_of_view_rad);
    EXPECT_TRUE(view.wire_frame);
    EXPECT_EQ(view.renderer, 0);
    EXPECT_EQ(*lights, dimmed_lights());
}

TEST_F(SharedVisits, AFollowerShowsTheSameImage) {
    open({nullptr, follower_, "scene.wrl"});
    step();
    EXPECT_THAT(visit_->panel().news, HasSubstr("no leader"));
    const Image<Rgba8> alone = visit_->image();

    SharedView view;
    const Viewpoint seen = viewpoint_of(camera_of(*sequence_, 2, 160, 120));
    view.world_from_camera = seen.world_from_camera;
    view.field_of_view_rad = seen.field_of_view_rad;
    view.frame = 2;
    const auto receive = [&] {
        leader_->publish(view);
        step();
        return visit_->panel().playback->frame() == view.frame && visit_->panel().wire_frame == view.wire_frame;
    };
    ASSERT_TRUE(until(receive));
    const Image<Rgba8> frame = visit_->image();
    EXPECT_NE(frame, alone);
    press(Key::kFrameBack);  // no effect
    press(Key::kHome);
    ASSERT_TRUE(until(receive));
    step();
    EXPECT_EQ(visit_->image(), frame);

    leader_->set_lights(dimmed_lights());
    ASSERT_TRUE(until([&] { return receive() && visit_->image() != frame; }));
    view.wire_frame = true;
    view.exposure_ev = 1;
    ASSERT_TRUE(until(receive));
    EXPECT_EQ(visit_->lights().edits().state().exposure_ev, 1);

    // The same frame without a leader.
    const Image<Rgba8> followed = visit_->image();
    visit_.reset();
    open({});
    press(Key::kFrameBack);
    press(Key::kWireFrame);
    const auto lights = light_list_from_json(dimmed_lights(), "lights.json");
    ASSERT_TRUE(lights.ok() && visit_->lights().set_lights(*lights, 1, "dimmed").ok());
    step();
    EXPECT_EQ(visit_->image(), followed);
}

TEST_F(SharedVisits, LightsThatDoNotFitAreReported) {
    open({nullptr, follower_, "scene.wrl"});
    leader_->set_lights(R"({"lights": [{"kind": "lamp"}]})");
    EXPECT_TRUE(until([&] {
        leader_->publish({});
        step();
        return visit_->panel().news.find("the leader's lights are not shown: ") != std::string::npos;
    }));
}

class SharedWalls : public SharedVisits {
protected:
    void open_walls(const SharingPeers& peers) {
        WallVisitOptions options;
        options.display.walls = {{"front", {-1.5, 0, -1.5}, {1.5, 0, -1.5}, {-1.5, 3, -1.5}, 120, 90}};
        options.display.head.position = {0, 1.5, 0};
        options.heads = {options.display.head};
        options.frame.samples = 1;
        options.window.vertical_sync = false;
        options.sharing = peers;
        options.warn = [this](const std::vector<std::string>& news) {
            warnings_.insert(warnings_.end(), news.begin(), news.end());
        };
        auto walls = WallVisit::create(
            sequence_->scene, std::make_unique<Showroom>(sequence_->scene, ShowroomOptions{.waits = true}), options);
        ASSERT_TRUE(walls.ok()) << walls.error().message;
        walls_ = std::move(*walls);
    }
    void step_walls() {
        const auto goes_on = walls_->step(0.01);
        ASSERT_TRUE(goes_on.ok()) << goes_on.error().message;
    }

    std::unique_ptr<WallVisit> walls_;
    std::vector<std::string> warnings_;
};

TEST_F(SharedWalls, WallsStandWhereTheLeaderIs) {
    open_walls({nullptr, follower_, "scene.wrl"});
    step_walls();
    EXPECT_THAT(warnings_, ::testing::ElementsAre(HasSubstr("no leader")));
    const Image<Rgba8> before = walls_->images().front();
    SharedView view;
    view.world_from_camera[3] = glm::dvec4(2, 1.5, 9, 1);
    const auto receive = [&] {
        leader_->publish(view);
        step_walls();
        return walls_->place().position == glm::dvec3(2, 0, 9);
    };
    ASSERT_TRUE(until(receive));
    const Image<Rgba8> moved = walls_->images().front();
    EXPECT_NE(moved, before);
    leader_->set_lights(dimmed_lights());
    EXPECT_TRUE(until([&] { return receive() && walls_->images().front() != moved; }));
    view.renderer = 4;
    EXPECT_TRUE(until([&] { return receive() && walls_->is_traced(); }));
}

TEST_F(SharedWalls, ALeaderWithWallsSharesRoomAndHead) {
    open_walls({leader_, nullptr, "scene.wrl"});
    walls_->windows()[0].inject(KeyEvent{Key::kForward, true});
    ASSERT_TRUE(until([&] {
        step_walls();
        EXPECT_TRUE(follower_->poll().ok());
        return follower_->view() && follower_->view()->room && follower_->view()->room->place.position.z < -0.05;
    }));
    const SharedView sent = *follower_->view();
    EXPECT_EQ(glm::dvec3(sent.world_from_camera[3]), sent.room->place.in_scene({0, 1.5, 0}));
    walls_.reset();

    auto second = ViewLeader::listen(any_local_port(), kSharedScene);
    ASSERT_TRUE(second.ok());
    open_walls({nullptr, std::make_shared<ViewFollower>(second->place(), kSharedScene), "scene.wrl"});
    SharedView view = sent;
    view.room->head.position = {0.3, 1.4, 0.2};
    ASSERT_TRUE(until([&] {
        second->publish(view);
        step_walls();
        return walls_->head().position == view.room->head.position;
    }));
    EXPECT_EQ(walls_->place().position, view.room->place.position);
    // A head behind the follower's wall is ignored.
    view.room->head.position = {0, 1.5, -2};
    view.room->place.position.x = 1;
    ASSERT_TRUE(until([&] {
        second->publish(view);
        step_walls();
        return walls_->place().position.x == 1;
    }));
    EXPECT_EQ(walls_->head().position, glm::dvec3(0.3, 1.4, 0.2));
}

}  // namespace
}  // namespace rs::compositor
