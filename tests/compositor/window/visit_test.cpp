// A visit in a window on a virtual display: open, walk, look, pick, turn, take an image, resize, leave. Skipped where
// there is no Xvfb.

#include "compositor/window/visit.hpp"

#include "compositor/viewer/views/framing.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/compositor/moving_boxes.hpp"
#include "tests/compositor/objects.hpp"
#include "tests/support/small_object.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/virtual_display.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>

namespace rs::compositor {
namespace {

constexpr Rgba8 kObjectRed{220, 40, 40, 255};

class VisitInWindow : public ::testing::Test {
protected:
    static void SetUpTestSuite() { display_ = std::make_unique<test::VirtualDisplay>(); }
    static void TearDownTestSuite() { display_.reset(); }

    void SetUp() override {
        if (!display_->ready()) GTEST_SKIP() << "Xvfb cannot be started (Debian: xvfb)";
        Scene scene;
        GeometryNode wall;
        wall.mesh = std::make_shared<const Mesh>(box_mesh({4, 4, 0.1}));
        wall.world_from_node[3] = glm::dvec4(0, 0, -4, 1);
        scene.geometry.push_back(wall);
        RaySpaceNode drum;
        drum.file = "drum.rso";
        drum.standing = false;
        drum.description = "a red drum";
        scene.objects.push_back(drum);
        VisitOptions options;
        Viewpoint front;
        front.world_from_camera[3] = glm::dvec4(0, 0, 6, 1);
        Viewpoint side = front;
        side.world_from_camera[3] = glm::dvec4(3, 1, 6, 1);
        side.description = "from the side";
        options.viewpoints = {front, side};
        options.images = work_.path();
        options.scene_name = "drum.wrl";
        options.open = [](const std::string& file) -> Status {
            if (file.ends_with(".wrl")) return {};
            return Error{file + ": is no scene"};
        };
        options.load_objects = [](const Scene& more) -> Result<std::unique_ptr<Showroom>> {
            return std::make_unique<Showroom>(more, ShowroomOptions{.waits = true}, nullptr,
                                              std::make_unique<test::ObjectsInMemory>(kObjectRed));
        };
        options.frame.samples = 1;
        auto showroom = std::make_unique<Showroom>(scene, ShowroomOptions{.waits = true}, nullptr,
                                                   std::make_unique<test::ObjectsInMemory>(kObjectRed));
        WindowOptions small{.title = "test", .width = 320, .height = 240, .vertical_sync = false};
        small.context = {.debug = true, .at_end = [this](const std::vector<std::string>& left) { left_ = left; }};
        auto window = Window::create(small);
        ASSERT_TRUE(window.ok()) << window.error().message;
        auto visit = Visit::create(std::move(*window), scene, std::move(showroom), options);
        ASSERT_TRUE(visit.ok()) << visit.error().message;
        visit_ = std::move(*visit);
        ASSERT_TRUE(step());
    }
    void TearDown() override {
        if (!visit_) return;
        EXPECT_FALSE(visit_->window().context().live_objects().empty());
        visit_.reset();
        ASSERT_TRUE(left_.has_value());
        EXPECT_THAT(*left_, ::testing::IsEmpty());
    }

    bool step(double seconds = 0.1) {
        const auto goes_on = visit_->step(seconds);
        EXPECT_TRUE(goes_on.ok()) << goes_on.error().message;
        return goes_on.ok() && *goes_on;
    }
    void drop(const std::string& file, const glm::dvec2& at) { visit_->window().inject(DropEvent{{file}, at}); }
    void press(Key key) {
        visit_->window().inject(KeyEvent{key, true});
        visit_->window().inject(KeyEvent{key, false});
    }
    [[nodiscard]] int red_pixels() const {
        const Image<Rgba8> image = visit_->image();
        int count = 0;
        for (const Rgba8 p : image.pixels()) count += p.r > 150 && p.g < 90;
        return count;
    }

    static inline std::unique_ptr<test::VirtualDisplay> display_;
    test::TemporaryFolder work_;
    std::optional<std::vector<std::string>> left_;  // of OpenGL, when the window was gone
    std::unique_ptr<Visit> visit_;
};

TEST_F(VisitInWindow, OpensWithAToolbarThatNamesSceneAndViewpoints) {
    EXPECT_FALSE(visit_->panel().show_panel);
    EXPECT_FALSE(visit_->panel().show_help);
    EXPECT_EQ(visit_->panel().news, "");
    EXPECT_EQ(visit_->panel().scene, "drum.wrl");
    EXPECT_THAT(visit_->panel().viewpoints, ::testing::ElementsAre("viewpoint 1", "from the side"));
    press(Key::kNextViewpoint);
    ASSERT_TRUE(step());
    EXPECT_EQ(visit_->panel().viewpoint, 1U);
}

TEST_F(VisitInWindow, WalkingMovesWhatIsSeen) {
    const int before = red_pixels();
    EXPECT_GT(before, 500);
    visit_->window().inject(KeyEvent{Key::kForward, true});
    for (int n = 0; n < 10; ++n) ASSERT_TRUE(step());
    visit_->window().inject(KeyEvent{Key::kForward, false});
    ASSERT_TRUE(step());
    EXPECT_NEAR(visit_->visitor().eye.z, 5, 1e-9);
    EXPECT_GT(red_pixels(), before * 5 / 4);
    EXPECT_TRUE(visit_->panel().objects[0].in_view);
    EXPECT_GT(visit_->panel().objects[0].width, 10);
    // Turned around, nothing of it is left.
    visit_->window().inject(KeyEvent{Key::kTurnLeft, true});
    for (int n = 0; n < 22; ++n) ASSERT_TRUE(step());
    EXPECT_EQ(red_pixels(), 0);
    EXPECT_FALSE(visit_->panel().objects[0].in_view);
}

TEST_F(VisitInWindow, AClickPicksAndTheWheelZooms) {
    visit_->window().inject(ButtonEvent{Button::kLeft, true, {160, 130}});
    visit_->window().inject(ButtonEvent{Button::kLeft, false, {160, 130}});
    ASSERT_TRUE(step());
    EXPECT_EQ(visit_->panel().picked, 0);
    EXPECT_EQ(visit_->panel().news, "a red drum");
    visit_->window().inject(ButtonEvent{Button::kLeft, true, {316, 236}});
    visit_->window().inject(ButtonEvent{Button::kLeft, false, {316, 236}});
    ASSERT_TRUE(step());
    EXPECT_EQ(visit_->panel().picked, -1);
    press(Key::kExamine);
    ASSERT_TRUE(step());
    const double before = visit_->visitor().pivot_distance;
    visit_->window().inject(WheelEvent{2});
    ASSERT_TRUE(step());
    EXPECT_LT(visit_->visitor().pivot_distance, before);
}

TEST_F(VisitInWindow, ExaminesAClickedObjectUntilEscape) {
    press(Key::kNextViewpoint);  // 3 aside, 1 above, from which the drum is to the left
    for (int n = 0; n < 12; ++n) ASSERT_TRUE(step());
    visit_->window().inject(KeyEvent{Key::kTurnLeft, true});
    for (int n = 0; n < 3; ++n) ASSERT_TRUE(step());
    visit_->window().inject(KeyEvent{Key::kTurnLeft, false});
    ASSERT_TRUE(step());
    const Visitor before = visit_->visitor();
    const Image<Rgba8> image = visit_->image();
    glm::dvec2 drum(-1);
    for (int y = 0; y < image.height() && drum.x < 0; ++y) {
        for (int x = 0; x < image.width() - 6 && drum.x < 0; ++x) {
            if (image(x, y).r > 150 && image(x, y).g < 90 && image(x + 6, y).r > 150) drum = {x + 6, y};
        }
    }
    ASSERT_GE(drum.x, 0);
    const auto click = [&](const glm::dvec2& at) {
        visit_->window().inject(ButtonEvent{Button::kLeft, true, at});
        visit_->window().inject(ButtonEvent{Button::kLeft, false, at});
        for (int n = 0; n < 13; ++n) ASSERT_TRUE(step());
    };
    click(drum);
    EXPECT_EQ(visit_->panel().picked, 0);
    EXPECT_EQ(visit_->panel().mode, NavigationMode::kExamine);
    EXPECT_LT(glm::distance(visit_->visitor().pivot(), glm::dvec3(0)), 0.3);  // the centre of the drum
    const glm::dvec3 pivot = visit_->visitor().pivot();
    visit_->window().inject(KeyEvent{Key::kRight, true});
    for (int n = 0; n < 5; ++n) ASSERT_TRUE(step());
    visit_->window().inject(KeyEvent{Key::kRight, false});
    ASSERT_TRUE(step());
    EXPECT_NEAR(glm::distance(visit_->visitor().pivot(), pivot), 0, 1e-9);
    EXPECT_GT(glm::distance(visit_->visitor().eye, before.eye), 1);
    press(Key::kQuit);  // ends examining instead of the visit
    for (int n = 0; n < 13; ++n) ASSERT_TRUE(step());
    EXPECT_EQ(visit_->panel().mode, NavigationMode::kWalk);
    EXPECT_EQ(visit_->panel().picked, -1);
    EXPECT_NEAR(visit_->visitor().eye.y, before.eye.y, 1e-9);
    press(Key::kQuit);
    EXPECT_FALSE(step());
}

TEST_F(VisitInWindow, DroppedObjectsStandUnderThePointer) {
    RaySpaceObject small = test::small_object();
    small.units_per_radius = 0.5;
    const std::string cup = (work_ / "cup.rso").string();
    ASSERT_TRUE(write_object(cup, small));
    const int before = red_pixels();
    drop(cup, {212, 75});  // the wall beside the drum
    ASSERT_TRUE(step());
    EXPECT_EQ(visit_->object_count(), 2U) << visit_->panel().news;
    EXPECT_EQ(visit_->panel().news, "cup: added");
    ASSERT_TRUE(step());
    EXPECT_GT(red_pixels(), before + 50);
    EXPECT_TRUE(visit_->panel().objects[1].in_view);
    drop(cup, {300, 5});  // the sky
    ASSERT_TRUE(step());
    EXPECT_EQ(visit_->object_count(), 2U);
    EXPECT_THAT(visit_->panel().news, ::testing::HasSubstr("no surface under the pointer"));
}

TEST_F(VisitInWindow, DroppedGarbageIsReportedAndChangesNothing) {
    for (const char* name : {"garbage.rso", "garbage.json", "garbage.txt", "gone.glb"}) {
        const std::string file = (work_ / name).string();
        if (std::string(name) != "gone.glb") std::ofstream(file) << "{garbage";
        const Image<Rgba8> image = visit_->image();
        drop(file, {160, 120});
        ASSERT_TRUE(step());
        EXPECT_THAT(visit_->panel().news, ::testing::HasSubstr(name));
        ASSERT_TRUE(step());
        EXPECT_EQ(visit_->image(), image);
        EXPECT_EQ(visit_->object_count(), 1U);
    }
}

TEST_F(VisitInWindow, DroppedLightsAreLoaded) {
    const std::string lights = (work_ / "evening.json").string();
    std::ofstream(lights) << R"({"replace": true, "lights": [
        {"kind": "point", "candela": 5, "location": [0, 1, 3]}, {"kind": "point", "candela": 5, "location": [1, 1, 3]}]})";
    const Image<Rgba8> image = visit_->image();
    drop(lights, {160, 120});
    for (int n = 0; n < 2; ++n) ASSERT_TRUE(step());
    EXPECT_EQ(visit_->lights().edits().state().entries.size(), 2U) << visit_->panel().news;
    EXPECT_EQ(visit_->lights().profile, lights);
    EXPECT_FALSE(visit_->lights().has_unsaved_edits());
    EXPECT_NE(visit_->image(), image);
}

TEST_F(VisitInWindow, DroppedScenesEndTheVisitUnlessLightsWouldBeLost) {
    LightEntry light = visit_->lights().edits().state().entries.at(0);
    light.colour = {0.2, 0.5, 0.1};
    visit_->lights().edits().set_light(0, light);
    drop("hall.wrl", {160, 120});
    ASSERT_TRUE(step());
    EXPECT_EQ(visit_->panel().unconfirmed, "hall.wrl");
    press(Key::kQuit);  // cancels
    ASSERT_TRUE(step());
    EXPECT_EQ(visit_->panel().unconfirmed, "");
    visit_->lights().profile = (work_ / "saved.json").string();
    ASSERT_TRUE(visit_->lights().save());
    drop("hall.wrl", {160, 120});
    EXPECT_FALSE(step());
}

TEST_F(VisitInWindow, ViewpointsAreTravelledTo) {
    press(Key::kNextViewpoint);
    ASSERT_TRUE(step());
    EXPECT_EQ(visit_->panel().news, "from the side");
    for (int n = 0; n < 12; ++n) ASSERT_TRUE(step());
    EXPECT_NEAR(visit_->visitor().eye.x, 3, 1e-9);
    press(Key::kHome);
    for (int n = 0; n < 12; ++n) ASSERT_TRUE(step());
    EXPECT_NEAR(visit_->visitor().eye.x, 0, 1e-9);
}

TEST_F(VisitInWindow, ImagesAreTakenHome) {
    press(Key::kScreenshot);
    ASSERT_TRUE(step());
    const Result<Image<Rgba8>> shot = read_image(work_ / "screenshot-1.png");
    ASSERT_TRUE(shot.ok()) << shot.error().message;
    EXPECT_EQ(*shot, visit_->image());
    press(Key::kScreenshot);
    ASSERT_TRUE(step());
    EXPECT_TRUE(std::filesystem::exists(work_ / "screenshot-2.png"));
    press(Key::kRecord);
    for (int n = 0; n < 5; ++n) ASSERT_TRUE(step());
    EXPECT_TRUE(visit_->panel().recording);
    press(Key::kRecord);
    ASSERT_TRUE(step());
    EXPECT_TRUE(std::filesystem::exists(work_ / "recording-1.mp4"));
}

TEST_F(VisitInWindow, TTracesTheLightAndHoldsTheViewStill) {
    const int red_before = red_pixels();
    const Image<Rgba8> raster = visit_->image();
    EXPECT_EQ(frozen_notice(visit_->panel()), "");
    press(Key::kTrace);
    const auto patience = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (visit_->panel().passes < 2 && std::chrono::steady_clock::now() < patience) ASSERT_TRUE(step(0.001));
    ASSERT_GE(visit_->panel().passes, 2);
    EXPECT_NE(visit_->image(), raster);         // the wall is lit by other means,
    EXPECT_NEAR(red_pixels(), red_before, 20);  // the drum stands before it as it did,
    EXPECT_THAT(frozen_notice(visit_->panel()), ::testing::HasSubstr("T releases it"));
    const glm::dvec3 eye = visit_->visitor().eye;  // and the visitor stands still.
    visit_->window().inject(KeyEvent{Key::kForward, true});
    ASSERT_TRUE(step(1));
    EXPECT_EQ(visit_->visitor().eye, eye);
    visit_->window().inject(KeyEvent{Key::kForward, false});
    press(Key::kTrace);
    ASSERT_TRUE(step(0.001));
    EXPECT_EQ(visit_->image(), raster);
    EXPECT_EQ(frozen_notice(visit_->panel()), "");
}

TEST_F(VisitInWindow, WhoStandsStillFindsTheTracerMade) {
    visit_->window().inject(KeyEvent{Key::kForward, true});
    for (int n = 0; n < 15; ++n) ASSERT_TRUE(step(0.1));
    EXPECT_FALSE(visit_->has_tracer());
    visit_->window().inject(KeyEvent{Key::kForward, false});
    for (int n = 0; n < 8; ++n) ASSERT_TRUE(step(0.1));
    EXPECT_FALSE(visit_->has_tracer());
    for (int n = 0; n < 6; ++n) ASSERT_TRUE(step(0.1));
    EXPECT_TRUE(visit_->has_tracer());
    const Image<Rgba8> raster = visit_->image();
    ASSERT_TRUE(step(0.1));
    EXPECT_EQ(visit_->image(), raster) << "nothing is shown of it";
}

TEST_F(VisitInWindow, WhoWalksOnByTracedLightSeesWhereHeGoes) {
    press(Key::kTrace);
    visit_->walk_on(true);
    EXPECT_EQ(frozen_notice(visit_->panel()), "");
    const auto patience = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    const auto wait_for = [&](int passes) {
        while (visit_->panel().passes < passes && std::chrono::steady_clock::now() < patience) {
            ASSERT_TRUE(step(0.001));
        }
        ASSERT_GE(visit_->panel().passes, passes);
    };
    wait_for(1);
    const Image<Rgba8> before = visit_->image();
    const glm::dvec3 eye = visit_->visitor().eye;
    visit_->window().inject(KeyEvent{Key::kForward, true});
    // The view never stands still, and yet there are images of it.
    Image<Rgba8> last = before;
    int images = 0;
    while (images < 3 && std::chrono::steady_clock::now() < patience) {
        ASSERT_TRUE(step(0.01));
        if (visit_->image() != last) ++images;
        last = visit_->image();
    }
    EXPECT_EQ(images, 3);
    EXPECT_NE(visit_->visitor().eye, eye);
    visit_->window().inject(KeyEvent{Key::kForward, false});
    ASSERT_TRUE(step(0.001));
    wait_for(2);
    EXPECT_NE(visit_->image(), before);
}

TEST_F(VisitInWindow, SwitchesSwitchAndEscapeLeaves) {
    const bool panel = visit_->panel().show_panel;
    for (const Key key : {Key::kHelp, Key::kPanel, Key::kWireFrame, Key::kFly}) press(key);
    ASSERT_TRUE(step());
    EXPECT_TRUE(visit_->panel().show_help);
    EXPECT_NE(visit_->panel().show_panel, panel);
    EXPECT_TRUE(visit_->panel().wire_frame);
    EXPECT_EQ(visit_->panel().mode, NavigationMode::kFly);
    press(Key::kQuit);
    EXPECT_FALSE(step());
}

class SequenceInWindow : public ::testing::Test {
protected:
    static void SetUpTestSuite() { display_ = std::make_unique<test::VirtualDisplay>(); }
    static void TearDownTestSuite() { display_.reset(); }

    void SetUp() override {
        if (!display_->ready()) GTEST_SKIP() << "Xvfb cannot be started (Debian: xvfb)";
        open(true);
    }
    void open(bool follows_sequence) {
        const std::shared_ptr<const Sequence> sequence = test::moving_boxes(4, 3);
        VisitOptions options;
        options.sequence = sequence;
        options.follows_sequence = follows_sequence;
        options.viewpoints = {viewpoint_of(camera_of(*sequence, 0, 160, 120))};
        options.images = work_.path();
        options.frame.samples = 1;
        auto showroom = std::make_unique<Showroom>(sequence->scene, ShowroomOptions{.waits = true});
        WindowOptions small{.title = "test", .width = 160, .height = 120, .vertical_sync = false};
        small.context = {.debug = true, .at_end = [this](const std::vector<std::string>& left) { left_ = left; }};
        auto window = Window::create(small);
        ASSERT_TRUE(window.ok()) << window.error().message;
        auto visit = Visit::create(std::move(*window), sequence->scene, std::move(showroom), options);
        ASSERT_TRUE(visit.ok()) << visit.error().message;
        visit_ = std::move(*visit);
        press(Key::kPlay);  // stops
        ASSERT_TRUE(step());
    }
    void TearDown() override {
        if (!visit_) return;
        visit_.reset();
        ASSERT_TRUE(left_.has_value());
        EXPECT_THAT(*left_, ::testing::IsEmpty());
    }

    bool step() {
        const auto goes_on = visit_->step(0.001);
        EXPECT_TRUE(goes_on.ok()) << goes_on.error().message;
        return goes_on.ok() && *goes_on;
    }
    void press(Key key) {
        visit_->window().inject(KeyEvent{key, true});
        visit_->window().inject(KeyEvent{key, false});
    }
    Playback& playback() { return *visit_->panel().playback; }
    // Image with two passes of the current frame and lights.
    Image<Rgba8> traced() {
        const auto patience = std::chrono::steady_clock::now() + std::chrono::minutes(3);
        do {
            EXPECT_TRUE(step());
        } while (visit_->panel().passes < 2 && std::chrono::steady_clock::now() < patience);
        EXPECT_TRUE(visit_->panel().traced) << visit_->panel().news;
        EXPECT_GE(visit_->panel().passes, 2);
        return visit_->image();
    }
    void dim_a_light() {
        LightEntry light = visit_->lights().edits().state().entries.at(0);
        light.colour = {0.2, 0.5, 0.1};
        visit_->lights().edits().set_light(0, light);
    }

    static inline std::unique_ptr<test::VirtualDisplay> display_;
    test::TemporaryFolder work_;
    std::optional<std::vector<std::string>> left_;  // errors and objects of OpenGL after the window was destroyed
    std::unique_ptr<Visit> visit_;
};

TEST_F(SequenceInWindow, TheCameraIsTheFirstViewpointOnRequest) {
    EXPECT_TRUE(playback().camera(160, 120));
    visit_.reset();
    open(false);
    ASSERT_TRUE(visit_);
    EXPECT_FALSE(playback().camera(160, 120));
    const Image<Rgba8> first = visit_->image();
    press(Key::kFrameOn);
    ASSERT_TRUE(step());
    EXPECT_NE(visit_->image(), first);  // the boxes move
}

TEST_F(SequenceInWindow, FramesAreTracedWithTheEditedLights) {
    const Image<Rgba8> raster = visit_->image();
    press(Key::kTrace);
    const Image<Rgba8> first = traced();
    EXPECT_NE(first, raster);
    press(Key::kFrameOn);  // to a frame without the last box
    const Image<Rgba8> second = traced();
    EXPECT_EQ(playback().frame(), 1U);
    EXPECT_NE(second, first);
    dim_a_light();
    EXPECT_NE(traced(), second);
    press(Key::kFrameBack);
    EXPECT_NE(traced(), first);
    press(Key::kUndo);
    press(Key::kTrace);
    ASSERT_TRUE(step());
    EXPECT_EQ(playback().frame(), 0U);
    EXPECT_EQ(visit_->image(), raster);
}

TEST_F(SequenceInWindow, WeatherChangesAndEditedLightsStay) {
    const Image<Rgba8> fair = visit_->image();
    playback().set_weather(Weather{.fog = true, .visibility = 25});
    ASSERT_TRUE(step());
    const Image<Rgba8> fog = visit_->image();
    EXPECT_NE(fog, fair);
    playback().set_weather(Weather{.rain = true});
    ASSERT_TRUE(step());
    EXPECT_NE(visit_->image(), fog);
    playback().set_weather(std::nullopt);
    ASSERT_TRUE(step());
    EXPECT_EQ(visit_->image(), fair);
    dim_a_light();
    ASSERT_TRUE(step());
    const LightingState edited = visit_->lights().edits().state();
    const Image<Rgba8> dim = visit_->image();
    EXPECT_NE(dim, fair);
    playback().set_weather(Weather{.snow = true});
    ASSERT_TRUE(step());
    EXPECT_NE(visit_->image(), dim);
    playback().set_weather(std::nullopt);
    ASSERT_TRUE(step());
    EXPECT_EQ(visit_->lights().edits().state(), edited);
    EXPECT_EQ(visit_->image(), dim);
}

TEST(WindowWithoutDisplay, SaysWhatToDo) {
    const char* const display = std::getenv("DISPLAY");
    const std::string before = display != nullptr ? display : "";
    unsetenv("DISPLAY");
    const auto window = Window::create({});
    if (!before.empty()) setenv("DISPLAY", before.c_str(), 1);
    ASSERT_FALSE(window.ok());
    EXPECT_NE(window.error().message.find("rs-view render"), std::string::npos) << window.error().message;
}

}  // namespace
}  // namespace rs::compositor
