#pragma once
// Cell march: follows a pixel's ray through the cells of its column (RECONSTRUCTION.md, section 6), two looks at
// cells in a cycle, and hands on the first that it meets. Where that one shows nothing, layer_choice sends the pixel
// back, and the march goes on behind it; such pixels come first. So a ray never marches farther than it must, and
// others pass it.
//
// It keeps the cells of two stripes (32 rays of 256 cells at most, in words as memory has them), which come in from
// memory beside the march, and of each pixel under way where its ray passes the bands.

#include "engine/model/blocks/column_table.hpp"
#include "engine/model/clock/block.hpp"
#include "engine/model/parallel_messages.hpp"
#include "engine/model/registers.hpp"

#include <array>

namespace rs::engine::model {

// The arithmetic without the clock: how a ray is divided into steps.
struct MarchSteps {
    int steps = 1;
    int size = 256;
};
MarchSteps march_steps(std::int32_t per_d_q20);

class CellMarch final : public Block {
public:
    static constexpr std::size_t kWordsPerRay = kMostBands / 2;
    static constexpr std::size_t kCellBits = std::size_t{kStripeSlots} * kStripeColumns * kWordsPerRay * 64;
    static constexpr std::size_t kPixelBits = std::size_t{kPatchIds} * RisenPixel::kBits;

    CellMarch(const RegisterFile& registers, Fifo<ColumnSetup>& columns, Fifo<MemoryWord>& words, Fifo<RisenPixel>& in,
              Fifo<MarchAgain>& again, Fifo<MetCell>& met, Fifo<FinishedPixel>& empty);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override {
        return marching_ ? "marching pixel " + std::to_string(ray_.pixel.id) + " from " + std::to_string(state_.begin)
                         : "words to come " + std::to_string(words_left_);
    }
    [[nodiscard]] std::uint64_t looks() const { return looks_; }

private:
    bool load();
    bool begin();
    Activity march();
    Activity look(const ColumnSetup& column);
    Activity look_at_foot(const ColumnSetup& column);
    Activity finish_empty();
    void meet(const ShapeCell& cell, bool final);
    [[nodiscard]] ShapeCell cell_at(const ColumnSetup& column, std::int32_t at_q12);
    [[nodiscard]] std::int32_t band_q12(int d) const { return ray_.zero_q12 + ((d * ray_.per_d_q20) >> 8); }

    const RegisterFile& registers_;
    Fifo<ColumnSetup>& columns_;
    Fifo<MemoryWord>& words_;
    Fifo<RisenPixel>& in_;
    Fifo<MarchAgain>& again_;
    Fifo<MetCell>& met_;
    Fifo<FinishedPixel>& empty_;

    ColumnTable table_;
    std::array<std::array<std::uint64_t, kWordsPerRay>, std::size_t{kStripeSlots} * kStripeColumns> cells_{};
    int words_left_ = 0;  // of the column that is loaded
    ColumnSetup loading_;

    std::array<RisenPixel, kPatchIds> pixels_;
    bool marching_ = false;
    RisenPixel ray_;
    MarchState state_;
    bool has_foot_cell_ = false;  // the last but one look of a ray
    ShapeCell foot_cell_;
    std::uint64_t looks_ = 0;
};

}  // namespace rs::engine::model
