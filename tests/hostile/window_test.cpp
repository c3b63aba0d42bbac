// Random keys, drags and sizes in a window, which must keep running.

#include "compositor/window/visit.hpp"
#include "tests/compositor/objects.hpp"
#include "tests/hostile/mutation.hpp"
#include "tests/hostile/surviving.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/virtual_display.hpp"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <memory>

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
                              Key::kWireFrame};

Event random_event(test::Random& random) {
    const auto place = [&] {
        return glm::dvec2(static_cast<double>(test::below(random, 4000)) - 500,
                          static_cast<double>(test::below(random, 3000)) - 500);
    };
    switch (test::below(random, 6)) {
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
        default:
            return LostFocusEvent{};
    }
}

TEST(HostileWindow, TheVisitGoesOn) {
    const test::VirtualDisplay display;
    if (!display.ready()) GTEST_SKIP() << "Xvfb cannot be started (Debian: xvfb)";
    const test::TemporaryFolder work;
    Scene scene;
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
    VisitOptions options;
    options.viewpoints = {front, front};
    options.images = work.path();
    options.samples = 1;
    auto showroom = std::make_unique<Showroom>(scene, ShowroomOptions{.waits = true}, nullptr,
                                               std::make_unique<test::ObjectsInMemory>());
    auto window = Window::create({.title = "test", .width = 320, .height = 240, .vertical_sync = false, .context = {}});
    ASSERT_TRUE(window.ok()) << window.error().message;
    auto visit = Visit::create(std::move(*window), scene, std::move(showroom), options);
    ASSERT_TRUE(visit.ok()) << visit.error().message;

    test::Random random(test::hostile_seed());
    constexpr std::array<std::array<int, 2>, 6> kSizes = {
        {{320, 240}, {3000, 20}, {20, 900}, {1, 1}, {1280, 3}, {200, 150}}};
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(test::hostile_seconds());
    int frames = 0;
    for (; std::chrono::steady_clock::now() < end || frames < 20; ++frames) {
        for (std::size_t n = test::below(random, 6); n > 0; --n) (*visit)->window().inject(random_event(random));
        if (frames % 8 == 3) {
            const auto& size = kSizes[static_cast<std::size_t>(frames / 8) % kSizes.size()];
            glfwSetWindowSize((*visit)->window().handle(), size[0], size[1]);
        }
        const auto goes_on = (*visit)->step(0.02 + 0.2 * static_cast<double>(test::below(random, 10)));
        ASSERT_TRUE(goes_on.ok()) << "RAYSPACE_HOSTILE_SEED=" << test::hostile_seed() << ", frame " << frames << ": "
                                  << goes_on.error().message;
        ASSERT_TRUE(*goes_on);
    }
    RecordProperty("frames", frames);
}

}  // namespace
}  // namespace rs::compositor
