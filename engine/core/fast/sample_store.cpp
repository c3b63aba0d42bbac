#include "engine/core/fast/sample_store.hpp"

#include "rayspace/object/ray_space_object.hpp"

#include <utility>

namespace rs::engine {
namespace {

using codec::CodedImages;

std::size_t plane_bytes(const CodedImages& coded) {
    return static_cast<std::size_t>(coded.coded_width()) * static_cast<std::size_t>(coded.coded_height());
}

std::size_t image_bytes(const CodedImages& coded) {
    return ReservedMemory::whole_pages(4 * plane_bytes(coded));
}

// True if all references are decodable and of a lower level.
bool has_valid_references(const CodedImages& coded, std::size_t view, const std::vector<bool>& decodable) {
    const codec::CodedImage& image = coded.images[view];
    for (std::size_t r = 0; r < static_cast<std::size_t>(image.head.references()); ++r) {
        const std::size_t reference = image.head.reference[r];
        if (reference >= coded.images.size() || !decodable[reference]) return false;
        if (coded.levels[reference] >= coded.levels[view]) return false;
    }
    return true;
}

// Decodes the reference tiles of a tile before they are read.
class ReferenceDecoder final : public codec::ReferenceListener {
public:
    ReferenceDecoder(SampleStore& store, const codec::ImageHead& head) : store_(store), head_(head) {}

    void need(int reference, int left, int top, int right, int bottom) override {
        const CodedImages& coded = store_.coded();
        const int view = head_.reference[static_cast<std::size_t>(reference)];
        const int last_column = (right - 1) >> coded.tile_width_log2;
        const int last_row = (bottom - 1) >> coded.tile_height_log2;
        for (int row = top >> coded.tile_height_log2; row <= last_row; ++row) {
            for (int column = left >> coded.tile_width_log2; column <= last_column; ++column) {
                store_.ensure_tile(view, row * coded.tile_columns() + column);
            }
        }
    }

private:
    SampleStore& store_;
    const codec::ImageHead& head_;
};

}  // namespace

std::vector<bool> decodable_images(const CodedImages& coded) {
    const auto tiles = static_cast<std::size_t>(coded.tile_columns() * coded.tile_rows());
    std::vector<bool> decodable(coded.images.size(), false);
    if (coded.levels.size() != coded.images.size()) return decodable;
    for (int level = 0; level < kProgressiveLevels; ++level) {
        for (std::size_t v = 0; v < coded.images.size(); ++v) {
            if (coded.levels[v] != level || coded.images[v].tiles.size() != tiles) continue;
            decodable[v] = has_valid_references(coded, v, decodable);
        }
    }
    return decodable;
}

Result<std::unique_ptr<SampleStore>> SampleStore::create(std::shared_ptr<const CodedImages> coded,
                                                         const std::string& name, ImageArrival arrival) {
    const std::vector<bool> decodable = decodable_images(*coded);
    for (std::size_t v = 0; v < coded->images.size() && arrival == ImageArrival::complete; ++v) {
        if (coded->images[v].loaded() && !decodable[v]) {
            return Error{name + ": image " + std::to_string(v) +
                         " is predicted from images that are not loaded, or has wrong tiles; read the object again"};
        }
    }
    RS_ASSIGN_OR_RETURN(ReservedMemory memory,
                        ReservedMemory::create(coded->images.size() * image_bytes(*coded), name));
    return std::unique_ptr<SampleStore>(new SampleStore(std::move(coded), std::move(memory)));
}

SampleStore::SampleStore(std::shared_ptr<const CodedImages> coded, ReservedMemory memory)
    : coded_(std::move(coded)),
      memory_(std::move(memory)),
      tiles_per_image_(static_cast<std::size_t>(coded_->tile_columns() * coded_->tile_rows())),
      tiles_(coded_->images.size() * tiles_per_image_),
      images_(coded_->images.size()) {}

codec::PlaneViews SampleStore::writable_planes(int view) const {
    auto* const first =
        reinterpret_cast<std::uint8_t*>(memory_.data()) + static_cast<std::size_t>(view) * image_bytes(*coded_);
    const int width = coded_->coded_width();
    codec::PlaneViews planes;
    for (std::size_t p = 0; p < planes.size(); ++p) {
        planes[p] = {first + p * plane_bytes(*coded_), width, coded_->coded_height(), width};
    }
    return planes;
}

codec::ConstPlaneViews SampleStore::planes(int view) const {
    const codec::PlaneViews planes = writable_planes(view);
    return {planes[0], planes[1], planes[2], planes[3]};
}

void SampleStore::ensure_tile(int view, int tile) {
    DoneFlag& flag = tiles_[tile_index(view, tile)];
    if (!flag.done()) flag.ensure([&] { decode(view, tile); });
}

void SampleStore::decode(int view, int tile) {
    mark_used(view);
    const codec::ImageHead& head = coded_->images[static_cast<std::size_t>(view)].head;
    std::array<codec::ConstPlaneViews, 2> references;
    for (std::size_t r = 0; r < static_cast<std::size_t>(head.references()); ++r) {
        references[r] = planes(head.reference[r]);
        mark_used(head.reference[r]);
    }
    ReferenceDecoder listener(*this, head);
    codec::decode_tile(*coded_, static_cast<std::size_t>(view), static_cast<std::size_t>(tile), references, &listener,
                       writable_planes(view));
    const codec::TileRect place = codec::tile_rect(*coded_, static_cast<std::size_t>(tile));
    images_[static_cast<std::size_t>(view)].bytes.fetch_add(std::int64_t{4} * place.width * place.height,
                                                            std::memory_order_relaxed);
}

void SampleStore::forget(int view) {
    const std::size_t size = image_bytes(*coded_);
    memory_.release(static_cast<std::size_t>(view) * size, size);
    images_[static_cast<std::size_t>(view)].bytes.store(0, std::memory_order_relaxed);
    for (std::size_t t = 0; t < tiles_per_image_; ++t) tiles_[tile_index(view, static_cast<int>(t))].reset();
}

}  // namespace rs::engine
