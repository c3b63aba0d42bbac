#pragma once
// Raster generator, vertical: walks the rows of a view column downwards, a pixel per cycle, by adding the row step
// (a 46-bit adder), and hands them on in pairs: two pixels make a word of the image buffer. The last pair of a view of
// odd height has an empty second pixel.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/messages.hpp"
#include "engine/model/signals/registers.hpp"

namespace rs::engine::model {

class RowScan final : public Block {
public:
    RowScan(const RegisterFile& registers, Fifo<PlacedColumn>& in, Fifo<PixelPair>& out);
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
