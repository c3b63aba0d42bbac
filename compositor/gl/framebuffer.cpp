#include "compositor/gl/framebuffer.hpp"

#include "compositor/gl/texture.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <string>

namespace rs::gl {
namespace {

Handle<Kind::kRenderbuffer> new_renderbuffer(GLenum format, int width, int height, int samples) {
    unsigned name = 0;
    glCreateRenderbuffers(1, &name);
    glNamedRenderbufferStorageMultisample(name, samples > 1 ? samples : 0, format, width, height);
    return Handle<Kind::kRenderbuffer>(name);
}

// Copies bytes unconverted: the window is not an sRGB one, and its first row is the bottom.
void copy_to_window(unsigned framebuffer, const glm::ivec2& from, const glm::ivec2& to) {
    glDisable(GL_FRAMEBUFFER_SRGB);
    const GLenum filter = from == to ? GL_NEAREST : GL_LINEAR;
    glBlitNamedFramebuffer(framebuffer, 0, 0, 0, from.x, from.y, 0, to.y, to.x, 0, GL_COLOR_BUFFER_BIT, filter);
    glEnable(GL_FRAMEBUFFER_SRGB);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, to.x, to.y);
}

}  // namespace

Result<Framebuffer> Framebuffer::create(int width, int height, int samples) {
    RS_CHECK(width >= 1 && height >= 1 && samples >= 1);
    GLint largest = 0;
    GLint most_samples = 1;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    glGetIntegerv(GL_MAX_SAMPLES, &most_samples);
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    if (width > largest || height > largest) {
        return Error{"OpenGL: an image of " + size + " is larger than the driver's " + std::to_string(largest) +
                     " pixels a side; use a smaller one"};
    }
    Framebuffer made;
    made.width_ = width;
    made.height_ = height;
    made.samples_ = std::min(samples, std::max(most_samples, 1));
    made.colour_ = new_renderbuffer(GL_SRGB8_ALPHA8, width, height, made.samples_);
    made.depth_ = new_renderbuffer(GL_DEPTH_COMPONENT32F, width, height, made.samples_);
    unsigned name = 0;
    glCreateFramebuffers(1, &name);
    made.handle_ = Handle<Kind::kFramebuffer>(name);
    glNamedFramebufferRenderbuffer(name, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, made.colour_.name());
    glNamedFramebufferRenderbuffer(name, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, made.depth_.name());
    if (glCheckNamedFramebufferStatus(name, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        return Error{"OpenGL: the driver cannot draw into an image of " + size + "; use a smaller one"};
    }
    return made;
}

void Framebuffer::resume() const {
    glBindFramebuffer(GL_FRAMEBUFFER, handle_.name());
    glViewport(0, 0, width_, height_);
}

void Framebuffer::begin(const glm::vec3& background, bool keep_depth) const {
    glBindFramebuffer(GL_FRAMEBUFFER, handle_.name());
    glViewport(0, 0, width_, height_);
    glDepthMask(GL_TRUE);  // the mask also applies to clears
    const float colour[] = {background.r, background.g, background.b, 1.0F};
    glClearNamedFramebufferfv(handle_.name(), GL_COLOR, 0, colour);
    if (keep_depth) return;
    const float infinity = 0;
    glClearNamedFramebufferfv(handle_.name(), GL_DEPTH, 0, &infinity);
}

void Framebuffer::resolve_to(const Framebuffer& target) const {
    RS_CHECK(target.width_ == width_ && target.height_ == height_ && target.samples_ == 1);
    glBlitNamedFramebuffer(handle_.name(), target.handle_.name(), 0, 0, width_, height_, 0, 0, width_, height_,
                           GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

float Framebuffer::depth_at(int column, int row, const Framebuffer& scratch) const {
    return depths_at(column, row, 1, 1, scratch).front();
}

std::vector<float> Framebuffer::depths_at(int column, int row, int width, int height,
                                          const Framebuffer& scratch) const {
    RS_CHECK(column >= 0 && row >= 0 && column + width <= width_ && row + height <= height_);
    if (&scratch != this) copy_depths_to(scratch);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, scratch.handle_.name());
    std::vector<float> depths(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    glReadPixels(column, row, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
    return depths;
}

void Framebuffer::copy_depths_to(const Framebuffer& target) const {
    RS_CHECK(target.width_ == width_ && target.height_ == height_ && target.samples_ == 1 && &target != this);
    glBlitNamedFramebuffer(handle_.name(), target.handle_.name(), 0, 0, width_, height_, 0, 0, width_, height_,
                           GL_DEPTH_BUFFER_BIT, GL_NEAREST);
}

void Framebuffer::show_in_window(int width, int height) const {
    RS_CHECK(samples_ == 1);
    copy_to_window(handle_.name(), {width_, height_}, {width, height});
}

void show_in_window(ConstImageView<Rgba8> image, int width, int height) {
    const Texture texture(image.width(), image.height());
    texture.upload(image);
    unsigned name = 0;
    glCreateFramebuffers(1, &name);
    const Handle<Kind::kFramebuffer> handle(name);
    texture.attach_to(name);
    copy_to_window(name, {image.width(), image.height()}, {width, height});
}

Image<Rgba8> Framebuffer::read_image() const {
    RS_CHECK(samples_ == 1);
    Image<Rgba8> image(width_, height_);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, handle_.name());
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, image.data());
    return image;
}

}  // namespace rs::gl
