#pragma once
// Vertical raster generator of boards with compressed images: scans the rows of a view column downwards, a pixel per
// cycle, by adding the row step (a 46-bit adder), and joins pixels of the same block of 8x8 samples into a run. A run's
// request is sent at its end, with exactly the rows that it needs; the pixels wait in `pixels_0`, which must be longer
// than a run. A view of odd height has an empty last pixel, because two pixels make a word.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/coded_messages.hpp"
#include "engine/model/signals/registers.hpp"

namespace rs::engine::model {

class BlockScan final : public Block {
public:
    static constexpr int kMaxPixels = 16;  // pixels of a run
    struct Ports {
        Fifo<ColumnWalk>& in;
        Fifo<BlockRequest>& asks;
        Fifo<CodedPixel>& pixels;
    };
    BlockScan(const RegisterFile& registers, const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override { return "pixels of the run " + std::to_string(run_); }

private:
    const RegisterFile& registers_;
    Fifo<ColumnWalk>& in_;
    Fifo<BlockRequest>& asks_;
    Fifo<CodedPixel>& pixels_;
    bool active_ = false;
    ColumnWalk column_;
    std::int64_t row_q16_ = 0;
    int view_row_ = 0;
    bool first_ = false;    // no run of this column has ended yet
    int run_ = 0;           // pixels of the current run
    BlockRequest request_;  // request of the current run
};

}  // namespace rs::engine::model
