#include "compositor/gpu/gpu_object.hpp"

#include "engine/core/fast/renderer.hpp"
#include "engine/core/fast/texel_store.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <utility>

namespace rs::compositor {
namespace {

constexpr int kColumnsAtOnce = 32;  // of a photo; a column of tiles

}  // namespace

GpuObject::GpuObject(RaySpaceObject object, std::unique_ptr<engine::TexelStore> texels)
    : object_(std::move(object)), texels_(std::move(texels)) {
    for (const Ring& ring : object_.rings) bounds_.push_back(column_bounds(ring.shape));
}

GpuObject::~GpuObject() = default;

Result<std::shared_ptr<const GpuObject>> GpuObject::create(RaySpaceObject object) {
    RS_TRY(engine::substitute_missing_images(object));
    RS_ASSIGN_OR_RETURN(engine::TexelStore texels, engine::TexelStore::create(object, kDecodedBytes));
    object.images.clear();
    object.coded.reset();
    return std::shared_ptr<const GpuObject>(
        new GpuObject(std::move(object), std::make_unique<engine::TexelStore>(std::move(texels))));
}

GpuObject::Photo GpuObject::photo(int view) const {
    const int width = object_.width;
    const int height = object_.height;
    Photo made{Image<Rgba8>(width, height), Image<std::int8_t>(width, height)};
    const engine::TexelStore::Reading reading = texels_->read();
    for_each_range(width, kColumnsAtOnce, [&](int begin, int end) {
        texels_->ensure(view, begin, end - 1);
        for (int column = begin; column < end; ++column) {
            const std::int32_t start = texels_->column_start(view, column);
            for (int row = 0; row < height; ++row) {
                made.colours(column, row) = texels_->texels()[start + row];
                made.details(column, row) = texels_->details()[start + row];
            }
        }
    });
    return made;
}

}  // namespace rs::compositor
