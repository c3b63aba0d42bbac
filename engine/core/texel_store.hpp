#pragma once
// The captured pictures as the fast core reads them: RGBA, column by column.
//
// Converting YUV to RGB is done once per stored pixel instead of once per rendered one. Fetching is nearest, so the two
// commute and the bits stay the same. Columns are contiguous because the engine walks pictures downwards.
//
// Layout: texel (column, row) of picture p stands at texels()[column_start(p, column) + row], and column_start(p,
// column
// + 1) = column_start(p, column) + column_stride(). Every picture has a border one texel wide that repeats its rim
// (column -1 and `width`, row -1 and `height`), so that bilinear reads need no clamps. texels()[0] is transparent and
// belongs to no picture: the place that lanes without a ray read; the texels a bilinear read from there takes exist.

#include "rayspace/image.hpp"
#include "rayspace/ray_space_object.hpp"
#include "rayspace/result.hpp"

#include <cstdint>
#include <vector>

namespace rs::engine {

// Rows [begin, end) of a column hold all of its texels with alpha above 0; begin == end for an empty column.
struct RowSpan {
    std::int32_t begin = 0;
    std::int32_t end = 0;
};

class TexelStore {
public:
    // Fails where the pictures and their borders have 2^31 pixels or more (the fast core's indices are 32 bits wide).
    // Pictures that are not loaded take no room and must not be asked for.
    static Result<TexelStore> create(const RaySpaceObject& object);

    [[nodiscard]] const Rgba8* texels() const { return texels_.data(); }
    [[nodiscard]] std::int32_t column_start(int picture, int column) const {
        return picture_start_[static_cast<std::size_t>(picture)] + (column + 1) * column_stride() + 1;
    }
    [[nodiscard]] std::int32_t column_stride() const { return height_ + 2; }
    [[nodiscard]] RowSpan occupied(int picture, int column) const {
        return spans_[static_cast<std::size_t>(picture) * static_cast<std::size_t>(width_) +
                      static_cast<std::size_t>(column)];
    }

private:
    int width_ = 0;
    int height_ = 0;
    std::vector<std::int32_t> picture_start_;
    std::vector<RowSpan> spans_;
    std::vector<Rgba8> texels_;
};

}  // namespace rs::engine
