#include "compositor/gpu/shader/photo_texels.hpp"

#include "engine/core/fast/texel_store.hpp"
#include "rayspace/base/parallel_loop.hpp"

namespace rs::compositor {

PhotoTexels photo_texels(const engine::TexelStore& store, int photo, int width, int height) {
    constexpr int kColumnsAtOnce = 32;  // a column of tiles
    PhotoTexels texels{Image<Rgba8>(width, height), Image<std::int8_t>(width, height)};
    const engine::TexelStore::Reading reading = store.read();
    for_each_range(width, kColumnsAtOnce, [&](int begin, int end) {
        store.ensure(photo, begin, end - 1);
        for (int column = begin; column < end; ++column) {
            const std::int32_t start = store.column_start(photo, column);
            for (int row = 0; row < height; ++row) {
                texels.colours(column, row) = store.texels()[start + row];
                texels.details(column, row) = store.details()[start + row];
            }
        }
    });
    return texels;
}

}  // namespace rs::compositor
