#include "compositor/gpu/object_textures.hpp"

#include "compositor/gpu/shader/reconstruction_shader.hpp"
#include "compositor/gpu/shader/texture_layout.hpp"

#include <algorithm>
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
        const PhotoTexels texels = object.photo(photo);
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
