#pragma once
// The samples of coded pictures, decoded tile by tile when they are first needed, each tile with what it is predicted
// from.
//
// All pictures have a place in one range of addresses, of which only what was decoded takes memory: plane p (Y, U, V,
// alpha) of picture v begins at v * picture_bytes + p * coded_width * coded_height.

#include "engine/core/fast/done_flag.hpp"
#include "engine/core/fast/reserved_memory.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/codec/stream/decode_picture.hpp"

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rs::engine {

class SampleStore {
public:
    // Fails where a loaded picture is predicted from one that is not loaded or has no lower level, or where there are
    // not so many addresses; `name` begins the message.
    static Result<std::unique_ptr<SampleStore>> create(std::shared_ptr<const codec::CodedPictures> coded,
                                                       const std::string& name);

    [[nodiscard]] const codec::CodedPictures& coded() const { return *coded_; }

    // Decodes tile `tile` of a loaded picture, unless that is done. May be called from several threads at once.
    void need_tile(int view, int tile);
    [[nodiscard]] bool decoded(int view, int tile) const { return tiles_[tile_index(view, tile)].done(); }

    // Valid where tiles are decoded.
    [[nodiscard]] codec::ConstPlaneViews planes(int view) const;

    // Of the decoded samples of a picture.
    [[nodiscard]] std::int64_t decoded_bytes(int view) const {
        return pictures_[static_cast<std::size_t>(view)].bytes.load(std::memory_order_relaxed);
    }

    // Gives the samples of a picture back. While no other thread uses the store.
    void forget(int view);

    // A clock that advances by one for every rendered view; the time when a picture was last read or predicted from.
    void advance_clock() { now_.fetch_add(1, std::memory_order_relaxed); }
    void mark_used(int view) {
        std::atomic<std::int64_t>& used = pictures_[static_cast<std::size_t>(view)].last_used;
        const std::int64_t now = now_.load(std::memory_order_relaxed);
        if (used.load(std::memory_order_relaxed) != now) used.store(now, std::memory_order_relaxed);
    }
    [[nodiscard]] std::int64_t last_used(int view) const {
        return pictures_[static_cast<std::size_t>(view)].last_used.load(std::memory_order_relaxed);
    }

private:
    struct PictureState {
        std::atomic<std::int64_t> bytes = 0;
        std::atomic<std::int64_t> last_used = 0;
    };

    SampleStore(std::shared_ptr<const codec::CodedPictures> coded, ReservedMemory memory);
    [[nodiscard]] std::size_t tile_index(int view, int tile) const {
        return static_cast<std::size_t>(view) * tiles_per_picture_ + static_cast<std::size_t>(tile);
    }
    [[nodiscard]] codec::PlaneViews writable_planes(int view) const;
    void decode(int view, int tile);

    std::shared_ptr<const codec::CodedPictures> coded_;
    ReservedMemory memory_;
    std::size_t tiles_per_picture_ = 0;
    std::vector<DoneFlag> tiles_;
    std::vector<PictureState> pictures_;
    std::atomic<std::int64_t> now_ = 0;
};

}  // namespace rs::engine
