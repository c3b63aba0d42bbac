#pragma once
// Owner of one OpenGL object name. Names belong to the context in which they were created; it must be current when they
// are released, and outlive them.

#include <utility>

namespace rs::gl {

enum class Kind { kProgram, kBuffer, kVertexArray, kTexture, kRenderbuffer, kFramebuffer };

void release(Kind kind, unsigned name);

/// Move-only; 0 means none.
template <Kind kind>
class Handle {
public:
    Handle() = default;
    explicit Handle(unsigned name) : name_(name) {}
    Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Handle& operator=(Handle&& other) noexcept {
        if (this != &other) {
            if (name_ != 0) release(kind, name_);
            name_ = std::exchange(other.name_, 0);
        }
        return *this;
    }
    ~Handle() {
        if (name_ != 0) release(kind, name_);
    }

    [[nodiscard]] unsigned name() const { return name_; }

private:
    unsigned name_ = 0;
};

}  // namespace rs::gl
