#pragma once
// Render target: sRGB colour (blended in linear light), float depth.

#include "compositor/gl/handle.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <vector>

namespace rs::gl {

class Framebuffer {
public:
    /// \param width, height 1..kMaxImageSide_px.
    /// \param samples per pixel (1: no multisampling); clamped to the driver's limit.
    /// Fails if the driver does not support the size.
    static Result<Framebuffer> create(int width, int height, int samples);
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] int samples() const { return samples_; }

    /// Renders here from now on. Clears colour (linear light) and, unless kept, depth (to infinity).
    void begin(const glm::vec3& background, bool keep_depth = false) const;
    /// Renders here again from now on, over what it holds.
    void resume() const;
    /// Averages the samples into `target`, which has the same size and one sample.
    void resolve_to(const Framebuffer& target) const;
    /// Depth at a pixel: near plane / distance, 0 where nothing was drawn. Waits for all drawing.
    /// \param scratch same size, one sample; its depths are overwritten unless it is this framebuffer.
    [[nodiscard]] float depth_at(int column, int row, const Framebuffer& scratch) const;
    /// Same for width x height pixels from (column, row), which must be inside; row-major.
    [[nodiscard]] std::vector<float> depths_at(int column, int row, int width, int height,
                                               const Framebuffer& scratch) const;
    /// Overwrites the depths of `target`, another framebuffer of the same size with one sample.
    void copy_depths_to(const Framebuffer& target) const;
    /// Copies the image to the current window, scaled to width x height pixels, and leaves the window bound for an
    /// overlay. One sample only.
    void show_in_window(int width, int height) const;
    /// Waits for all drawing. One sample only.
    [[nodiscard]] Image<Rgba8> read_image() const;

private:
    Framebuffer() = default;
    Handle<Kind::kRenderbuffer> colour_;
    Handle<Kind::kRenderbuffer> depth_;
    Handle<Kind::kFramebuffer> handle_;
    int width_ = 0;
    int height_ = 0;
    int samples_ = 1;
};

/// Copies an image to the current window, scaled to width x height pixels.
void show_in_window(ConstImageView<Rgba8> image, int width, int height);

}  // namespace rs::gl
