#pragma once
// The framebuffers of a frame: a multisampled one that is drawn into, and one that its samples are averaged into.

#include "compositor/gl/framebuffer.hpp"
#include "rayspace/base/result.hpp"

#include <optional>

namespace rs::compositor {

struct FrameTarget {
    gl::Framebuffer drawn;
    std::optional<gl::Framebuffer> resolved;  // only if `drawn` has several samples per pixel

    /// Fails if the driver cannot create framebuffers of this size.
    static Result<FrameTarget> create(int width, int height, int samples);
    /// The framebuffer with one sample per pixel.
    [[nodiscard]] const gl::Framebuffer& shown() const { return resolved ? *resolved : drawn; }
    [[nodiscard]] float depth_at(int x, int y) const { return drawn.depth_at(x, y, shown()); }
};

}  // namespace rs::compositor
