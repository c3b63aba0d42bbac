#include "compositor/gpu/shader/view_uniforms.hpp"

#include "engine/core/definition/effective_depth.hpp"

#include <optional>

namespace rs::compositor {
namespace {

// A q32 number is two uniforms: shifted right by eight bits, and the lowest eight bits. The sum of a form is exact
// modulo 2^32 after the shift, and its value is within 32 bits (section "Ranges").
ShaderUniform form_high(const engine::LinearForm& form) {
    const auto high = [](std::int64_t number) { return static_cast<std::int32_t>(number >> 8); };
    return {"rise_high", 4, {high(form.at_origin), high(form.per_column), high(form.per_row)}};
}

ShaderUniform form_low(const engine::LinearForm& form) {
    const auto low = [](std::int64_t number) { return static_cast<std::int32_t>(number & 255); };
    return {"rise_low", 4, {low(form.at_origin), low(form.per_column), low(form.per_row)}};
}

}  // namespace

std::array<ShaderUniform, kViewUniforms> view_uniforms(const RaySpaceObject& object,
                                                       const engine::ViewRegisters& registers) {
    const ShapeMap& shape = object.rings[static_cast<std::size_t>(registers.ring)].shape;
    const std::optional<engine::EffectiveDepth> depths =
        shape.empty() ? std::nullopt : std::optional<engine::EffectiveDepth>(shape);
    const auto number = [](const char* name, std::int32_t value) { return ShaderUniform{name, 1, {value}}; };
    return {form_high(registers.rise),
            form_low(registers.rise),
            number("b_q16", registers.b_q20 >> 4),
            number("sampling", static_cast<std::int32_t>(registers.filter)),
            ShaderUniform{"photo_size", 2, {object.width, object.height}},
            number("bands", shape.bands),
            number("reference_q16", shape.reference_height_q20 >> 4),
            number("h_low_q16", shape.h_low_q20 >> 4),
            number("bands_per_unit", shape.bands_per_unit_q12),
            number("depth_step", shape.depth_step_q24),
            number("depth_low", depths ? depths->low_q3() : 0),
            number("reference_depth", depths ? depths->reference_q3() : 0),
            number("jump", shape.jump),
            number("thickness", shape.thickness)};
}

}  // namespace rs::compositor
