#include "compositor/window/window.hpp"

// epoxy must come before GLFW, which would include another loader.
#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace rs::compositor {
namespace {

struct Binding {
    int glfw_key;
    Key key;
};
constexpr std::array kBindings = {
    Binding{GLFW_KEY_W, Key::kForward},
    Binding{GLFW_KEY_UP, Key::kForward},
    Binding{GLFW_KEY_S, Key::kBack},
    Binding{GLFW_KEY_DOWN, Key::kBack},
    Binding{GLFW_KEY_A, Key::kLeft},
    Binding{GLFW_KEY_D, Key::kRight},
    Binding{GLFW_KEY_LEFT, Key::kTurnLeft},
    Binding{GLFW_KEY_RIGHT, Key::kTurnRight},
    Binding{GLFW_KEY_E, Key::kUp},
    Binding{GLFW_KEY_SPACE, Key::kUp},
    Binding{GLFW_KEY_Q, Key::kDown},
    Binding{GLFW_KEY_C, Key::kDown},
    Binding{GLFW_KEY_LEFT_SHIFT, Key::kFast},
    Binding{GLFW_KEY_RIGHT_SHIFT, Key::kFast},
    Binding{GLFW_KEY_1, Key::kWalk},
    Binding{GLFW_KEY_2, Key::kFly},
    Binding{GLFW_KEY_3, Key::kExamine},
    Binding{GLFW_KEY_PAGE_DOWN, Key::kNextViewpoint},
    Binding{GLFW_KEY_HOME, Key::kHome},
    Binding{GLFW_KEY_PAGE_UP, Key::kPreviousViewpoint},
    Binding{GLFW_KEY_F1, Key::kHelp},
    Binding{GLFW_KEY_H, Key::kHelp},
    Binding{GLFW_KEY_TAB, Key::kPanel},
    Binding{GLFW_KEY_F, Key::kWireFrame},
    Binding{GLFW_KEY_T, Key::kTrace},
    Binding{GLFW_KEY_L, Key::kLights},
    Binding{GLFW_KEY_DELETE, Key::kDelete},
    Binding{GLFW_KEY_O, Key::kShadows},
    Binding{GLFW_KEY_P, Key::kScreenshot},
    Binding{GLFW_KEY_R, Key::kRecord},
    Binding{GLFW_KEY_K, Key::kPlay},
    Binding{GLFW_KEY_COMMA, Key::kFrameBack},
    Binding{GLFW_KEY_PERIOD, Key::kFrameOn},
    Binding{GLFW_KEY_ESCAPE, Key::kQuit},
};

std::optional<Key> key_of(int glfw_key) {
    for (const Binding& binding : kBindings) {
        if (binding.glfw_key == glfw_key) return binding.key;
    }
    return std::nullopt;
}

// Key combinations with control.
std::optional<Key> chord_of(int glfw_key, int modifiers) {
    const bool shift = (modifiers & GLFW_MOD_SHIFT) != 0;
    if (glfw_key == GLFW_KEY_Z) return shift ? Key::kRedo : Key::kUndo;
    if (glfw_key == GLFW_KEY_Y) return Key::kRedo;
    if (glfw_key == GLFW_KEY_D) return Key::kDuplicate;
    return std::nullopt;
}

std::optional<Button> button_of(int glfw_button) {
    if (glfw_button == GLFW_MOUSE_BUTTON_LEFT) return Button::kLeft;
    if (glfw_button == GLFW_MOUSE_BUTTON_RIGHT || glfw_button == GLFW_MOUSE_BUTTON_MIDDLE) return Button::kRight;
    return std::nullopt;
}

// Framebuffer position; dense screens have more pixels than window units.
glm::dvec2 in_pixels(GLFWwindow* window, double x, double y) {
    glm::ivec2 units(1);
    glm::ivec2 pixels(1);
    glfwGetWindowSize(window, &units.x, &units.y);
    glfwGetFramebufferSize(window, &pixels.x, &pixels.y);
    return glm::dvec2(x, y) * glm::dvec2(pixels) / glm::dvec2(glm::max(units, glm::ivec2(1)));
}

Error no_window(const std::string& what) {
    const char* reason = nullptr;
    glfwGetError(&reason);
    return Error{"window: " + what + (reason != nullptr ? std::string(" (") + reason + ")" : std::string()) +
                 "; on a machine without a display write images with -o (rs-view render)"};
}

}  // namespace

struct Window::State {
    GLFWwindow* window = nullptr;
    std::optional<gl::Context> context;
    std::vector<Event> events;

    static inline int open = 0;  // number of windows; GLFW terminates with the last

    State() { ++open; }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        if (context) glfwMakeContextCurrent(window);
        context.reset();
        if (window != nullptr) glfwDestroyWindow(window);
        if (--open == 0) glfwTerminate();
    }

    static State& of(GLFWwindow* window) { return *static_cast<State*>(glfwGetWindowUserPointer(window)); }

    void listen() {
        glfwSetWindowUserPointer(window, this);
        glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int modifiers) {
            // Key releases are reported whatever the modifiers.
            if ((modifiers & GLFW_MOD_CONTROL) != 0 && action == GLFW_PRESS) {
                if (const auto chord = chord_of(key, modifiers)) of(w).events.emplace_back(KeyEvent{*chord, true});
            } else if (const auto known = key_of(key); known && action != GLFW_REPEAT) {
                of(w).events.emplace_back(KeyEvent{*known, action == GLFW_PRESS});
            }
        });
        glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int) {
            glm::dvec2 at(0);
            glfwGetCursorPos(w, &at.x, &at.y);
            if (const auto known = button_of(button)) {
                of(w).events.emplace_back(ButtonEvent{*known, action == GLFW_PRESS, in_pixels(w, at.x, at.y)});
            }
        });
        glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
            of(w).events.emplace_back(MoveEvent{in_pixels(w, x, y)});
        });
        glfwSetScrollCallback(window,
                              [](GLFWwindow* w, double, double up) { of(w).events.emplace_back(WheelEvent{up}); });
        glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
            glm::dvec2 at(0);
            glfwGetCursorPos(w, &at.x, &at.y);
            of(w).events.emplace_back(DropEvent{{paths, paths + count}, in_pixels(w, at.x, at.y)});
        });
        glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
            if (focused == GLFW_FALSE) of(w).events.emplace_back(LostFocusEvent{});
        });
    }
};

Window::Window(std::unique_ptr<State> state) : state_(std::move(state)) {}
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;
Window::~Window() = default;

Result<Window> Window::create(const WindowOptions& options) {
    if (glfwInit() == GLFW_FALSE) return no_window("no display can be opened");
    auto state = std::make_unique<State>();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, options.context.debug ? GLFW_TRUE : GLFW_FALSE);
    // Frames are rendered offscreen with their final bytes.
    glfwWindowHint(GLFW_SRGB_CAPABLE, GLFW_FALSE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    state->window = glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
    if (state->window == nullptr) return no_window("no window with OpenGL 4.5 core can be created");
    glfwMakeContextCurrent(state->window);
    glfwSwapInterval(options.vertical_sync ? 1 : 0);
    RS_ASSIGN_OR_RETURN(gl::Context context, gl::Context::adopt_current(options.context));
    state->context.emplace(std::move(context));
    state->listen();
    return Window(std::move(state));
}

gl::Context& Window::context() {
    return *state_->context;
}

void Window::make_current() {
    glfwMakeContextCurrent(state_->window);
}

bool Window::should_close() const {
    return glfwWindowShouldClose(state_->window) == GLFW_TRUE;
}

void Window::close() {
    glfwSetWindowShouldClose(state_->window, GLFW_TRUE);
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(state_->window, title.c_str());
}

glm::ivec2 Window::framebuffer_px() const {
    glm::ivec2 size(0);
    glfwGetFramebufferSize(state_->window, &size.x, &size.y);
    return size;
}

double interface_scale(double content_scale, int window_units, int framebuffer_px) {
    constexpr double kSteps = 4;
    constexpr double kHighest = 4;
    const double units_scale = static_cast<double>(std::max(framebuffer_px, 1)) / std::max(window_units, 1);
    const double scale = content_scale / units_scale;
    return std::isfinite(scale) ? std::clamp(std::round(kSteps * scale) / kSteps, 1.0, kHighest) : 1;
}

double Window::interface_scale() const {
    glm::vec2 content(1);
    glm::ivec2 units(1);
    glfwGetWindowContentScale(state_->window, &content.x, &content.y);
    glfwGetWindowSize(state_->window, &units.x, &units.y);
    return compositor::interface_scale(content.x, units.x, framebuffer_px().x);
}

std::vector<Event> Window::poll() {
    glfwPollEvents();
    return std::exchange(state_->events, {});
}

void Window::inject(const Event& event) {
    state_->events.push_back(event);
}

void Window::swap() {
    glfwSwapBuffers(state_->window);
}

GLFWwindow* Window::handle() const {
    return state_->window;
}

}  // namespace rs::compositor
