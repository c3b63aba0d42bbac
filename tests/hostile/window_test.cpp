// Random keys, drags and sizes in windows of a scene, of a sequence and of walls, which must keep running.

#include "compositor/playback/sequence_player.hpp"
#include "compositor/viewer/views/framing.hpp"
#include "compositor/window/visit.hpp"
#include "compositor/window/wall_visit.hpp"
#include "tests/compositor/moving_boxes.hpp"
#include "tests/compositor/objects.hpp"
#include "tests/hostile/mutation.hpp"
#include "tests/hostile/surviving.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/virtual_display.hpp"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <vector>

namespace rs::compositor {
namespace {

constexpr std::array kKeys = {Key::kForward,
                              Key::kBack,
                              Key::kLeft,
                              Key::kRight,
                              Key::kTurnLeft,
                              Key::kTurnRight,
                              Key::kUp,
                              Key::kDown,
                              Key::kFast,
                              Key::kWalk,
                              Key::kFly,
                              Key::kExamine,
                              Key::kHome,
                              Key::kHelp,
                              Key::kNextViewpoint,
                              Key::kPreviousViewpoint,
                              Key::kPanel,
                              Key::kWireFrame,
                              Key::kShadows,
                              Key::kTrace,
                              Key::kLights,
                              Key::kUndo,
                              Key::kRedo,
                              Key::kDuplicate,
                              Key::kDelete,
                              Key::kRecord,
                              Key::kPlay,
                              Key::kFrameBack,
                              Key::kScreenshot,
                              Key::kFrameOn};

constexpr int kWindows = 3;  // sharing the time of this file
constexpr int kMinFrames = 20;

Event random_event(test::Random& random) {
    const auto place = [&] {
        return glm::dvec2(static_cast<double>(test::below(random, 4000)) - 500,
                          static_cast<double>(test::below(random, 3000)) - 500);
    };
    switch (test::below(random, 7)) {
        case 0:
        case 1:
            return KeyEvent{kKeys[test::below(random, kKeys.size())], test::below(random, 2) == 0};
        case 2:
            return ButtonEvent{test::below(random, 2) == 0 ? Button::kLeft : Button::kRight,
                               test::below(random, 2) == 0, place()};
        case 3:
            return MoveEvent{place()};
        case 4:
            return WheelEvent{static_cast<double>(test::below(random, 21)) - 10};
        case 5:
            return DropEvent{{test::below(random, 2) == 0 ? "gone.rso" : "gone.json"}, place()};
        default:
            return LostFocusEvent{};
    }
}

// Visit under test.
struct Steered {
    std::function<Window&(test::Random&)> window;  // one of the visit's windows
    std::function<Result<bool>(double seconds)> step;
    std::function<void(test::Random&)> change = [](test::Random&) {};  // state that events do not reach
};

// Sends random events until the window's share of the time is over.
void steer(const Steered& visit) {
    constexpr std::array<std::array<int, 2>, 6> kSizes = {
        {{320, 240}, {3000, 20}, {20, 900}, {1, 1}, {1280, 3}, {200, 150}}};
    test::Random random(test::hostile_seed());
    const auto end =
        std::chrono::steady_clock::now() + std::chrono::duration<double>(test::hostile_seconds() / kWindows);
    int frames = 0;
    for (; std::chrono::steady_clock::now() < end || frames < kMinFrames; ++frames) {
        for (std::size_t n = test::below(random, 6); n > 0; --n) visit.window(random).inject(random_event(random));
        visit.change(random);
        if (frames % 8 == 3) {
            const auto& size = kSizes[static_cast<std::size_t>(frames / 8) % kSizes.size()];
            glfwSetWindowSize(visit.window(random).handle(), size[0], size[1]);
        }
        const auto goes_on = visit.step(0.02 + 0.2 * static_cast<double>(test::below(random, 10)));
        ASSERT_TRUE(goes_on.ok()) << "RAYSPACE_HOSTILE_SEED=" << test::hostile_seed() << ", frame " << frames << ": "
                                  << goes_on.error().message;
        ASSERT_TRUE(*goes_on);
    }
    ::testing::Test::RecordProperty("frames", frames);
}

// Selects lights, which random clicks rarely hit, and bounds their number.
void change_lights(LightEditor& lights, test::Random& random) {
    constexpr std::size_t kMaxLights = 8;
    LightEdits& edits = lights.edits();
    if (test::below(random, 4) == 0) edits.select(test::below(random, 3));
    if (edits.state().entries.size() <= kMaxLights) return;
    LightingState fewer = edits.state();
    fewer.entries.resize(1);
    edits.set(fewer);
}

void change_weather(Playback& playback, test::Random& random) {
    if (test::below(random, 32) != 0) return;
    Weather weather;
    (random() % 2 == 0 ? weather.rain : weather.fog) = true;
    playback.set_weather(test::below(random, 3) == 0 ? std::nullopt : std::optional(weather));
}

void steer(Visit& visit) {
    steer({.window = [&](test::Random&) -> Window& { return visit.window(); },
           .step = [&](double seconds) { return visit.step(seconds); },
           .change =
               [&](test::Random& random) {
                   change_lights(visit.lights(), random);
                   if (test::below(random, 32) == 0) visit.walk_on(test::below(random, 2) == 0);
                   if (visit.panel().playback != nullptr) change_weather(*visit.panel().playback, random);
               }});
}

Scene wall_with_drums() {
    Scene scene;
    scene.lights = {point_light({0, 2, 2}, glm::vec3(3)), directional_light({0, -1, -0.3}, glm::vec3(1))};
    GeometryNode wall;
    wall.mesh = std::make_shared<const Mesh>(box_mesh({4, 4, 0.1}));
    wall.world_from_node[3] = glm::dvec4(0, 0, -4, 1);
    scene.geometry.push_back(wall);
    for (int n = 0; n < 4; ++n) {
        RaySpaceNode drum;
        drum.file = "drum.rso";
        drum.chain = {{{2.0 * n - 3, 0, 0}}};
        scene.objects.push_back(drum);
    }
    Viewpoint front;
    front.world_from_camera[3] = glm::dvec4(0, 0.5, 6, 1);
    scene.viewpoints = {front, front};
    return scene;
}

std::unique_ptr<Showroom> showroom_of(const Scene& scene) {
    return std::make_unique<Showroom>(scene, ShowroomOptions{.waits = true}, nullptr,
                                      std::make_unique<test::ObjectsInMemory>());
}

class HostileWindow : public ::testing::Test {
protected:
    void SetUp() override {
        if (!display_.ready()) GTEST_SKIP() << "Xvfb cannot be started (Debian: xvfb)";
    }

    // Files are saved in work_.
    void visit(const Scene& scene, VisitOptions options) {
        options.images = work_.path();
        options.lights = work_ / "lights.json";
        options.frame.samples = 1;
        auto window =
            Window::create({.title = "test", .width = 320, .height = 240, .vertical_sync = false, .context = {}});
        ASSERT_TRUE(window.ok()) << window.error().message;
        auto visit = Visit::create(std::move(*window), scene, showroom_of(scene), options);
        ASSERT_TRUE(visit.ok()) << visit.error().message;
        steer(**visit);
    }

    test::VirtualDisplay display_;
    test::TemporaryFolder work_;
};

TEST_F(HostileWindow, TheVisitGoesOn) {
    const Scene scene = wall_with_drums();
    VisitOptions options;
    options.viewpoints = scene.viewpoints;
    visit(scene, options);
}

TEST_F(HostileWindow, TheSequenceGoesOn) {
    const std::shared_ptr<const Sequence> sequence = test::moving_boxes(6, 4);
    VisitOptions options;
    options.sequence = sequence;
    options.viewpoints = {viewpoint_of(camera_of(*sequence, 0, 320, 240))};
    visit(sequence->scene, options);
}

TEST_F(HostileWindow, TheWallsGoOn) {
    const Scene scene = wall_with_drums();
    WallVisitOptions options;
    options.display.walls = {{"left", {-1.5, 0, 1.5}, {-1.5, 0, -1.5}, {-1.5, 3, 1.5}, 120, 90},
                             {"front", {-1.5, 0, -1.5}, {1.5, 0, -1.5}, {-1.5, 3, -1.5}, 120, 90}};
    options.heads = {Head{.position = {0, 1.5, 0}}};
    options.images = work_.path();
    options.frame.samples = 1;
    options.window.vertical_sync = false;
    const auto walls = WallVisit::create(scene, showroom_of(scene), options);
    ASSERT_TRUE(walls.ok()) << walls.error().message;
    WallVisit& visit = **walls;
    steer({.window = [&](test::Random& random) -> Window& { return visit.windows()[test::below(random, 2)]; },
           .step = [&](double seconds) { return visit.step(seconds); }});
}

}  // namespace
}  // namespace rs::compositor
