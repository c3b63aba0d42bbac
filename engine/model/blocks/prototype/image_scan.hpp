#pragma once
// Column address: addresses of an image column's Y, chroma and alpha. Images are stored column by column:
//
//     Y      of (image p, column x): words luma   + (p W  + x)      * luma_pitch ..,   8 rows to a word
//     (U, V) of them:                words chroma + (p W2 + x >> 1) * chroma_pitch .., 4 pairs of rows to a word
//     alpha  of them:                words alpha  + (p W  + x)      * alpha_pitch ..,  32 rows to a word
//
// with W2 = (W + 1) >> 1. Five products, one after the other.

#include "engine/model/blocks/shared/stages.hpp"
#include "engine/model/clock/block.hpp"
#include "engine/model/signals/arithmetic.hpp"
#include "engine/model/signals/messages.hpp"
#include "engine/model/signals/registers.hpp"

namespace rs::engine::model {

class ColumnAddress final : public SerialStage<ColumnWalk, PlacedColumn> {
public:
    static constexpr int kNoRayLatency = 2;
    static constexpr int kLatency = 1 + 5 * kMultiplyCycles + 1 + 1;

    ColumnAddress(const RegisterFile& registers, const Ports& ports);

private:
    int work(const ColumnWalk& in, PlacedColumn& out) override;
    const RegisterFile& registers_;
};

// Vertical raster generator: scans the rows of a view column downwards, a pixel per cycle, by adding the row step (a
// 46-bit adder), and outputs them in pairs: two pixels make a word of the image buffer. The last pair of a view of odd
// height has an empty second pixel.

class RowScan final : public Block {
public:
    struct Ports {
        Fifo<PlacedColumn>& in;
        Fifo<PixelPair>& out;
    };
    RowScan(const RegisterFile& registers, const Ports& ports);
    Activity tick(std::uint64_t now) override;

private:
    const RegisterFile& registers_;
    Fifo<PlacedColumn>& in_;
    Fifo<PixelPair>& out_;
    bool active_ = false;
    PlacedColumn column_;
    std::int64_t row_q16_ = 0;
    int view_row_ = 0;
    PixelPair pair_;
};

}  // namespace rs::engine::model
