#pragma once
// Indexed triangles, lines or points ready to be drawn, or no vertices at all for shaders that make theirs from
// gl_VertexID.

#include "compositor/gl/handle.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rs::gl {

// Bytes that shaders read: vertices, indices, tables. Their content is fixed at creation.

class Buffer {
public:
    // Not empty.
    explicit Buffer(std::span<const std::byte> bytes);
    // To `layout(std430, binding = binding) buffer`.
    void bind_table(unsigned binding) const;
    [[nodiscard]] unsigned name() const { return handle_.name(); }

private:
    Handle<Kind::kBuffer> handle_;
};

// Attribute n of the vertex shader (location n) takes `floats` (1..4) floats at `offset_bytes` of each vertex.
struct VertexAttribute {
    int floats = 3;
    unsigned offset_bytes = 0;
};

enum class Primitive { kTriangles, kLines, kPoints };

class VertexArray {
public:
    // Without vertices: draws `vertex_count` vertices as a triangle strip.
    explicit VertexArray(int vertex_count);
    // Neither span is empty.
    VertexArray(std::span<const std::byte> vertices, int stride_bytes, const std::vector<VertexAttribute>& attributes,
                std::span<const std::uint32_t> indices, Primitive primitive = Primitive::kTriangles);

    [[nodiscard]] unsigned name() const { return handle_.name(); }
    [[nodiscard]] bool indexed() const { return indices_.has_value(); }
    [[nodiscard]] Primitive primitive() const { return primitive_; }  // where indexed
    [[nodiscard]] int count() const { return count_; }                // of indices where indexed, else of vertices

private:
    std::optional<Buffer> vertices_;
    std::optional<Buffer> indices_;
    Handle<Kind::kVertexArray> handle_;
    int count_ = 0;
    Primitive primitive_ = Primitive::kTriangles;
};

}  // namespace rs::gl
