#include "compositor/gpu/object_textures.hpp"

#include "compositor/gpu/reconstruction_shader.hpp"
#include "rayspace/base/parallel_loop.hpp"

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

}  // namespace

std::int64_t gpu_bytes(const RaySpaceObject& object, int photos) {
    std::int64_t bytes = std::int64_t{photos} * object.width * object.height * kBytesPerPhotoTexel;
    for (const Ring& ring : object.rings) {
        bytes += pair_rows(ring.shape) * kCellTextureWidth * std::int64_t{sizeof(CellPair)};
    }
    return bytes;
}

Status check_texture_limits(const RaySpaceObject& object, int photos, const gl::TextureLimits& limits) {
    const auto refused = [&](const std::string& what, std::int64_t count, int limit) {
        return Error{object.name + ": " + what + " " + std::to_string(count) + " exceeds the driver's limit of " +
                     std::to_string(limit) + "; encode it with fewer or smaller photos"};
    };
    if (photos > limits.layers) return refused("the number of photos", photos, limits.layers);
    const int side = std::max(object.width, object.height);
    if (side > limits.side) return refused("the side of the photos of", side, limits.side);
    for (const Ring& ring : object.rings) {
        const std::int64_t rows = pair_rows(ring.shape);
        if (rows > limits.side) return refused("a shape map with texture rows of", rows, limits.side);
    }
    return {};
}

namespace {

// Textures of photos and details.
struct PhotoArrays {
    IntegerTexture photos;
    IntegerTexture details;

    static Result<PhotoArrays> create(const RaySpaceObject& object, int layers) {
        RS_ASSIGN_OR_RETURN(IntegerTexture photos, IntegerTexture::create_array(IntegerFormat::kUnsigned8x4,
                                                                                object.width, object.height, layers));
        RS_ASSIGN_OR_RETURN(IntegerTexture details,
                            IntegerTexture::create_array(IntegerFormat::kSigned8, object.width, object.height, layers));
        return PhotoArrays{std::move(photos), std::move(details)};
    }
};

}  // namespace

ObjectTextures::ObjectTextures(IntegerTexture photos, IntegerTexture details, std::vector<IntegerTexture> cells,
                               int views, int layers)
    : photos_(std::move(photos)),
      details_(std::move(details)),
      cells_(std::move(cells)),
      layer_of_photo_(static_cast<std::size_t>(views), -1) {
    forget_photos(layers);
}

Result<ObjectTextures> ObjectTextures::create(const GpuObject& object, int layers) {
    RS_ASSIGN_OR_RETURN(PhotoArrays arrays, PhotoArrays::create(object.object(), layers));
    std::vector<IntegerTexture> cells;
    for (const Ring& ring : object.object().rings) {
        RS_ASSIGN_OR_RETURN(IntegerTexture texture, upload_cells(ring.shape));
        cells.push_back(std::move(texture));
    }
    const auto views = static_cast<int>(object.object().views.size());
    return ObjectTextures(std::move(arrays.photos), std::move(arrays.details), std::move(cells), views, layers);
}

void ObjectTextures::forget_photos(int layers) {
    std::fill(layer_of_photo_.begin(), layer_of_photo_.end(), -1);
    photo_of_layer_.assign(static_cast<std::size_t>(layers), -1);
    last_used_.assign(static_cast<std::size_t>(layers), 0);
}

Status ObjectTextures::resize(const GpuObject& object, int layers) {
    RS_ASSIGN_OR_RETURN(PhotoArrays arrays, PhotoArrays::create(object.object(), layers));
    photos_ = std::move(arrays.photos);
    details_ = std::move(arrays.details);
    forget_photos(layers);
    return {};
}

bool ObjectTextures::have_room_for(std::span<const int> photos) const {
    const auto missing = std::count_if(photos.begin(), photos.end(), [&](int photo) { return layer_of(photo) < 0; });
    return missing <= std::count(photo_of_layer_.begin(), photo_of_layer_.end(), -1);
}

int ObjectTextures::least_recently_used() const {
    return static_cast<int>(std::min_element(last_used_.begin(), last_used_.end()) - last_used_.begin());
}

void ObjectTextures::load(const GpuObject& object, std::span<const int> photos) {
    RS_CHECK(photos.size() <= photo_of_layer_.size());
    ++now_;
    for (const int photo : photos) {
        if (layer_of(photo) >= 0) last_used_[static_cast<std::size_t>(layer_of(photo))] = now_;
    }
    for (const int photo : photos) {
        if (layer_of(photo) >= 0) continue;
        const int layer = least_recently_used();
        const auto place = static_cast<std::size_t>(layer);
        if (photo_of_layer_[place] >= 0) layer_of_photo_[static_cast<std::size_t>(photo_of_layer_[place])] = -1;
        const GpuObject::Photo texels = object.photo(photo);
        photos_.upload(texels.colours.width(), texels.colours.height(), texels.colours.data(), layer);
        details_.upload(texels.details.width(), texels.details.height(), texels.details.data(), layer);
        photo_of_layer_[place] = photo;
        layer_of_photo_[static_cast<std::size_t>(photo)] = layer;
        last_used_[place] = now_;
    }
}

void ObjectTextures::bind(int ring) const {
    cells_[static_cast<std::size_t>(ring)].bind(kCellUnit);
    photos_.bind(kPhotoUnit);
    details_.bind(kDetailUnit);
}

}  // namespace rs::compositor
