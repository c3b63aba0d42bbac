#pragma once
// Textures and render targets of integers, for exact arithmetic in shaders: texels are fetched one by one
// (texelFetch), without filtering or conversion. Formats and operations are those of OpenGL ES 3.0.

#include "compositor/gl/handle.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>

namespace rs::gl {

enum class IntegerFormat {
    kUnsigned8x4,  // usampler: Rgba8, or four bytes
    kSigned8,      // isampler: std::int8_t
    kSigned32,     // isampler: std::int32_t
    kSigned32x4,   // isampler: four std::int32_t
};

/// Limits of the current context.
struct TextureLimits {
    int side = 0;    // texels
    int layers = 0;  // of an array
};
TextureLimits texture_limits();

class IntegerTexture {
public:
    /// A two-dimensional texture. Undefined content; fails if the driver has no memory for it. The size is within
    /// texture_limits().
    static Result<IntegerTexture> create(IntegerFormat format, int width, int height);
    /// An array of `layers` textures.
    static Result<IntegerTexture> create_array(IntegerFormat format, int width, int height, int layers);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    /// Overwrites rows 0 .. rows - 1 of the first `columns` columns. \param texels tightly packed, in the texture's
    /// format
    void upload(int columns, int rows, const void* texels, int layer = 0) const;
    /// Binds to a sampler whose uniform is set to `unit`.
    void bind(unsigned unit) const;

private:
    IntegerTexture(IntegerFormat format, int width, int height, int layers);
    static Result<IntegerTexture> create_layers(IntegerFormat format, int width, int height, int layers);

    Handle<Kind::kTexture> handle_;
    IntegerFormat format_;
    int width_;
    int height_;
    int layers_;  // 0: not an array
};

/// Render target of two integer images: RGBA of 8 bits (`layout(location = 0) out uvec4`) and a signed number of 32
/// bits (`layout(location = 1) out int`) per pixel. Both are textures for later draws.
class IntegerTarget {
public:
    /// Fails if the driver does not support the size.
    static Result<IntegerTarget> create(int width, int height);
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    /// Sets both images to 0.
    void clear() const;
    /// Draws into pixels [left, left + width) x [top, top + height) from now on; gl_FragCoord.xy - 0.5 is the pixel.
    void begin(int left, int top, int width, int height) const;
    /// Reads the top left corner of both images; waits for all drawing. \param numbers empty: not read
    void read(ImageView<Rgba8> colours, ImageView<std::int32_t> numbers) const;
    /// Binds the first image to `uniform sampler2D` with layout(binding = unit), as sRGB colour with straight alpha.
    void bind_colours(unsigned unit) const;
    /// Binds the second image to `uniform isampler2D` with layout(binding = unit).
    void bind_numbers(unsigned unit) const;

private:
    IntegerTarget() = default;
    Handle<Kind::kTexture> colours_;
    Handle<Kind::kTexture> numbers_;
    Handle<Kind::kTexture> srgb_colours_;  // the same texels
    Handle<Kind::kFramebuffer> handle_;
    int width_ = 0;
    int height_ = 0;
};

}  // namespace rs::gl
