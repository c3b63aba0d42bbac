#include "compositor/gpu/gpu_object.hpp"

#include "engine/core/fast/renderer.hpp"
#include "engine/core/fast/texel_store.hpp"

#include <utility>

namespace rs::compositor {

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

PhotoTexels GpuObject::photo(int view) const {
    return photo_texels(*texels_, view, object_.width, object_.height);
}

}  // namespace rs::compositor
