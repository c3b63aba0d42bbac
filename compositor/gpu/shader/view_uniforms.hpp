#pragma once
// Uniforms of the reconstruction shader that depend on the object and the view (reconstruction_shader.hpp).

#include "engine/core/definition/view_registers.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <array>
#include <cstdint>

namespace rs::compositor {

/// An integer uniform of the fragment shader.
struct ShaderUniform {
    const char* name = "";
    int count = 1;                         ///< 1: int, 2: ivec2, 4: ivec4
    std::array<std::int32_t, 4> values{};  ///< the first `count` are used
};

inline constexpr int kViewUniforms = 14;

/// The uniforms of a view, always in the same order. Samplers and `setup_rows` are set by the caller.
/// \param registers  valid for `object`
std::array<ShaderUniform, kViewUniforms> view_uniforms(const RaySpaceObject& object,
                                                       const engine::ViewRegisters& registers);

}  // namespace rs::compositor
