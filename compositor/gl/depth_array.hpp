#pragma once
// Array of depth images for shadow maps: rendered layer by layer, sampled with comparison.

#include "compositor/gl/handle.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

namespace rs::gl {

/// Texels [x, x + width) x [y, y + height), rows as read back.
struct TexelArea {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    bool operator==(const TexelArea&) const = default;
};

/// Restricts drawing and clearing to the area during its lifetime; not nestable.
class Scissor {
public:
    explicit Scissor(const TexelArea& area);
    ~Scissor();
    Scissor(const Scissor&) = delete;
    Scissor& operator=(const Scissor&) = delete;
};

class DepthArray {
public:
    /// Float depths, `side` x `side` texels per layer. Fails if the driver does not support the size.
    static Result<DepthArray> create(int side, int layers);
    [[nodiscard]] int side() const { return side_; }
    [[nodiscard]] int layers() const { return layers_; }

    /// Renders to this layer from now on, depth only, and clears it (to infinity).
    void begin(int layer) const;
    /// Same without clearing.
    void resume(int layer) const;
    /// Copies the area from the same layer of `from`, which has the same size.
    void copy(const DepthArray& from, int layer, const TexelArea& area) const;
    /// Binds to `uniform sampler2DArrayShadow` with layout(binding = unit): bilinearly weighted fraction of the nearest
    /// four texels that are not nearer than the reference; 1 outside of the map. Depth is reversed (context.hpp).
    void bind(unsigned unit) const;
    /// Waits for all drawing.
    [[nodiscard]] Image<float> read(int layer) const;

private:
    DepthArray() = default;
    Handle<Kind::kTexture> texture_;
    Handle<Kind::kFramebuffer> handle_;
    int side_ = 0;
    int layers_ = 0;
};

}  // namespace rs::gl
