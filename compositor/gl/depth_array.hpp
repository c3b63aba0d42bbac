#pragma once
// Depth images of one size that are drawn into one by one and read by comparison: shadow maps.

#include "compositor/gl/handle.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

namespace rs::gl {

// Texels [x, x + width) x [y, y + height) of an image, rows as it is read.
struct TexelArea {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    bool operator==(const TexelArea&) const = default;
};

// While it lives, nothing is drawn or cleared outside of the area. One at a time.
class Scissor {
public:
    explicit Scissor(const TexelArea& area);
    ~Scissor();
    Scissor(const Scissor&) = delete;
    Scissor& operator=(const Scissor&) = delete;
};

class DepthArray {
public:
    // Float depths, `side` x `side` texels each. Fails where the driver cannot.
    static Result<DepthArray> create(int side, int layers);
    [[nodiscard]] int side() const { return side_; }
    [[nodiscard]] int layers() const { return layers_; }

    // Draws go into this layer from now on, depths only. Clears it (to infinity).
    void begin(int layer) const;
    // The same, but what is there stays.
    void resume(int layer) const;
    // Puts this area of the same layer of `from`, which has the same size, in the place of what is there.
    void copy(const DepthArray& from, int layer, const TexelArea& area) const;
    // To `uniform sampler2DArrayShadow` with layout(binding = unit): how much of the nearest four texels is not nearer
    // than the reference, by their weights; all of it beyond the border. Depth is reversed (context.hpp).
    void bind(unsigned unit) const;
    // Waits for all drawing.
    [[nodiscard]] Image<float> read(int layer) const;

private:
    DepthArray() = default;
    Handle<Kind::kTexture> texture_;
    Handle<Kind::kFramebuffer> handle_;
    int side_ = 0;
    int layers_ = 0;
};

}  // namespace rs::gl
