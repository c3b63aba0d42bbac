#pragma once
// Draws light handles (lighting/light_handles.hpp) over a copy of a frame: anti-aliased, with a dark rim, dimmed where
// geometry occludes them. The frame itself is unchanged, so saved images contain no handles.

#include "compositor/gl/framebuffer.hpp"
#include "compositor/gl/program.hpp"
#include "compositor/lighting/light_handles.hpp"
#include "rayspace/base/result.hpp"

#include <optional>
#include <vector>

namespace rs::compositor {

/// Requires a current gl::Context that outlives it; single-threaded, move-only.
class HandleRenderer {
public:
    static Result<HandleRenderer> create();

    /// \param image has one sample per pixel.
    /// \param depths has the same size; may be multisampled.
    /// \param camera camera of the frame.
    Status draw(const std::vector<HandleStroke>& strokes, const Camera& camera, const gl::Framebuffer& image,
                const gl::Framebuffer& depths);
    /// Copy of the frame with the handles; requires an earlier draw().
    [[nodiscard]] const gl::Framebuffer& shown() const { return *copy_; }

private:
    explicit HandleRenderer(gl::Program program) : program_(std::move(program)) {}
    gl::Program program_;
    std::optional<gl::Framebuffer> copy_;
};

}  // namespace rs::compositor
