// Light editing in a window on a virtual display: handles are dragged, both renderers follow, undo and saved lists
// restore the images. Skipped without Xvfb.

#include "compositor/viewer/views/framing.hpp"
#include "compositor/window/visit.hpp"
#include "rayspace/file/file_output.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/virtual_display.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

namespace rs::compositor {
namespace {

constexpr const char* kLampIes = "TILT=NONE\n1 -1 1 3 2 1 2 0 0 0 1 1 9\n0 45 90\n0 90\n179 100 0\n179 200 0\n";

// Floor with a block and a spot above.
Scene room_with_a_block() {
    Scene scene;
    scene.lights = {point_light({0.5, 1.5, 0.5}, glm::vec3(2))};
    scene.lights[0].kind = LightKind::kSpot;
    scene.lights[0].towards = {0, -1, 0};
    scene.lights[0].cut_off_rad = radians(70);
    scene.lights[0].beam_width_rad = radians(30);
    scene.lights[0].name = "lamp";
    for (const auto& [size, at, colour] :
         {std::tuple(glm::dvec3(20, 0.2, 20), glm::dvec3(0, -0.1, 0), glm::vec3(0.6F)),
          std::tuple(glm::dvec3(1, 1, 1), glm::dvec3(-0.8, 0.5, 0), glm::vec3(0.7F, 0.1F, 0.1F))}) {
        GeometryNode node;
        node.mesh = std::make_shared<const Mesh>(box_mesh(size));
        node.material.diffuse = colour;
        node.world_from_node[3] = glm::dvec4(at, 1);
        scene.geometry.push_back(node);
    }
    return scene;
}

class LightInWindow : public ::testing::Test {
protected:
    static void SetUpTestSuite() { display_ = std::make_unique<test::VirtualDisplay>(); }
    static void TearDownTestSuite() { display_.reset(); }

    void SetUp() override {
        if (!display_->ready()) GTEST_SKIP() << "Xvfb cannot be started (Debian: xvfb)";
        ASSERT_TRUE(write_file(work_ / "lamp.ies", kLampIes));
        const Scene scene = room_with_a_block();
        VisitOptions options;
        Viewpoint front;
        front.world_from_camera = look_at_camera({1, 2, 5}, {0, 0.7, 0}, 1, 4, 3).world_from_camera;
        options.viewpoints = {front};
        options.images = work_.path();
        options.lights = work_ / "profile.json";
        options.frame.samples = 1;
        auto showroom = std::make_unique<Showroom>(scene, ShowroomOptions{.waits = true});
        WindowOptions small{.title = "test", .width = 320, .height = 240, .vertical_sync = false};
        small.context = {.debug = true, .at_end = [this](const std::vector<std::string>& left) { left_ = left; }};
        auto window = Window::create(small);
        ASSERT_TRUE(window.ok()) << window.error().message;
        auto visit = Visit::create(std::move(*window), scene, std::move(showroom), options);
        ASSERT_TRUE(visit.ok()) << visit.error().message;
        visit_ = std::move(*visit);
        camera_ = camera_at(front, 320, 240);
        press(Key::kLights);
        ASSERT_TRUE(step());
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
    [[nodiscard]] glm::dvec2 seen_at(const glm::dvec3& place) const { return glm::dvec2(camera_.project(place)); }
    void click(const glm::dvec2& at) {
        visit_->window().inject(ButtonEvent{Button::kLeft, true, at});
        visit_->window().inject(ButtonEvent{Button::kLeft, false, at});
        ASSERT_TRUE(step());
    }
    // In several frames, as by hand.
    void drag(const glm::dvec2& from, const glm::dvec2& to) {
        visit_->window().inject(ButtonEvent{Button::kLeft, true, from});
        ASSERT_TRUE(step());
        for (int i = 1; i <= 3; ++i) {
            visit_->window().inject(MoveEvent{glm::mix(from, to, i / 3.0)});
            ASSERT_TRUE(step());
        }
        visit_->window().inject(ButtonEvent{Button::kLeft, false, to});
        ASSERT_TRUE(step());
        ASSERT_TRUE(step());
    }
    [[nodiscard]] const LightEntry& light(std::size_t i = 0) { return desk().edits().state().entries.at(i); }
    LightEditor& desk() { return visit_->lights(); }
    // Waits for a complete pass with the current light.
    Image<Rgba8> traced() {
        const auto patience = std::chrono::steady_clock::now() + std::chrono::minutes(3);
        do {
            EXPECT_TRUE(step());
        } while (visit_->panel().passes < 1 && std::chrono::steady_clock::now() < patience);
        EXPECT_GE(visit_->panel().passes, 1);
        return visit_->image();
    }

    static inline std::unique_ptr<test::VirtualDisplay> display_;
    test::TemporaryFolder work_;
    std::optional<std::vector<std::string>> left_;  // errors and objects of OpenGL after the window was destroyed
    std::unique_ptr<Visit> visit_;
    Camera camera_;
};

TEST_F(LightInWindow, AnAxisIsDraggedAndUndone) {
    const Image<Rgba8> before = visit_->image();
    const glm::dvec3 place = light().location;
    click(seen_at(place));
    EXPECT_EQ(desk().edits().selected(), 0U);
    EXPECT_EQ(visit_->image(), before);  // handles are not in the image
    const glm::dvec3 grasped = glm::mix(place, axis_end(light(), HandlePart::kAxisX, camera_), 0.8);
    drag(seen_at(grasped), seen_at(grasped + glm::dvec3(-0.75, 0, 0)));
    EXPECT_LT(glm::distance(light().location, place + glm::dvec3(-0.75, 0, 0)), 1e-6);
    const Image<Rgba8> after = visit_->image();
    EXPECT_NE(after, before);
    press(Key::kUndo);
    ASSERT_TRUE(step());
    EXPECT_EQ(light().location, place);
    EXPECT_EQ(visit_->image(), before);
    press(Key::kRedo);
    ASSERT_TRUE(step());
    EXPECT_EQ(visit_->image(), after);
    EXPECT_EQ(visit_->visitor().eye, glm::dvec3(1, 2, 5));  // the camera did not move
}

TEST_F(LightInWindow, OverTheBlockItSnapsToItsFace) {
    const glm::dvec3 front_of_block(-0.7, 0.4, 0.5);
    drag(seen_at(light().location), seen_at(front_of_block));
    EXPECT_LT(glm::distance(light().location, front_of_block), 0.06);  // a pixel is 2 cm
    EXPECT_LT(glm::distance(light().aim, glm::dvec3(0, 0, 1)), 1e-3);
    press(Key::kUndo);
    ASSERT_TRUE(step());
    EXPECT_EQ(light().aim, glm::dvec3(0, -1, 0));
}

TEST_F(LightInWindow, ACloserLookIsNoDragAndAClickBesideDeselects) {
    click(seen_at(light().location));
    const glm::dvec3 place = light().location;
    drag(seen_at(place), seen_at(place) + glm::dvec2(2, 2));  // jitter of a hand
    EXPECT_EQ(light().location, place);
    EXPECT_FALSE(desk().edits().can_undo());
    click({12, 230});
    EXPECT_FALSE(desk().edits().selected());
}

TEST_F(LightInWindow, TheRefinementFollowsAndUndoGivesItsBytesBack) {
    const Image<Rgba8> raster = visit_->image();
    press(Key::kTrace);
    const Image<Rgba8> before = traced();
    click(seen_at(light().location));
    const glm::dvec3 place = light().location;
    const glm::dvec3 grasped = glm::mix(place, axis_end(light(), HandlePart::kAxisY, camera_), 0.8);
    drag(seen_at(grasped), seen_at(grasped + glm::dvec3(0, 0.5, 0)));
    EXPECT_LT(glm::distance(light().location, place + glm::dvec3(0, 0.5, 0)), 1e-6);
    const Image<Rgba8> moved = traced();
    EXPECT_NE(moved, before);
    // Back in raster, the light is at its dragged position; after undo, the bytes equal those before.
    press(Key::kTrace);
    ASSERT_TRUE(step());
    EXPECT_NE(visit_->image(), raster);
    EXPECT_NE(visit_->image(), moved);
    press(Key::kUndo);
    ASSERT_TRUE(step());
    EXPECT_EQ(visit_->image(), raster);
}

TEST_F(LightInWindow, AProfileComesBackToTheSameImage) {
    desk().add(LightKind::kRectangle, {camera_, [](const glm::dvec2&) { return std::nullopt; }});
    LightEntry panel = light(1);
    panel.location = {0.7, 1.1, 0.3};
    panel.colour = {1, 0.7, 0.3};
    panel.turn_deg = 33.3;
    desk().edits().set_light(1, panel);
    desk().scan_folder(work_.path());
    ASSERT_EQ(desk().files().size(), 1U);
    desk().add(LightKind::kLuminaire, {camera_, [](const glm::dvec2&) { return std::nullopt; }});
    ASSERT_TRUE(step());
    const Image<Rgba8> lit = visit_->image();
    const LightingState state = desk().edits().state();
    ASSERT_EQ(state.entries.size(), 3U);
    ASSERT_TRUE(desk().save());
    while (desk().edits().undo()) {
    }
    ASSERT_TRUE(step());
    EXPECT_NE(visit_->image(), lit);
    const Status loaded = desk().load();
    ASSERT_TRUE(loaded) << loaded.error().message;
    ASSERT_TRUE(step());
    EXPECT_EQ(visit_->image(), lit);
    ASSERT_EQ(desk().edits().state().entries.size(), 3U);
    EXPECT_EQ(light(1), state.entries[1]);
    // An invalid list changes nothing.
    for (const char* wrong : {"{\"lights\": [{\"kind\": \"candle\"}]}", "{",
                              "{\"lights\": [{\"kind\": "
                              "\"directional\", \"aim\": [0, 1, 0], "
                              "\"lux\": 1, \"scope\": 4}]}"}) {
        ASSERT_TRUE(write_file(work_ / "profile.json", std::string(wrong)));
        const Status refused = desk().load();
        ASSERT_FALSE(refused);
        EXPECT_NE(refused.error().message.find("profile.json"), std::string::npos);
        EXPECT_EQ(refused.error().message.find('\n'), std::string::npos);
        ASSERT_TRUE(step());
        EXPECT_EQ(visit_->image(), lit);
    }
}

TEST_F(LightInWindow, WarnsOfLightsWithoutPower) {
    click(seen_at(light().location));
    ASSERT_TRUE(step());
    EXPECT_EQ(desk().warning(), "");
    LightEntry dark = light();
    dark.power = 0;
    desk().edits().set_light(0, dark);
    ASSERT_TRUE(step());
    ASSERT_TRUE(step());
    EXPECT_NE(desk().warning().find("'lamp' has no power"), std::string::npos) << desk().warning();
}

TEST_F(LightInWindow, DuplicatesDeletesAndStaysOutWhileClosed) {
    click(seen_at(light().location));
    press(Key::kDuplicate);
    ASSERT_TRUE(step());
    ASSERT_EQ(desk().edits().state().entries.size(), 2U);
    EXPECT_EQ(light(1).name, "lamp 2");
    press(Key::kDelete);
    ASSERT_TRUE(step());
    EXPECT_EQ(desk().edits().state().entries.size(), 1U);
    press(Key::kLights);
    ASSERT_TRUE(step());
    const glm::dvec3 place = light().location;
    drag(seen_at(place), seen_at(place) + glm::dvec2(40, 0));
    EXPECT_EQ(light().location, place);
}

}  // namespace
}  // namespace rs::compositor
