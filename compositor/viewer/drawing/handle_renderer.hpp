#pragma once
// Draws handles (lighting/light_handles.hpp) over a copy of a frame, so that the frame itself, and what is written of
// it, stays without them: anti-aliased, with a dark rim, and faint where they are hidden by what the frame shows.

#include "compositor/gl/framebuffer.hpp"
#include "compositor/gl/program.hpp"
#include "compositor/lighting/light_handles.hpp"
#include "rayspace/base/result.hpp"

#include <optional>
#include <vector>

namespace rs::compositor {

// Needs a gl::Context that is current, and outlives it; one thread. Move-only.
class HandleRenderer {
public:
    static Result<HandleRenderer> create();

    // `image` has one sample; `depths` is of the same size and may have several. The camera is that of the frame.
    Status draw(const std::vector<HandleStroke>& strokes, const Camera& camera, const gl::Framebuffer& image,
                const gl::Framebuffer& depths);
    // The copy with the handles; there must have been a draw().
    [[nodiscard]] const gl::Framebuffer& shown() const { return *copy_; }

private:
    explicit HandleRenderer(gl::Program program) : program_(std::move(program)) {}
    gl::Program program_;
    std::optional<gl::Framebuffer> copy_;
};

}  // namespace rs::compositor
