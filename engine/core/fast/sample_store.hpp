#pragma once
// Samples of coded images. Tiles are decoded when they are first needed, after the tiles that they are predicted from.
//
// All images share one reserved range of addresses, of which only decoded tiles take memory: plane p (Y, U, V, alpha)
// of image v begins at v * image_bytes + p * coded_width * coded_height.

#include "engine/core/fast/done_flag.hpp"
#include "engine/core/fast/reserved_memory.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/codec/stream/decode_image.hpp"

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rs::engine {

/// [view]: true if an image and those that it is predicted from are loaded, have all their tiles, and have descending
/// levels, so that recursive decoding terminates.
std::vector<bool> decodable_images(const codec::CodedImages& coded);

/// Images that may be read by a store.
enum class ImageArrival {
    complete,  // those that are loaded when it is created; they must be decodable
    later,     // images may be loaded until they are first read; only decodable ones may be read
};

class SampleStore {
public:
    /// \return error, prefixed by `name`, if a loaded image is predicted from one that is not loaded or not of a lower
    ///         level, or if the addresses cannot be reserved
    static Result<std::unique_ptr<SampleStore>> create(std::shared_ptr<const codec::CodedImages> coded,
                                                       const std::string& name,
                                                       ImageArrival arrival = ImageArrival::complete);

    [[nodiscard]] const codec::CodedImages& coded() const { return *coded_; }

    /// Decodes tile `tile` of a loaded image unless it is decoded already. Thread-safe.
    void ensure_tile(int view, int tile);
    [[nodiscard]] bool decoded(int view, int tile) const { return tiles_[tile_index(view, tile)].done(); }

    /// Planes of an image; valid in decoded tiles only.
    [[nodiscard]] codec::ConstPlaneViews planes(int view) const;

    /// Memory of the decoded samples of an image.
    [[nodiscard]] std::int64_t decoded_bytes(int view) const {
        return images_[static_cast<std::size_t>(view)].bytes.load(std::memory_order_relaxed);
    }

    /// Frees the samples of an image. Requires that no other thread uses the store.
    void forget(int view);

    // Least-recently-used clock: advances by one for every rendered view. last_used(): time when an image was last read
    // or used as a reference.
    void advance_clock() { now_.fetch_add(1, std::memory_order_relaxed); }
    void mark_used(int view) {
        std::atomic<std::int64_t>& used = images_[static_cast<std::size_t>(view)].last_used;
        const std::int64_t now = now_.load(std::memory_order_relaxed);
        if (used.load(std::memory_order_relaxed) != now) used.store(now, std::memory_order_relaxed);
    }
    [[nodiscard]] std::int64_t last_used(int view) const {
        return images_[static_cast<std::size_t>(view)].last_used.load(std::memory_order_relaxed);
    }

private:
    struct ImageState {
        std::atomic<std::int64_t> bytes = 0;
        std::atomic<std::int64_t> last_used = 0;
    };

    SampleStore(std::shared_ptr<const codec::CodedImages> coded, ReservedMemory memory);
    [[nodiscard]] std::size_t tile_index(int view, int tile) const {
        return static_cast<std::size_t>(view) * tiles_per_image_ + static_cast<std::size_t>(tile);
    }
    [[nodiscard]] codec::PlaneViews writable_planes(int view) const;
    void decode(int view, int tile);

    std::shared_ptr<const codec::CodedImages> coded_;
    ReservedMemory memory_;
    std::size_t tiles_per_image_ = 0;
    std::vector<DoneFlag> tiles_;
    std::vector<ImageState> images_;
    std::atomic<std::int64_t> now_ = 0;
};

}  // namespace rs::engine
