#pragma once
// Image on the GPU with straight alpha: sampled as linear light.

#include "compositor/gl/handle.hpp"
#include "rayspace/image/image.hpp"

#include <span>

namespace rs::gl {

/// Addressing mode per axis.
struct TextureWrap {
    bool repeat_s = true;  // else clamp to edge
    bool repeat_t = true;
};

enum class TexelKind {
    kColour,  // 8-bit sRGB
    kLinear,  // 16-bit linear light: twice the memory, but no sRGB decoding per sample in software rendering
    kDirection
};

class Texture {
public:
    /// Undefined content, nearest filtering. Sides 1..kMaxImageSide_px.
    Texture(int width, int height, TexelKind kind = TexelKind::kColour);
    /// Immutable surface texture: kLinear, trilinear filtering with mipmaps.
    Texture(ConstImageView<Rgba8> image, const TextureWrap& wrap);
    /// Immutable direction texture (r, g, b) of half floats, same filtering.
    Texture(ConstImageView<RgbaF> directions, const TextureWrap& wrap);
    /// Immutable half-float texture whose mipmap levels are given: each has half the size of the previous one.
    /// Trilinear.
    Texture(std::span<const Image<RgbaF>> levels, const TextureWrap& wrap);
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    /// Overwrites the top left corner; the image must fit. Its first row becomes texel row 0.
    void upload(ConstImageView<Rgba8> image) const;
    /// Attaches the texture as the colour buffer of a framebuffer for reading.
    void attach_to(unsigned framebuffer) const;
    /// Binds to `uniform sampler2D` with layout(binding = unit).
    void bind(unsigned unit) const;

private:
    Texture(int width, int height, TexelKind kind, int levels);
    void set_trilinear(const TextureWrap& wrap) const;
    void upload(const void* texels, int width, int height, std::ptrdiff_t stride, unsigned format, unsigned type) const;
    Handle<Kind::kTexture> handle_;
    int width_ = 0;
    int height_ = 0;
};

}  // namespace rs::gl
