#pragma once
// Vertex array of indexed triangles, lines or points; or of no vertices, for shaders that compute them from
// gl_VertexID.

#include "compositor/gl/handle.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rs::gl {

/// Immutable GPU buffer: vertices, indices or tables.

class Buffer {
public:
    /// \param bytes must not be empty.
    explicit Buffer(std::span<const std::byte> bytes);
    /// Binds to `layout(std430, binding = binding) buffer`.
    void bind_storage(unsigned binding) const;
    [[nodiscard]] unsigned name() const { return handle_.name(); }

private:
    Handle<Kind::kBuffer> handle_;
};

/// Attribute n (location n) takes `floats` (1..4) floats at `offset_bytes` of each vertex.
struct VertexAttribute {
    int floats = 3;
    unsigned offset_bytes = 0;
};

enum class Primitive { kTriangles, kLines, kPoints };

class VertexArray {
public:
    /// No vertex data: draws `vertex_count` vertices as a triangle strip.
    explicit VertexArray(int vertex_count);
    /// Neither span may be empty.
    VertexArray(std::span<const std::byte> vertices, int stride_bytes, const std::vector<VertexAttribute>& attributes,
                std::span<const std::uint32_t> indices, Primitive primitive = Primitive::kTriangles);

    [[nodiscard]] unsigned name() const { return handle_.name(); }
    [[nodiscard]] bool is_indexed() const { return indices_.has_value(); }
    [[nodiscard]] Primitive primitive() const { return primitive_; }  // if indexed
    [[nodiscard]] int count() const { return count_; }                // indices if indexed, else vertices

private:
    std::optional<Buffer> vertices_;
    std::optional<Buffer> indices_;
    Handle<Kind::kVertexArray> handle_;
    int count_ = 0;
    Primitive primitive_ = Primitive::kTriangles;
};

}  // namespace rs::gl
