#include "compositor/gl/integer_texture.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <string>
#include <utility>

namespace rs::gl {
namespace {

struct FormatNames {
    GLenum internal;
    GLenum format;
    GLenum type;
};

FormatNames names_of(IntegerFormat format) {
    switch (format) {
        case IntegerFormat::kSigned8:
            return {GL_R8I, GL_RED_INTEGER, GL_BYTE};
        case IntegerFormat::kSigned32:
            return {GL_R32I, GL_RED_INTEGER, GL_INT};
        case IntegerFormat::kSigned32x4:
            return {GL_RGBA32I, GL_RGBA_INTEGER, GL_INT};
        case IntegerFormat::kUnsigned8x4:
            break;
    }
    return {GL_RGBA8UI, GL_RGBA_INTEGER, GL_UNSIGNED_BYTE};
}

std::string size_text(int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
}

void set_nearest(unsigned name) {
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

// Texture of one integer format, attached to a framebuffer.
Handle<Kind::kTexture> attach_texture(unsigned framebuffer, GLenum attachment, GLenum format, int width, int height) {
    unsigned name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    glTextureStorage2D(name, 1, format, width, height);
    set_nearest(name);
    glNamedFramebufferTexture(framebuffer, attachment, name, 0);
    return Handle<Kind::kTexture>(name);
}

// The texels of an RGBA8UI texture as sRGB.
Handle<Kind::kTexture> srgb_view(unsigned texture) {
    unsigned name = 0;
    glGenTextures(1, &name);
    glTextureView(name, GL_TEXTURE_2D, texture, GL_SRGB8_ALPHA8, 0, 1, 0, 1);
    set_nearest(name);
    return Handle<Kind::kTexture>(name);
}

template <class Pixel>
void read_attachment(GLenum attachment, GLenum format, GLenum type, ImageView<Pixel> out) {
    if (out.empty()) return;
    glReadBuffer(attachment);
    glPixelStorei(GL_PACK_ROW_LENGTH, static_cast<GLint>(out.stride()));
    glReadPixels(0, 0, out.width(), out.height(), format, type, out.data());
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
}

}  // namespace

TextureLimits texture_limits() {
    TextureLimits limits;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limits.side);
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &limits.layers);
    return limits;
}

IntegerTexture::IntegerTexture(IntegerFormat format, int width, int height, int layers)
    : format_(format), width_(width), height_(height), layers_(layers) {
    const bool is_array = layers > 0;
    unsigned name = 0;
    glCreateTextures(is_array ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D, 1, &name);
    handle_ = Handle<Kind::kTexture>(name);
    const GLenum internal = names_of(format).internal;
    if (is_array) {
        glTextureStorage3D(name, 1, internal, width, height, layers);
    } else {
        glTextureStorage2D(name, 1, internal, width, height);
    }
    set_nearest(name);
}

Result<IntegerTexture> IntegerTexture::create_layers(IntegerFormat format, int width, int height, int layers) {
    RS_CHECK(width >= 1 && height >= 1);
    while (glGetError() != GL_NO_ERROR) {
    }
    IntegerTexture made(format, width, height, layers);
    if (glGetError() != GL_NO_ERROR) {
        return Error{"OpenGL: the driver has no memory for " + std::to_string(std::max(layers, 1)) + " textures of " +
                     size_text(width, height) + "; use fewer or smaller objects"};
    }
    return made;
}

Result<IntegerTexture> IntegerTexture::create(IntegerFormat format, int width, int height) {
    return create_layers(format, width, height, 0);
}

Result<IntegerTexture> IntegerTexture::create_array(IntegerFormat format, int width, int height, int layers) {
    RS_CHECK(layers >= 1);
    return create_layers(format, width, height, layers);
}

void IntegerTexture::upload(int columns, int rows, const void* texels, int layer) const {
    RS_CHECK(columns <= width_ && rows <= height_ && layer < std::max(layers_, 1));
    const FormatNames names = names_of(format_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (layers_ > 0) {
        glTextureSubImage3D(handle_.name(), 0, 0, 0, layer, columns, rows, 1, names.format, names.type, texels);
    } else {
        glTextureSubImage2D(handle_.name(), 0, 0, 0, columns, rows, names.format, names.type, texels);
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

void IntegerTexture::bind(unsigned unit) const {
    glBindTextureUnit(unit, handle_.name());
}

Result<IntegerTarget> IntegerTarget::create(int width, int height) {
    RS_CHECK(width >= 1 && height >= 1);
    IntegerTarget made;
    made.width_ = width;
    made.height_ = height;
    unsigned name = 0;
    glCreateFramebuffers(1, &name);
    made.handle_ = Handle<Kind::kFramebuffer>(name);
    made.colours_ = attach_texture(name, GL_COLOR_ATTACHMENT0, GL_RGBA8UI, width, height);
    made.numbers_ = attach_texture(name, GL_COLOR_ATTACHMENT1, GL_R32I, width, height);
    const GLenum both[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glNamedFramebufferDrawBuffers(name, 2, both);
    if (glCheckNamedFramebufferStatus(name, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        return Error{"OpenGL: the driver cannot draw into an integer image of " + size_text(width, height) +
                     "; use a smaller one"};
    }
    made.srgb_colours_ = srgb_view(made.colours_.name());
    return made;
}

void IntegerTarget::clear() const {
    constexpr GLuint kNoColour[] = {0, 0, 0, 0};
    constexpr GLint kNoNumber[] = {0, 0, 0, 0};
    glClearNamedFramebufferuiv(handle_.name(), GL_COLOR, 0, kNoColour);
    glClearNamedFramebufferiv(handle_.name(), GL_COLOR, 1, kNoNumber);
}

void IntegerTarget::begin(int left, int top, int width, int height) const {
    RS_CHECK(left >= 0 && top >= 0 && left + width <= width_ && top + height <= height_);
    glBindFramebuffer(GL_FRAMEBUFFER, handle_.name());
    glViewport(left, top, width, height);
}

void IntegerTarget::read(ImageView<Rgba8> colours, ImageView<std::int32_t> numbers) const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, handle_.name());
    read_attachment(GL_COLOR_ATTACHMENT0, GL_RGBA_INTEGER, GL_UNSIGNED_BYTE, colours);
    read_attachment(GL_COLOR_ATTACHMENT1, GL_RED_INTEGER, GL_INT, numbers);
}

void IntegerTarget::bind_colours(unsigned unit) const {
    glBindTextureUnit(unit, srgb_colours_.name());
}

void IntegerTarget::bind_numbers(unsigned unit) const {
    glBindTextureUnit(unit, numbers_.name());
}

}  // namespace rs::gl
