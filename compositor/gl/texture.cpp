#include "compositor/gl/texture.hpp"

#include "rayspace/image/linear_light.hpp"

#include <epoxy/gl.h>
#include <glm/gtc/type_precision.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace rs::gl {
namespace {

GLenum format_of(TexelKind kind) {
    switch (kind) {
        case TexelKind::kLinear:
            return GL_RGBA16;
        case TexelKind::kDirection:
            return GL_RGBA16F;
        case TexelKind::kColour:
            break;
    }
    return GL_SRGB8_ALPHA8;
}

Image<glm::u16vec4> linear_texels(ConstImageView<Rgba8> image) {
    std::array<std::uint16_t, 256> codes{};
    for (int c = 0; c < 256; ++c) {
        codes[static_cast<std::size_t>(c)] =
            static_cast<std::uint16_t>(std::lround(65535 * linear_from_srgb8(static_cast<std::uint8_t>(c))));
    }
    Image<glm::u16vec4> texels(image.width(), image.height());
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const Rgba8 p = image(x, y);
            texels(x, y) = {codes[p.r], codes[p.g], codes[p.b], p.a * 257};
        }
    }
    return texels;
}

}  // namespace

Texture::Texture(int width, int height, TexelKind kind, int levels) : width_(width), height_(height) {
    RS_CHECK(width >= 1 && height >= 1);
    unsigned name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    handle_ = Handle<Kind::kTexture>(name);
    glTextureStorage2D(name, levels, format_of(kind), width, height);
}

Texture::Texture(int width, int height, TexelKind kind) : Texture(width, height, kind, 1) {
    glTextureParameteri(handle_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(handle_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

Texture::Texture(ConstImageView<Rgba8> image, const TextureWrap& wrap)
    : Texture(image.width(), image.height(), TexelKind::kLinear,
              std::bit_width(static_cast<unsigned>(std::max(image.width(), image.height())))) {
    const Image<glm::u16vec4> linear = linear_texels(image);
    upload(linear.data(), linear.width(), linear.height(), linear.width(), GL_RGBA, GL_UNSIGNED_SHORT);
    glGenerateTextureMipmap(handle_.name());
    set_trilinear(wrap);
}

Texture::Texture(ConstImageView<RgbaF> directions, const TextureWrap& wrap)
    : Texture(directions.width(), directions.height(), TexelKind::kDirection,
              std::bit_width(static_cast<unsigned>(std::max(directions.width(), directions.height())))) {
    upload(directions.data(), directions.width(), directions.height(), directions.stride(), GL_RGBA, GL_FLOAT);
    glGenerateTextureMipmap(handle_.name());
    set_trilinear(wrap);
}

Texture::Texture(std::span<const Image<RgbaF>> levels, const TextureWrap& wrap)
    : Texture(levels.front().width(), levels.front().height(), TexelKind::kDirection, static_cast<int>(levels.size())) {
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const Image<RgbaF>& level = levels[i];
        RS_CHECK(level.width() == width_ >> i && level.height() == height_ >> i);
        glPixelStorei(GL_UNPACK_ROW_LENGTH, static_cast<GLint>(level.view().stride()));
        glTextureSubImage2D(handle_.name(), static_cast<GLint>(i), 0, 0, level.width(), level.height(), GL_RGBA,
                            GL_FLOAT, level.data());
    }
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    set_trilinear(wrap);
}

void Texture::set_trilinear(const TextureWrap& wrap) const {
    const unsigned name = handle_.name();
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, wrap.repeat_s ? GL_REPEAT : GL_CLAMP_TO_EDGE);
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, wrap.repeat_t ? GL_REPEAT : GL_CLAMP_TO_EDGE);
}

void Texture::upload(ConstImageView<Rgba8> image) const {
    upload(image.data(), image.width(), image.height(), image.stride(), GL_RGBA, GL_UNSIGNED_BYTE);
}

void Texture::upload(const void* texels, int width, int height, std::ptrdiff_t stride, unsigned format,
                     unsigned type) const {
    RS_CHECK(width <= width_ && height <= height_);
    if (width == 0 || height == 0) return;
    glPixelStorei(GL_UNPACK_ROW_LENGTH, static_cast<GLint>(stride));
    glTextureSubImage2D(handle_.name(), 0, 0, 0, width, height, format, type, texels);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

void Texture::attach_to(unsigned framebuffer) const {
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, handle_.name(), 0);
}

void Texture::bind(unsigned unit) const {
    glBindTextureUnit(unit, handle_.name());
}

}  // namespace rs::gl
