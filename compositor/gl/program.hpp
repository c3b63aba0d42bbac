#pragma once
// Linked program of a vertex and a fragment shader, with its uniforms.

#include "compositor/gl/handle.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <span>
#include <string>

namespace rs::gl {

class Program {
public:
    /// \param what program name for errors, which quote the compiler log.
    /// \param vertex, fragment GLSL sources.
    static Result<Program> create(const std::string& what, const std::string& vertex, const std::string& fragment);

    /// \param uniform must be an active uniform of the argument's type.
    void set(const char* uniform, int value) const;
    void set(const char* uniform, float value) const;
    void set(const char* uniform, double value) const;
    void set(const char* uniform, const glm::vec2& value) const;
    void set(const char* uniform, const glm::ivec2& value) const;
    void set(const char* uniform, const glm::ivec4& value) const;
    void set(const char* uniform, const glm::vec3& value) const;
    void set(const char* uniform, const glm::vec4& value) const;
    void set(const char* uniform, const glm::mat3& value) const;
    void set(const char* uniform, const glm::mat4& value) const;
    /// Sets an array of vec4 from its first element on; `uniform` is the array's name.
    void set(const char* uniform, std::span<const glm::vec4> values) const;
    /// True if the uniform is active: compilers remove unused ones.
    [[nodiscard]] bool has_uniform(const char* uniform) const;

    [[nodiscard]] unsigned name() const { return handle_.name(); }

private:
    explicit Program(Handle<Kind::kProgram> handle) : handle_(std::move(handle)) {}
    [[nodiscard]] int location(const char* uniform) const;
    Handle<Kind::kProgram> handle_;
};

}  // namespace rs::gl
