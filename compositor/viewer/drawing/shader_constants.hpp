#pragma once
// Constants at the head of a shader's text, behind its "#version".

#include <string>

namespace rs::compositor {

inline std::string shader_constant(const std::string& name, int value) {
    return "const int " + name + " = " + std::to_string(value) + ";\n";
}

inline std::string shader_constant(const std::string& name, bool value) {
    return "const bool " + name + (value ? " = true;\n" : " = false;\n");
}

}  // namespace rs::compositor
