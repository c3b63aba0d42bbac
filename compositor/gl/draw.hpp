#pragma once
// One draw call with all of the state that it depends on, so that no draw inherits anything from the one before it.

#include "compositor/gl/program.hpp"
#include "compositor/gl/vertex_array.hpp"

namespace rs::gl {

enum class Blending {
    kReplace,
    kOverPremultiplied,  // the shader's colour is multiplied by its alpha
};

struct DrawState {
    bool depth_write = true;  // where the depth test passes: not farther than what is there
    Blending blending = Blending::kReplace;
};

// Into the framebuffer that began last.
void draw(const Program& program, const VertexArray& vertices, const DrawState& state);

}  // namespace rs::gl
