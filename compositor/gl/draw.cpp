#include "compositor/gl/draw.hpp"

#include <epoxy/gl.h>

namespace rs::gl {
namespace {

constexpr float kPointSize_px = 2;

GLenum mode_of(Primitive primitive) {
    switch (primitive) {
        case Primitive::kLines:
            return GL_LINES;
        case Primitive::kPoints:
            return GL_POINTS;
        case Primitive::kTriangles:
            break;
    }
    return GL_TRIANGLES;
}

void enable(GLenum what, bool on) {
    if (on) {
        glEnable(what);
    } else {
        glDisable(what);
    }
}

}  // namespace

void draw(const Program& program, const VertexArray& vertices, const DrawState& state) {
    enable(GL_DEPTH_TEST, state.depth_test);
    glDepthFunc(GL_GEQUAL);
    glDepthMask(state.depth_write ? GL_TRUE : GL_FALSE);
    enable(GL_BLEND, state.blending == Blending::kOverPremultiplied);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    enable(GL_CULL_FACE, state.culling != Culling::kNone);
    glCullFace(state.culling == Culling::kFront ? GL_FRONT : GL_BACK);
    glFrontFace(state.clockwise ? GL_CW : GL_CCW);
    glPolygonMode(GL_FRONT_AND_BACK, state.wire_frame ? GL_LINE : GL_FILL);
    glPointSize(kPointSize_px);
    glUseProgram(program.name());
    glBindVertexArray(vertices.name());
    if (vertices.is_indexed()) {
        glDrawElements(mode_of(vertices.primitive()), vertices.count(), GL_UNSIGNED_INT, nullptr);
    } else {
        glDrawArrays(GL_TRIANGLE_STRIP, 0, vertices.count());
    }
}

void flush() {
    glFlush();
}

void finish() {
    glFinish();
}

}  // namespace rs::gl
