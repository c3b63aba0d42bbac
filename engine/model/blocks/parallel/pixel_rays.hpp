#pragma once
// Pixel scan: the pixels of a pipe's stripes, patch by patch downwards, in a patch row by row; a pixel per cycle. The
// pixel's rise, which no column changes in an upright view, is added up row by row (36 bits).
//
// Four patches are under way at most, each until its pixels have been written. A view is begun when the one before the
// last is done: so of the two sets of codebooks one is always free for it (double_buffered_codebook).

#include "engine/model/blocks/parallel/column_setup.hpp"
#include "engine/model/blocks/shared/stages.hpp"
#include "engine/model/clock/block.hpp"
#include "engine/model/signals/arithmetic.hpp"
#include "engine/model/signals/parallel_messages.hpp"
#include "engine/model/signals/registers.hpp"

namespace rs::engine::model {

class PixelScan final : public Block {
public:
    PixelScan(const RegisterFile& registers, const StripeShare& share, Fifo<ViewJob>& jobs, Fifo<Done>& patch_free,
              Fifo<Done>& view_done, Fifo<PatchJob>& patches, Fifo<ScannedPixel>& pixels);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override {
        return "view " + std::to_string(view_) + " at " + std::to_string(first_column_) + "," +
               std::to_string(first_row_) + ", free patches " + std::to_string(free_patches_);
    }

private:
    bool begin_patch();
    void end_patch();

    const RegisterFile& registers_;
    StripeShare share_;
    Fifo<ViewJob>& jobs_;
    Fifo<Done>& patch_free_;
    Fifo<Done>& view_done_;
    Fifo<PatchJob>& patches_;
    Fifo<ScannedPixel>& pixels_;
    static constexpr int kMostViews = 2;
    int free_patches_ = kPatchSlots;
    int views_ = 0;  // under way
    bool active_ = false;
    int view_ = 0;
    int stripe_ = 0;  // the number of the next one, or of this
    int slot_ = 0;
    int first_column_ = 0;  // of the patch, in the view
    int first_row_ = 0;
    bool in_patch_ = false;
    PatchJob patch_;
    int column_ = 0;  // in the patch
    int row_ = 0;
    std::int64_t rise_q32_ = 0;  // of the row
};

// Ray rise: at which bands a pixel's ray begins and how it passes through them (RECONSTRUCTION.md, section 6, to
// per_d). Seven multipliers in five steps one behind the other; a pixel per cycle. A pixel waits for its column.

// The arithmetic without the clock.
RisenPixel risen(const ScannedPixel& pixel, const ColumnSetup& column, const ShapeRegisters& shape, std::int32_t b_q20);

class RayRise final : public Block {
public:
    static constexpr int kStages = 5 * kProductCycles;
    RayRise(const RegisterFile& registers, Fifo<ColumnSetup>& columns, Fifo<ScannedPixel>& in, Fifo<RisenPixel>& out);
    Activity tick(std::uint64_t now) override;

private:
    const RegisterFile& registers_;
    Fifo<ColumnSetup>& columns_;
    Fifo<ScannedPixel>& in_;
    ColumnTable table_;
    PipelinedStage<RisenPixel> stage_;
};

}  // namespace rs::engine::model
