#pragma once
// Draw calls with their complete state, so that draws do not depend on earlier ones.

#include "compositor/gl/program.hpp"
#include "compositor/gl/vertex_array.hpp"

namespace rs::gl {

enum class Blending {
    kReplace,
    kOverPremultiplied,  // premultiplied by alpha in the shader
};

/// Culled triangle sides.
enum class Culling { kNone, kBack, kFront };

struct DrawState {
    bool depth_test = true;   // draws fragments not farther than the stored depth
    bool depth_write = true;  // where the depth test passes; requires depth_test
    Blending blending = Blending::kReplace;
    Culling culling = Culling::kNone;
    bool clockwise = false;   // front faces are clockwise
    bool wire_frame = false;  // triangle edges only
};

/// Draws into the framebuffer that began last.
void draw(const Program& program, const VertexArray& vertices, const DrawState& state);

/// Submits pending commands to the GPU without waiting.
void flush();
/// Waits until all drawing is complete.
void finish();

}  // namespace rs::gl
