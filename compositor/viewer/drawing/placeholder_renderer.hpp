#pragma once
// Draws what stands where an object is still being read: a soft, half-transparent upright shape, fuller from its foot
// up as reading goes on.

#include "compositor/gl/program.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/viewer/drawing/shown_parts.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"
#include "rayspace/base/result.hpp"

namespace rs::compositor {

// Needs a gl::Context that is current, and outlives it; one thread. Move-only.
class PlaceholderRenderer {
public:
    static Result<PlaceholderRenderer> create();

    // Blended over what is there, behind what is nearer.
    void draw(const Placeholder& placeholder, const FrameView& view) const;

private:
    explicit PlaceholderRenderer(gl::Program program) : program_(std::move(program)), rectangle_(4) {}
    gl::Program program_;
    gl::VertexArray rectangle_;
};

// Of the placeholder, in scene coordinates.
BoundingBox bounds_of(const Placeholder& placeholder);

}  // namespace rs::compositor
