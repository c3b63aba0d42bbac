#pragma once
// OpenGL 4.5 core context: surfaceless for offscreen rendering, or that of a window. Surfaceless contexts come from EGL
// on the first capable GPU, otherwise from Mesa's surfaceless platform, which renders in software without a GPU, and
// always if LIBGL_ALWAYS_SOFTWARE=1 is set.
//
// Conventions of all drawing below compositor/, set at creation: the first image row is the top (glClipControl
// GL_UPPER_LEFT); depth is reversed, from 1 at the near plane to 0 at infinity.

#include "rayspace/base/result.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rs::gl {

struct ContextOptions {
    bool debug = false;  // debug context: take_errors() reports the driver's messages
    /// Called at destruction with the errors not yet taken and the GL objects not released; for tests. May be empty.
    std::function<void(const std::vector<std::string>& left)> at_end = nullptr;
};

/// Current on the thread that created it, which must do all GL calls. Move-only.
class Context {
public:
    /// Fails if EGL, the platform or OpenGL 4.5 is unavailable; the error names what is missing.
    static Result<Context> create_surfaceless(const ContextOptions& options = {});
    /// Adopts the context that a window made current on this thread; the window destroys it later. Fails below OpenGL
    /// 4.5.
    static Result<Context> adopt_current(const ContextOptions& options = {});
    Context(Context&&) noexcept;
    Context& operator=(Context&&) noexcept;
    ~Context();

    [[nodiscard]] const std::string& device_name() const;
    /// OpenGL errors since the last call, one line each.
    [[nodiscard]] std::vector<std::string> take_errors();
    /// GL objects that exist, such as "2 textures", including those created elsewhere. Queries some thousand names:
    /// takes milliseconds; for tests.
    [[nodiscard]] std::vector<std::string> live_objects() const;

private:
    struct State;
    explicit Context(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace rs::gl
