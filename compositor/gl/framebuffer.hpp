#pragma once
// What is drawn into: sRGB colour (blended as linear light), float depth.

#include "compositor/gl/handle.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <vector>

namespace rs::gl {

class Framebuffer {
public:
    // Sides 1..kMaxImageSide_px. `samples` per pixel (1 = no multisampling) is lowered to what the driver has. Fails
    // where the driver cannot make one of this size.
    static Result<Framebuffer> create(int width, int height, int samples);
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] int samples() const { return samples_; }

    // Draws go here from now on. Clears colour (linear light) and, unless it is kept, depth (to infinity).
    void begin(const glm::vec3& background, bool keep_depth = false) const;
    // Averages the samples into `target`, which has the same size and one sample.
    void resolve_to(const Framebuffer& target) const;
    // The depth at a pixel (column, row): near plane over distance, 0 where nothing was drawn. `scratch` has the same
    // size and one sample; its depths are lost, unless it is this framebuffer. Waits for all drawing.
    [[nodiscard]] float depth_at(int column, int row, const Framebuffer& scratch) const;
    // The same of width x height pixels from there on, which lie inside, row by row.
    [[nodiscard]] std::vector<float> depths_at(int column, int row, int width, int height,
                                               const Framebuffer& scratch) const;
    // In place of the depths of `target`, which has the same size and one sample and is another.
    void copy_depths_to(const Framebuffer& target) const;
    // Puts the image into the current window, stretched to width x height pixels, which then is what is drawn into
    // (for an overlay). One sample only.
    void show_in_window(int width, int height) const;
    // Waits for all drawing. One sample only.
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

// Puts an image into the current window, stretched to width x height pixels.
void show_in_window(ConstImageView<Rgba8> image, int width, int height);

}  // namespace rs::gl
