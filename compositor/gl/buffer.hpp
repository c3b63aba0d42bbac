#pragma once
// Bytes that shaders read: vertices, indices, tables. Their content is fixed at creation.

#include "compositor/gl/handle.hpp"

#include <cstddef>
#include <span>

namespace rs::gl {

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

}  // namespace rs::gl
