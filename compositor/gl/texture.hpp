#pragma once
// A picture on the GPU: 8-bit sRGB with straight alpha, read by shaders as linear light.

#include "compositor/gl/handle.hpp"
#include "rayspace/image.hpp"

namespace rs::gl {

class Texture {
public:
    // Content undefined. Sides 1..kMaxPictureSide_px.
    Texture(int width, int height);
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    // Overwrites the top left corner; the picture must fit. Its first row becomes texel row 0.
    void upload(ConstImageView<Rgba8> picture) const;
    // To `uniform sampler2D` with layout(binding = unit).
    void bind(unsigned unit) const;

private:
    Handle<Kind::kTexture> handle_;
    int width_ = 0;
    int height_ = 0;
};

}  // namespace rs::gl
