#include "compositor/gl/program.hpp"

#include <epoxy/gl.h>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

namespace rs::gl {
namespace {

// Shader stage that exists only until the program is linked; glCreateShaderProgramv would keep stages separate.
class Shader {
public:
    Shader(GLenum stage, const std::string& source) : name_(glCreateShader(stage)) {
        const char* text = source.c_str();
        glShaderSource(name_, 1, &text, nullptr);
        glCompileShader(name_);
    }
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;
    ~Shader() { glDeleteShader(name_); }
    [[nodiscard]] GLuint name() const { return name_; }

    // Compiler log; empty on success.
    [[nodiscard]] std::string log() const {
        GLint compiled = GL_FALSE;
        glGetShaderiv(name_, GL_COMPILE_STATUS, &compiled);
        if (compiled == GL_TRUE) return "";
        std::string text(2048, ' ');
        GLsizei length = 0;
        glGetShaderInfoLog(name_, static_cast<GLsizei>(text.size()), &length, text.data());
        text.resize(static_cast<std::size_t>(length));
        return text.empty() ? "no log" : text;
    }

private:
    GLuint name_;
};

Error shader_error(const std::string& what, std::string log) {
    std::replace(log.begin(), log.end(), '\n', ' ');
    return Error{"OpenGL: the driver rejects the shader '" + what + "': " + log + "; try a newer Mesa"};
}

}  // namespace

Result<Program> Program::create(const std::string& what, const std::string& vertex, const std::string& fragment) {
    const Shader stages[] = {{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, fragment}};
    Handle<Kind::kProgram> program(glCreateProgram());
    for (const Shader& stage : stages) {
        if (const std::string log = stage.log(); !log.empty()) return shader_error(what, log);
        glAttachShader(program.name(), stage.name());
    }
    glLinkProgram(program.name());
    for (const Shader& stage : stages) glDetachShader(program.name(), stage.name());
    GLint linked = GL_FALSE;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE) {
        std::string log(2048, ' ');
        GLsizei length = 0;
        glGetProgramInfoLog(program.name(), static_cast<GLsizei>(log.size()), &length, log.data());
        return shader_error(what, log.substr(0, static_cast<std::size_t>(length)));
    }
    return Program(std::move(program));
}

int Program::location(const char* uniform) const {
    const int found = glGetUniformLocation(name(), uniform);
    RS_CHECK(found >= 0);
    return found;
}

void Program::set(const char* uniform, int value) const {
    glProgramUniform1i(name(), location(uniform), value);
}

void Program::set(const char* uniform, float value) const {
    glProgramUniform1f(name(), location(uniform), value);
}

void Program::set(const char* uniform, double value) const {
    glProgramUniform1d(name(), location(uniform), value);
}

void Program::set(const char* uniform, const glm::vec2& value) const {
    glProgramUniform2f(name(), location(uniform), value.x, value.y);
}

void Program::set(const char* uniform, const glm::ivec2& value) const {
    glProgramUniform2i(name(), location(uniform), value.x, value.y);
}

void Program::set(const char* uniform, const glm::ivec4& value) const {
    glProgramUniform4i(name(), location(uniform), value.x, value.y, value.z, value.w);
}

void Program::set(const char* uniform, const glm::vec3& value) const {
    glProgramUniform3f(name(), location(uniform), value.x, value.y, value.z);
}

void Program::set(const char* uniform, const glm::vec4& value) const {
    glProgramUniform4f(name(), location(uniform), value.x, value.y, value.z, value.w);
}

void Program::set(const char* uniform, const glm::mat3& value) const {
    glProgramUniformMatrix3fv(name(), location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}

void Program::set(const char* uniform, const glm::mat4& value) const {
    glProgramUniformMatrix4fv(name(), location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}

void Program::set(const char* uniform, std::span<const glm::vec4> values) const {
    glProgramUniform4fv(name(), location(uniform), static_cast<GLsizei>(values.size()), glm::value_ptr(values[0]));
}

bool Program::has_uniform(const char* uniform) const {
    return glGetUniformLocation(name(), uniform) >= 0;
}

}  // namespace rs::gl
