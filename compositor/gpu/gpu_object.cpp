#include "compositor/gpu/gpu_object.hpp"

#include "compositor/gpu/shader/object_textures.hpp"
#include "compositor/gpu/shader/reconstruction_shader.hpp"
#include "engine/core/definition/texel_detail.hpp"
#include "engine/core/fast/renderer.hpp"
#include "rayspace/base/parallel_loop.hpp"
#include "rayspace/codec/stream/decode_image.hpp"
#include "rayspace/object/yuv.hpp"

#include <cstddef>
#include <utility>

namespace rs::compositor {
namespace {

using gl::IntegerFormat;
using gl::IntegerTexture;

Result<IntegerTexture> upload_cells(const ShapeMap& shape) {
    const std::vector<CellPair> pairs = cell_pairs(shape);
    const auto rows = static_cast<int>(cell_texture_rows(shape));
    RS_ASSIGN_OR_RETURN(IntegerTexture texture,
                        IntegerTexture::create(IntegerFormat::kUnsigned8x4, kCellTextureWidth, rows));
    texture.upload(kCellTextureWidth, rows, pairs.data());
    return texture;
}

void upload_photo(const PlanarImage& image, int layer, const IntegerTexture& photos, const IntegerTexture& details) {
    const int width = image.y.width();
    const int height = image.y.height();
    Image<Rgba8> colours(width, height);
    Image<std::int8_t> detail(width, height);
    for_each_index(height, [&](int row) {
        for (int column = 0; column < width; ++column) {
            colours(column, row) = rgba_at(image, column, row);
            detail(column, row) = engine::texel_detail_at(image, column, row);
        }
    });
    photos.upload(width, height, colours.data(), layer);
    details.upload(width, height, detail.data(), layer);
}

}  // namespace

GpuObject::GpuObject(RaySpaceObject object, IntegerTexture photos, IntegerTexture details,
                     std::vector<IntegerTexture> cells)
    : object_(std::move(object)), photos_(std::move(photos)), details_(std::move(details)), cells_(std::move(cells)) {
    for (const Ring& ring : object_.rings) bounds_.push_back(column_bounds(ring.shape));
}

Result<GpuObject> GpuObject::create(RaySpaceObject object) {
    RS_TRY(engine::substitute_missing_images(object));
    if (engine::has_only_coded_images(object)) codec::decode_images(object);
    object.coded.reset();
    const auto layers = static_cast<int>(object.views.size());
    RS_ASSIGN_OR_RETURN(IntegerTexture photos,
                        IntegerTexture::create_array(IntegerFormat::kUnsigned8x4, object.width, object.height, layers));
    RS_ASSIGN_OR_RETURN(IntegerTexture details,
                        IntegerTexture::create_array(IntegerFormat::kSigned8, object.width, object.height, layers));
    std::vector<IntegerTexture> cells;
    for (const Ring& ring : object.rings) {
        RS_ASSIGN_OR_RETURN(IntegerTexture texture, upload_cells(ring.shape));
        cells.push_back(std::move(texture));
    }
    for (std::size_t view = 0; view < object.images.size(); ++view) {
        const PlanarImage image = std::exchange(object.images[view], {});
        if (!image.empty()) upload_photo(image, static_cast<int>(view), photos, details);
    }
    object.images.clear();
    return GpuObject(std::move(object), std::move(photos), std::move(details), std::move(cells));
}

void GpuObject::bind(int ring) const {
    cells_[static_cast<std::size_t>(ring)].bind(kCellUnit);
    photos_.bind(kPhotoUnit);
    details_.bind(kDetailUnit);
}

}  // namespace rs::compositor
