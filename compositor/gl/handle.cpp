#include "compositor/gl/handle.hpp"

#include <epoxy/gl.h>

namespace rs::gl {

void release(Kind kind, unsigned name) {
    switch (kind) {
        case Kind::kProgram:
            glDeleteProgram(name);
            break;
        case Kind::kBuffer:
            glDeleteBuffers(1, &name);
            break;
        case Kind::kVertexArray:
            glDeleteVertexArrays(1, &name);
            break;
        case Kind::kTexture:
            glDeleteTextures(1, &name);
            break;
        case Kind::kRenderbuffer:
            glDeleteRenderbuffers(1, &name);
            break;
        case Kind::kFramebuffer:
            glDeleteFramebuffers(1, &name);
            break;
    }
}

}  // namespace rs::gl
