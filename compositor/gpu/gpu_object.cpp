#include "compositor/gpu/gpu_object.hpp"

#include "compositor/gpu/reconstruction_shader.hpp"
#include "engine/core/definition/texel_detail.hpp"
#include "engine/core/fast/renderer.hpp"
#include "rayspace/base/parallel_loop.hpp"
#include "rayspace/codec/stream/decode_image.hpp"
#include "rayspace/object/yuv.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace rs::compositor {
namespace {

using gl::IntegerFormat;
using gl::IntegerTexture;

// Depth and `shown` of two neighbouring bands.
using CellPair = std::array<std::uint8_t, 4>;

constexpr std::int64_t kBytesPerPhotoTexel = 5;  // RGBA and detail

// Rows of the texture of cell pairs; one where there are no cells.
std::int64_t pair_rows(const ShapeMap& shape) {
    if (shape.cells.empty()) return 1;
    const std::int64_t pairs = static_cast<std::int64_t>(shape.cells.size()) / shape.bands * (shape.bands + 2);
    return (pairs + kCellTextureWidth - 1) / kCellTextureWidth;
}

// Padded to full rows of the texture.
std::vector<CellPair> cell_pairs(const ShapeMap& shape) {
    std::vector<CellPair> pairs(static_cast<std::size_t>(pair_rows(shape)) * kCellTextureWidth);
    if (shape.cells.empty()) return pairs;
    const auto bands = static_cast<std::size_t>(shape.bands);
    for_each_index(shape.cells.size() / bands, [&](std::size_t column) {
        const ShapeCell* const cells = shape.cells.data() + column * bands;
        CellPair* const first = pairs.data() + column * (bands + 2);
        for (std::size_t band = 0; band < bands; ++band) {
            const ShapeCell cell = cells[band].has_surface() ? cells[band] : ShapeCell{};
            first[band][2] = first[band + 1][0] = cell.depth;
            first[band][3] = first[band + 1][1] = cell.shown;
        }
    });
    return pairs;
}

Result<IntegerTexture> upload_cells(const ShapeMap& shape) {
    const std::vector<CellPair> pairs = cell_pairs(shape);
    const auto rows = static_cast<int>(pair_rows(shape));
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

std::int64_t gpu_bytes(const RaySpaceObject& object) {
    std::int64_t bytes =
        static_cast<std::int64_t>(object.views.size()) * object.width * object.height * kBytesPerPhotoTexel;
    for (const Ring& ring : object.rings) {
        bytes += pair_rows(ring.shape) * kCellTextureWidth * std::int64_t{sizeof(CellPair)};
    }
    return bytes;
}

Status check_texture_limits(const RaySpaceObject& object, const gl::TextureLimits& limits) {
    const auto refused = [&](const std::string& what, std::int64_t count, int limit) {
        return Error{object.name + ": " + what + " " + std::to_string(count) + " exceeds the driver's limit of " +
                     std::to_string(limit) + "; encode it with fewer or smaller photos"};
    };
    const auto views = static_cast<std::int64_t>(object.views.size());
    if (views > limits.layers) return refused("the number of photos", views, limits.layers);
    const int side = std::max(object.width, object.height);
    if (side > limits.side) return refused("the side of the photos of", side, limits.side);
    for (const Ring& ring : object.rings) {
        const std::int64_t rows = pair_rows(ring.shape);
        if (rows > limits.side) return refused("a shape map with texture rows of", rows, limits.side);
    }
    return {};
}

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
