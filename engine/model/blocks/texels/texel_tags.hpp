#pragma once
// Texel tags: map the up to four blocks of 8x8 texels of a sample to lines of the texel cache that hold or will hold
// them; texels of weight 0 need none. A block without a line gets one and is requested: the sample passes on and waits
// in `waiting` until the block is there, while the next samples are processed. So fetching runs ahead of reading by the
// depth of that FIFO.
//
// 128 lines: 64 sets of 2, the set from the low two bits of image, block column and block row. The four blocks of a
// sample differ in the lowest bit of column or row, so one tag memory for each of these four parities gives all of them
// in one cycle. A replaced line may still be read by samples ahead: its fill carries the number of the last of them
// (the guard) and is not written before that sample has been read.
//
// A guard of 10 bits suffices. Let S samples have been output when a fill is requested. Until it is written, R of them
// have been read, and S - 512 <= R <= S, since `waiting` holds 512 and sample S + 1 waits for the fill. The guard is at
// most S - 1: the replaced line is not the one of its set that was read last. A guard below S - 512 is passed in any
// case, so S - 512 is sent instead. Thus guard - R is within -512 .. 511. The age of a line is known to more than 512
// by 10 bits of its last use, if two flip-flops per line state that it was used in the current or in the previous 512
// samples.
//
// The tags belong to one object; the first sample of another object invalidates all (flip-flops).

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/parallel_messages.hpp"
#include "engine/model/signals/registers.hpp"

#include <array>

namespace rs::engine::model {

inline constexpr int kCacheLines = 128;

class TexelTags final : public Block {
public:
    static constexpr int kSets = kCacheLines / 2;
    static constexpr int kTagBits =
        kCacheLines * (1 + 5 + 5 + 5 + 10 + 2) + kSets;  // valid, tag, last use and its age; older way
    struct Ports {
        Fifo<PlacedSample>& in;
        Fifo<TexelFill>& fills;
        Fifo<WaitingSample>& out;
    };
    TexelTags(const RegisterFile& registers, const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::uint64_t fills_requested() const { return fills_requested_; }
    [[nodiscard]] std::uint64_t samples() const { return static_cast<std::uint64_t>(samples_); }

private:
    struct Line {
        bool valid = false;
        int image = 0, block_column = 0, block_row = 0;
        std::int64_t last_use = -kWaitingSamples;  // number of its last sample, counted from 1
    };
    // Line of the block, or -1.
    [[nodiscard]] int find(int image, int block_column, int block_row) const;
    bool needs_fill(const PlacedSample& sample, WaitingSample& waiting, TexelFill& fill);
    int replace(const TexelFill& fill);
    [[nodiscard]] std::uint32_t guard_of(const Line& line) const;
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
    int new_fills_ = 0;                    // fills requested by the front sample
    std::int64_t samples_ = 0;             // samples output
    std::uint64_t fills_requested_ = 0;
};

}  // namespace rs::engine::model
