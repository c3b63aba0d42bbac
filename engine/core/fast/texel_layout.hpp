#pragma once
// Where the fast core's texels stand (texel_store.hpp).

#include "rayspace/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rs::engine {

// Rows [begin, end) of a column hold all of its texels with alpha above 0; begin == end for an empty column.
struct RowSpan {
    std::int32_t begin = 0;
    std::int32_t end = 0;
};

struct TexelLayout {
    int width = 0;
    int height = 0;
    std::vector<std::int32_t> picture_start;  // index of texel (-1, -1)

    [[nodiscard]] std::int32_t column_stride() const { return height + 2; }
    [[nodiscard]] std::int32_t column_start(int picture, int column) const {
        return picture_start[static_cast<std::size_t>(picture)] + (column + 1) * column_stride() + 1;
    }
    // Place of a column's RowSpan.
    [[nodiscard]] std::size_t span_index(int picture, int column) const {
        return static_cast<std::size_t>(picture) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
    }
};

// Where indices of 32 bits do not reach.
inline Error too_many_texels(const std::string& name) {
    return {name +
            ": its pictures have more than 2^31 pixels, which the renderer cannot address; "
            "encode the object with fewer or smaller pictures"};
}

}  // namespace rs::engine
