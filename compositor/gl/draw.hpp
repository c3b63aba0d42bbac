#pragma once
// One draw call with all of the state that it depends on, so that no draw inherits anything from the one before it.

#include "compositor/gl/program.hpp"
#include "compositor/gl/vertex_array.hpp"

namespace rs::gl {

enum class Blending {
    kReplace,
    kOverPremultiplied,  // the shader's colour is multiplied by its alpha
};

// Sides of triangles that are not drawn.
enum class Culling { kNone, kBack, kFront };

struct DrawState {
    bool depth_test = true;   // draws only what is not farther than what is there
    bool depth_write = true;  // where the depth test passes; needs the depth test
    Blending blending = Blending::kReplace;
    Culling culling = Culling::kNone;
    bool clockwise = false;   // triangles whose corners turn clockwise show their front, else the others
    bool wire_frame = false;  // only the edges of triangles
};

// Into the framebuffer that began last.
void draw(const Program& program, const VertexArray& vertices, const DrawState& state);

// Sends what was drawn to the GPU, without waiting.
void flush();
// Waits until everything is drawn.
void finish();

}  // namespace rs::gl
