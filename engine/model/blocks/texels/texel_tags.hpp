#pragma once
// Texel tags: which line of the texel cache holds, or will hold, the blocks of 8x8 texels that a sample needs, up to
// four; texels of weight 0 need none. A block that is in no line gets one, and is requested: the sample goes on and
// waits in `waiting` until the block is there, while the next samples are looked at. So fetching runs ahead of reading
// by as many samples as that FIFO holds.
//
// 128 lines: 64 sets of 2, the set from the low two bits of image, block column and block row. The four blocks of a
// sample differ in the lowest bit of column or row, so a tag memory for each of these four parities gives all of them
// in one cycle. A line that is replaced may still be read by samples ahead: its fill carries the number of the last of
// them and is not written before that one has been read.
//
// The tags of one object are valid; with the first sample of another one all are forgotten (flip-flops).

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/parallel_messages.hpp"
#include "engine/model/signals/registers.hpp"

#include <array>

namespace rs::engine::model {

inline constexpr int kCacheLines = 128;

class TexelTags final : public Block {
public:
    static constexpr int kSets = kCacheLines / 2;
    static constexpr int kTagBits = kCacheLines * (1 + 5 + 5 + 5 + 10) + kSets;  // valid, tag, last use; which is older
    TexelTags(const RegisterFile& registers, Fifo<PlacedSample>& in, Fifo<TexelFill>& fills, Fifo<WaitingSample>& out);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::uint64_t fills_requested() const { return fills_requested_; }
    [[nodiscard]] std::uint64_t samples() const { return samples_; }

private:
    struct Line {
        bool valid = false;
        int image = 0, block_column = 0, block_row = 0;
        std::uint64_t last_use = 0;  // number of the sample, counted from 1
    };
    // Line of the block, or -1.
    [[nodiscard]] int find(int image, int block_column, int block_row) const;
    bool needs_fill(const PlacedSample& sample, WaitingSample& waiting, TexelFill& fill);
    int replace(const TexelFill& fill);
    static int set_of(int image, int block_column, int block_row) {
        return (image & 3) * 16 + (block_column & 3) * 4 + (block_row & 3);
    }

    const RegisterFile& registers_;
    Fifo<PlacedSample>& in_;
    Fifo<TexelFill>& fills_;
    Fifo<WaitingSample>& out_;
    std::array<Line, kCacheLines> lines_;  // [set * 2 + way]
    std::array<int, kSets> older_{};       // way
    std::uint32_t serial_ = 0;             // of the object
    int new_fills_ = 0;                    // of the sample in front
    std::uint64_t samples_ = 0;            // handed on
    std::uint64_t fills_requested_ = 0;
};

}  // namespace rs::engine::model
