#include "compositor/gl/vertex_array.hpp"

#include "rayspace/api/types/check.hpp"

#include <epoxy/gl.h>

namespace rs::gl {

Buffer::Buffer(std::span<const std::byte> bytes) {
    RS_CHECK(!bytes.empty());
    unsigned name = 0;
    glCreateBuffers(1, &name);
    handle_ = Handle<Kind::kBuffer>(name);
    glNamedBufferStorage(name, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), 0);
}

void Buffer::bind_storage(unsigned binding) const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name());
}

namespace {

Handle<Kind::kVertexArray> new_vertex_array() {
    unsigned name = 0;
    glCreateVertexArrays(1, &name);
    return Handle<Kind::kVertexArray>(name);
}

}  // namespace

VertexArray::VertexArray(int vertex_count) : handle_(new_vertex_array()), count_(vertex_count) {}

VertexArray::VertexArray(std::span<const std::byte> vertices, int stride_bytes,
                         const std::vector<VertexAttribute>& attributes, std::span<const std::uint32_t> indices,
                         Primitive primitive)
    : vertices_(Buffer(vertices)),
      indices_(Buffer(std::as_bytes(indices))),
      handle_(new_vertex_array()),
      count_(static_cast<int>(indices.size())),
      primitive_(primitive) {
    glVertexArrayVertexBuffer(name(), 0, vertices_->name(), 0, stride_bytes);
    glVertexArrayElementBuffer(name(), indices_->name());
    for (GLuint location = 0; location < attributes.size(); ++location) {
        glEnableVertexArrayAttrib(name(), location);
        glVertexArrayAttribFormat(name(), location, attributes[location].floats, GL_FLOAT, GL_FALSE,
                                  attributes[location].offset_bytes);
        glVertexArrayAttribBinding(name(), location, 0);
    }
}

}  // namespace rs::gl
