#pragma once
// Fragment shader of engine/RECONSTRUCTION.md: computes a pixel of a view from its set-up (view_setup.hpp) and the
// textures of an object (gpu_object.hpp). Sections in its comments are those of that document. It computes the same
// integers as the definition, so its images are equal to the bit on every conforming driver.
//
// One text for OpenGL 4.5 and WebGL 2: nothing but GLSL ES 3.00 after the line with the version. Integers have 32 bits
// and wrap around; products of 64 bits are computed from halves. Quotients are estimated in floating point and
// corrected in integers: they are exact if a division has a relative error below 2^-21, and GLSL requires 2.5 ULP.

#include <string>

namespace rs::compositor {

/// GLSL dialects that the shaders are compiled in.
enum class ShaderDialect {
    kDesktop,   // OpenGL 4.5 core
    kEmbedded,  // OpenGL ES 3.0, WebGL 2
};

/// Draws one triangle (three vertices without data) that covers the viewport.
std::string reconstruction_vertex_shader(ShaderDialect dialect);

/// Outputs: location 0, uvec4: R, G, B, A of 8 bits; location 1, int: lambda_q20, 0 where A is 0.
std::string reconstruction_fragment_shader(ShaderDialect dialect);

/// Texture units of the fragment shader's samplers.
inline constexpr unsigned kSetupUnit = 0;
inline constexpr unsigned kCellUnit = 1;
inline constexpr unsigned kPhotoUnit = 2;
inline constexpr unsigned kDetailUnit = 3;

/// Width of the texture of cell pairs: pair n is texel (n % width, n / width).
inline constexpr int kCellTextureWidthLog2 = 12;
inline constexpr int kCellTextureWidth = 1 << kCellTextureWidthLog2;

/// Texels of a set-up, one below the other.
inline constexpr int kSetupTexels = 7;

/// Kinds of a set-up, the lowest two bits of its first number.
enum class SetupKind {
    kNoRay = 0,
    kPlane = 1,    // sections 2 to 4
    kNoShape = 2,  // section 5, a ray without a shape
    kShape = 3,    // sections 5 to 8
};

}  // namespace rs::compositor
