#include "compositor/gl/texture.hpp"

#include <epoxy/gl.h>

namespace rs::gl {

Texture::Texture(int width, int height) : width_(width), height_(height) {
    RS_CHECK(width >= 1 && height >= 1);
    unsigned name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    handle_ = Handle<Kind::kTexture>(name);
    glTextureStorage2D(name, 1, GL_SRGB8_ALPHA8, width, height);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void Texture::upload(ConstImageView<Rgba8> picture) const {
    RS_CHECK(picture.width() <= width_ && picture.height() <= height_);
    if (picture.empty()) return;
    glPixelStorei(GL_UNPACK_ROW_LENGTH, static_cast<GLint>(picture.stride()));
    glTextureSubImage2D(handle_.name(), 0, 0, 0, picture.width(), picture.height(), GL_RGBA, GL_UNSIGNED_BYTE,
                        picture.data());
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

void Texture::bind(unsigned unit) const {
    glBindTextureUnit(unit, handle_.name());
}

}  // namespace rs::gl
