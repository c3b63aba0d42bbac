#pragma once
// A window with an OpenGL 4.5 core context of the compositor's conventions (gl/context.hpp), through GLFW. For the main
// thread only: GLFW requires it.

#include "compositor/gl/context.hpp"
#include "compositor/window/events.hpp"
#include "rayspace/base/result.hpp"

#include <memory>
#include <string>
#include <vector>

struct GLFWwindow;

namespace rs::compositor {

struct WindowOptions {
    std::string title = "Rayspace";
    int width = 1280;  // screen units
    int height = 720;
    bool wait_for_screen = true;  // a frame for each of the screen's
    gl::ContextOptions context = {};
};

// Move-only. Several may be open; what is drawn goes to the one that was created or made current last.
class Window {
public:
    // Fails, saying why, without a display, or where the driver has no OpenGL 4.5 core.
    static Result<Window> create(const WindowOptions& options);
    Window(Window&&) noexcept;
    Window& operator=(Window&&) noexcept;
    ~Window();

    [[nodiscard]] gl::Context& context();
    // What is drawn from now on goes here, by this window's context.
    void make_current();
    [[nodiscard]] bool should_close() const;
    void close();

    // Of what is drawn into; may change from poll() to poll(), and be 0 where the window is an icon.
    [[nodiscard]] glm::ivec2 framebuffer_px() const;

    // What happened since the last call. Those that the panel has taken (Overlay) are not among them.
    std::vector<Event> poll();
    // As if it had happened; for tests and scripts.
    void inject(const Event& event);

    void swap();

    [[nodiscard]] GLFWwindow* handle() const;  // for the overlay's backend

private:
    struct State;
    explicit Window(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace rs::compositor
