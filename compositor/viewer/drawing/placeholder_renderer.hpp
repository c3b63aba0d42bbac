#pragma once
// Placeholder of an object that is being loaded: a soft, translucent upright shape, filled from its foot up by the load
// progress.

#include "compositor/gl/program.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/viewer/drawing/displayed_nodes.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"
#include "rayspace/base/result.hpp"

namespace rs::compositor {

/// Requires a current gl::Context that outlives it; single-threaded, move-only.
class PlaceholderRenderer {
public:
    static Result<PlaceholderRenderer> create();

    /// Blended over the frame, depth-tested.
    void draw(const Placeholder& placeholder, const FrameView& view) const;

private:
    explicit PlaceholderRenderer(gl::Program program) : program_(std::move(program)), rectangle_(4) {}
    gl::Program program_;
    gl::VertexArray rectangle_;
};

/// Bounding box in scene coordinates.
BoundingBox bounds_of(const Placeholder& placeholder);

}  // namespace rs::compositor
