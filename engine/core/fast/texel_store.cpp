#include "engine/core/fast/texel_store.hpp"

#include "engine/core/definition/texel_detail.hpp"
#include "rayspace/base/parallel_loop.hpp"
#include "rayspace/object/yuv.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace rs::engine {

bool has_only_coded_images(const RaySpaceObject& object) {
    return object.coded != nullptr && std::all_of(object.images.begin(), object.images.end(),
                                                  [](const PlanarImage& image) { return image.empty(); });
}

Result<TexelStore> TexelStore::create(const RaySpaceObject& object, std::int64_t decoded_budget_bytes,
                                      ImageArrival arrival) {
    TexelStore store;
    if (has_only_coded_images(object)) {
        RS_ASSIGN_OR_RETURN(std::unique_ptr<CodedTexels> coded,
                            CodedTexels::create(object.coded, object.name, decoded_budget_bytes, arrival));
        store.coded_ = std::move(coded);
        store.layout_ = store.coded_->layout();
        return store;
    }
    store.layout_ = {object.width, object.height, {}};
    const std::int64_t image_size = store.layout_.image_texels();
    std::int64_t size = 1;
    for (const PlanarImage& image : object.images) {
        store.layout_.image_start.push_back(static_cast<std::int32_t>(size));
        if (!image.empty()) size += image_size;
        if (size > std::numeric_limits<std::int32_t>::max()) return too_many_texels(object.name);
    }
    store.texels_.resize(static_cast<std::size_t>(size));
    store.details_.resize(static_cast<std::size_t>(size) + TexelLayout::kMinColumnStride);
    store.spans_.resize(object.images.size() * static_cast<std::size_t>(object.width));

    for_each_index(object.images.size(), [&](std::size_t p) {
        const PlanarImage& image = object.images[p];
        if (image.empty()) return;
        for (int column = 0; column < object.width; ++column) {
            const std::int32_t start = store.column_start(static_cast<int>(p), column);
            Rgba8* texel = store.texels_.data() + start;
            std::int8_t* detail = store.details_.data() + start;
            RowSpan span;
            for (int row = 0; row < object.height; ++row) {
                texel[row] = rgba_at(image, column, row);
                detail[row] = texel_detail_at(image, column, row);
                if (texel[row].a == 0) continue;
                if (span.end == 0) span.begin = row;
                span.end = row + 1;
            }
            texel[-1] = texel[0];
            texel[object.height] = texel[object.height - 1];
            store.spans_[store.layout_.span_index(static_cast<int>(p), column)] = span;
        }
        const auto repeat = [&](int from, int to) {
            const Rgba8* source = store.texels_.data() + store.column_start(static_cast<int>(p), from) - 1;
            std::copy_n(source, store.column_stride(),
                        store.texels_.data() + store.column_start(static_cast<int>(p), to) - 1);
        };
        repeat(0, -1);
        repeat(object.width - 1, object.width);
    });
    return store;
}

std::int64_t TexelStore::bytes_of_images(int width, int height, std::int64_t count) {
    const std::int64_t texels = TexelLayout{width, height, {}}.image_texels();
    const std::int64_t per_image =
        texels * std::int64_t{kTexelBytes} + width * std::int64_t{sizeof(RowSpan)} + std::int64_t{sizeof(std::int32_t)};
    return count * per_image;
}

std::int64_t TexelStore::memory_bytes() const {
    const std::size_t fixed = texels_.capacity() * sizeof(Rgba8) + details_.capacity() +
                              spans_.capacity() * sizeof(RowSpan) +
                              layout_.image_start.capacity() * sizeof(std::int32_t);
    return static_cast<std::int64_t>(fixed) + (coded_ != nullptr ? coded_->decoded_bytes() : 0);
}

}  // namespace rs::engine
