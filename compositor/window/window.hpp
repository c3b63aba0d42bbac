#pragma once
// GLFW window with an OpenGL 4.5 core context and the compositor's conventions (gl/context.hpp). Main thread only, as
// GLFW requires.

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
    bool vertical_sync = true;  // vertical synchronisation
    gl::ContextOptions context = {};
};

/// Factor for fonts and margins in window units: the display's content scale, as far as window units do not have it
/// already, in steps of a quarter, 1..4.
/// \param content_scale of the display relative to 96 dpi
double interface_scale(double content_scale, int window_units, int framebuffer_px);

/// Move-only. Several may be open; drawing goes to the one created or made current last.
class Window {
public:
    /// Fails without a display, or if the driver lacks OpenGL 4.5 core; the error states the reason.
    static Result<Window> create(const WindowOptions& options);
    Window(Window&&) noexcept;
    Window& operator=(Window&&) noexcept;
    ~Window();

    [[nodiscard]] gl::Context& context();
    /// Makes this window's context the target of drawing.
    void make_current();
    [[nodiscard]] bool should_close() const;
    void close();

    void set_title(const std::string& title);

    /// Framebuffer size; may change in poll(), and be 0 while the window is minimised.
    [[nodiscard]] glm::ivec2 framebuffer_px() const;

    /// Factor for fonts and margins in window units (interface_scale below).
    [[nodiscard]] double interface_scale() const;

    /// Events since the last call, except those consumed by the panel (Overlay).
    std::vector<Event> poll();
    /// Adds a synthetic event; for tests and scripts.
    void inject(const Event& event);

    void swap();

    [[nodiscard]] GLFWwindow* handle() const;  // for the overlay's backend

private:
    struct State;
    explicit Window(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace rs::compositor
