#pragma once
// Renders one pixel of an object with a shape map by the scalar definition, from texels that the test provides.

#include "engine/core/definition/reconstruct.hpp"
#include "engine/core/definition/shape_pixel.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace rs::test {

using Texel = std::function<Rgba8(int view, int column, int row)>;

// Texel source without detail.
struct PlainTexels {
    const Texel& color;
    int detail(int, int, int) const { return 0; }
};

inline engine::ViewRegisters registers_of(const RaySpaceObject& object, const Camera& camera) {
    const Result<engine::ViewRegisters> registers = engine::prepare_view(object, camera);
    EXPECT_TRUE(registers.ok());
    return *registers;
}

inline std::int32_t rise_at(const engine::ViewRegisters& registers, int i, int j) {
    return static_cast<std::int32_t>(registers.rise.at(i, j) >> 8);
}

inline engine::ShapePixel pixel_at(const RaySpaceObject& object, const Camera& camera, int i, int j,
                                   const Texel& texel) {
    const engine::ViewRegisters registers = registers_of(object, camera);
    const engine::ShapeSetup setup = engine::set_up_shape(object, registers, i, j);
    if (!setup.has_ray) return {};
    return engine::shape_pixel(object, registers, setup, rise_at(registers, i, j), PlainTexels{texel});
}

}  // namespace rs::test
