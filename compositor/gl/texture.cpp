#include "compositor/gl/texture.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>

namespace rs::gl {

Texture::Texture(int width, int height, TexelKind kind, int levels) : width_(width), height_(height) {
    RS_CHECK(width >= 1 && height >= 1);
    unsigned name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    handle_ = Handle<Kind::kTexture>(name);
    glTextureStorage2D(name, levels, kind == TexelKind::kFloat ? GL_R32F : GL_SRGB8_ALPHA8, width, height);
}

Texture::Texture(int width, int height, TexelKind kind) : Texture(width, height, kind, 1) {
    glTextureParameteri(handle_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(handle_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

Texture::Texture(ConstImageView<Rgba8> picture, const TextureWrap& wrap)
    : Texture(picture.width(), picture.height(), TexelKind::kColour,
              std::bit_width(static_cast<unsigned>(std::max(picture.width(), picture.height())))) {
    upload(picture);
    const unsigned name = handle_.name();
    glGenerateTextureMipmap(name);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, wrap.repeat_s ? GL_REPEAT : GL_CLAMP_TO_EDGE);
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, wrap.repeat_t ? GL_REPEAT : GL_CLAMP_TO_EDGE);
}

void Texture::upload(ConstImageView<Rgba8> picture) const {
    upload(picture.data(), picture.width(), picture.height(), picture.stride(), GL_RGBA, GL_UNSIGNED_BYTE);
}

void Texture::upload(ConstImageView<float> picture) const {
    upload(picture.data(), picture.width(), picture.height(), picture.stride(), GL_RED, GL_FLOAT);
}

void Texture::upload(const void* texels, int width, int height, std::ptrdiff_t stride, unsigned format,
                     unsigned type) const {
    RS_CHECK(width <= width_ && height <= height_);
    if (width == 0 || height == 0) return;
    glPixelStorei(GL_UNPACK_ROW_LENGTH, static_cast<GLint>(stride));
    glTextureSubImage2D(handle_.name(), 0, 0, 0, width, height, format, type, texels);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

void Texture::bind(unsigned unit) const {
    glBindTextureUnit(unit, handle_.name());
}

}  // namespace rs::gl
