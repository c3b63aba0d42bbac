#include "compositor/gl/draw.hpp"

#include <epoxy/gl.h>

namespace rs::gl {
void draw(const Program& program, const VertexArray& vertices, const DrawState& state) {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);
    glDepthMask(state.depth_write ? GL_TRUE : GL_FALSE);
    if (state.blending == Blending::kOverPremultiplied) {
        glEnable(GL_BLEND);
    } else {
        glDisable(GL_BLEND);
    }
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glUseProgram(program.name());
    glBindVertexArray(vertices.name());
    if (vertices.indexed()) {
        glDrawElements(GL_TRIANGLES, vertices.count(), GL_UNSIGNED_INT, nullptr);
    } else {
        glDrawArrays(GL_TRIANGLE_STRIP, 0, vertices.count());
    }
}

}  // namespace rs::gl
