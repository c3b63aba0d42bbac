#include "compositor/gl/buffer.hpp"

#include "rayspace/base/check.hpp"

#include <epoxy/gl.h>

namespace rs::gl {

Buffer::Buffer(std::span<const std::byte> bytes) {
    RS_CHECK(!bytes.empty());
    unsigned name = 0;
    glCreateBuffers(1, &name);
    handle_ = Handle<Kind::kBuffer>(name);
    glNamedBufferStorage(name, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), 0);
}

void Buffer::bind_table(unsigned binding) const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name());
}

}  // namespace rs::gl
