#pragma once
// An image on the GPU, with straight alpha: read by shaders as linear light, or as one float per pixel.

#include "compositor/gl/handle.hpp"
#include "rayspace/image/image.hpp"

namespace rs::gl {

// How an image is read between and beyond its texels.
struct TextureWrap {
    bool repeat_s = true;  // else the border texels go on
    bool repeat_t = true;
};

enum class TexelKind {
    kColour,  // 8-bit sRGB
    kLinear,  // 16-bit linear light: twice the memory, but drawn on a CPU it need not be decoded at every pixel
    kFloat,
    kDirection
};

class Texture {
public:
    // Content undefined; read without interpolation. Sides 1..kMaxImageSide_px.
    Texture(int width, int height, TexelKind kind = TexelKind::kColour);
    // An image that does not change, for surfaces: kLinear, read with linear interpolation from levels of half the
    // size each.
    Texture(ConstImageView<Rgba8> image, const TextureWrap& wrap);
    // Directions that do not change (r, g, b), as half floats; read in the same way.
    Texture(ConstImageView<RgbaF> directions, const TextureWrap& wrap);
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    // Overwrites the top left corner; the image must fit. Its first row becomes texel row 0.
    void upload(ConstImageView<Rgba8> image) const;
    void upload(ConstImageView<float> image) const;  // into kFloat
    // As the colours of a framebuffer that is read from.
    void attach_to(unsigned framebuffer) const;
    // To `uniform sampler2D` with layout(binding = unit).
    void bind(unsigned unit) const;

private:
    Texture(int width, int height, TexelKind kind, int levels);
    void read_smoothly(const TextureWrap& wrap) const;
    void upload(const void* texels, int width, int height, std::ptrdiff_t stride, unsigned format, unsigned type) const;
    Handle<Kind::kTexture> handle_;
    int width_ = 0;
    int height_ = 0;
};

}  // namespace rs::gl
