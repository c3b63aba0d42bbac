#include "compositor/gl/depth_array.hpp"

#include "rayspace/api/types/check.hpp"

#include <epoxy/gl.h>

#include <string>

namespace rs::gl {

Scissor::Scissor(const TexelArea& area) {
    glScissor(area.x, area.y, area.width, area.height);
    glEnable(GL_SCISSOR_TEST);
}

Scissor::~Scissor() {
    glDisable(GL_SCISSOR_TEST);
}

Result<DepthArray> DepthArray::create(int side, int layers) {
    RS_CHECK(side >= 1 && layers >= 1);
    GLint largest = 0;
    GLint most_layers = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most_layers);
    const std::string size = std::to_string(layers) + " shadow maps of " + std::to_string(side) + " texels a side";
    if (side > largest || layers > most_layers) {
        return Error{"OpenGL: the driver cannot hold " + size + "; draw without shadows"};
    }
    DepthArray made;
    made.side_ = side;
    made.layers_ = layers;
    unsigned name = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
    made.texture_ = Handle<Kind::kTexture>(name);
    glTextureStorage3D(name, 1, GL_DEPTH_COMPONENT32F, side, side, layers);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTextureParameteri(name, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    const float infinity[] = {0, 0, 0, 0};
    glTextureParameterfv(name, GL_TEXTURE_BORDER_COLOR, infinity);
    glCreateFramebuffers(1, &name);
    made.handle_ = Handle<Kind::kFramebuffer>(name);
    glNamedFramebufferDrawBuffer(name, GL_NONE);
    glNamedFramebufferReadBuffer(name, GL_NONE);
    glNamedFramebufferTextureLayer(name, GL_DEPTH_ATTACHMENT, made.texture_.name(), 0, 0);
    if (glCheckNamedFramebufferStatus(name, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        return Error{"OpenGL: the driver cannot draw into " + size + "; draw without shadows"};
    }
    return made;
}

void DepthArray::resume(int layer) const {
    RS_CHECK(layer >= 0 && layer < layers_);
    glNamedFramebufferTextureLayer(handle_.name(), GL_DEPTH_ATTACHMENT, texture_.name(), 0, layer);
    glBindFramebuffer(GL_FRAMEBUFFER, handle_.name());
    glViewport(0, 0, side_, side_);
}

void DepthArray::copy(const DepthArray& from, int layer, const TexelArea& area) const {
    RS_CHECK(from.side_ == side_ && layer < from.layers_ && layer < layers_);
    glCopyImageSubData(from.texture_.name(), GL_TEXTURE_2D_ARRAY, 0, area.x, area.y, layer, texture_.name(),
                       GL_TEXTURE_2D_ARRAY, 0, area.x, area.y, layer, area.width, area.height, 1);
}

void DepthArray::begin(int layer) const {
    resume(layer);
    glDepthMask(GL_TRUE);  // the mask also applies to clears
    const float infinity = 0;
    glClearNamedFramebufferfv(handle_.name(), GL_DEPTH, 0, &infinity);
}

void DepthArray::bind(unsigned unit) const {
    glBindTextureUnit(unit, texture_.name());
}

Image<float> DepthArray::read(int layer) const {
    RS_CHECK(layer >= 0 && layer < layers_);
    Image<float> depths(side_, side_);
    glGetTextureSubImage(texture_.name(), 0, 0, 0, layer, side_, side_, 1, GL_DEPTH_COMPONENT, GL_FLOAT,
                         side_ * side_ * static_cast<GLsizei>(sizeof(float)), depths.data());
    return depths;
}

}  // namespace rs::gl
