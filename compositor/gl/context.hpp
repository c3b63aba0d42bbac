#pragma once
// An OpenGL 4.5 core context: without a window or a display, drawing only into framebuffers, or a window's. The former
// is EGL's on the first GPU that has one; else Mesa's surfaceless platform, which draws on the CPU where there is no
// GPU, and always where the environment has LIBGL_ALWAYS_SOFTWARE=1.
//
// Everything below compositor/ draws with the same conventions, set at creation: the image's first row is its top
// (glClipControl GL_UPPER_LEFT), and depth runs from 1 at the near plane to 0 at infinity (reversed; nearer is
// greater).

#include "rayspace/base/result.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rs::gl {

struct ContextOptions {
    bool debug = false;  // a debug context: take_errors() then reports every error with the driver's words
    // Called when the context ends, with the errors that nobody has taken and the names that nobody has released; for
    // tests. May be empty.
    std::function<void(const std::vector<std::string>& left)> at_end = nullptr;
};

// Current on the thread that created it, where all work with it must be done. Move-only.
class Context {
public:
    // Fails, saying what is missing, where EGL, the platform or OpenGL 4.5 cannot be had.
    static Result<Context> create_surfaceless(const ContextOptions& options = {});
    // The context that something else, such as a window, has made current on this thread and will destroy after this.
    // Fails where it is older than OpenGL 4.5.
    static Result<Context> adopt_current(const ContextOptions& options = {});
    Context(Context&&) noexcept;
    Context& operator=(Context&&) noexcept;
    ~Context();

    [[nodiscard]] const std::string& device_name() const;
    // The OpenGL errors since the last call, one line each.
    [[nodiscard]] std::vector<std::string> take_errors();
    // What has been made and not yet released, such as "2 textures"; whoever made it. Asks the driver about every
    // name up to some thousands: milliseconds, for tests.
    [[nodiscard]] std::vector<std::string> names_alive() const;

private:
    struct State;
    explicit Context(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace rs::gl
