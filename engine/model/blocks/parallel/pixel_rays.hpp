#pragma once
// Pixel scan: generates the pixels of a pipe's stripes, patch by patch downwards, row by row within a patch; a pixel
// per cycle. The pixel's rise, which is the same for all columns of an upright view, is accumulated row by row (36
// bits).
//
// At most four patches are in flight, each until its pixels have been written. A view starts when the view before the
// last is done, so that one of the two sets of codebooks is free for it (double_buffered_codebook).

#include "engine/model/blocks/parallel/column_setup.hpp"
#include "engine/model/blocks/shared/stages.hpp"
#include "engine/model/clock/block.hpp"
#include "engine/model/signals/arithmetic.hpp"
#include "engine/model/signals/parallel_messages.hpp"
#include "engine/model/signals/registers.hpp"

namespace rs::engine::model {

class PixelScan final : public Block {
public:
    struct Ports {
        Fifo<ViewJob>& jobs;
        Fifo<Done>& patch_free;
        Fifo<Done>& view_done;
        Fifo<PatchJob>& patches;
        Fifo<ScannedPixel>& pixels;
    };
    PixelScan(const RegisterFile& registers, const StripeShare& share, const Ports& ports);
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
    static constexpr int kMaxViews = 2;
    int free_patches_ = kPatchSlots;
    int views_ = 0;  // views in flight
    bool active_ = false;
    int view_ = 0;
    int stripe_ = 0;  // number of the current stripe, or of the next
    int slot_ = 0;
    int first_column_ = 0;  // first column of the patch in the view
    int first_row_ = 0;
    bool in_patch_ = false;
    PatchJob patch_;
    int column_ = 0;  // in the patch
    int row_ = 0;
    std::int64_t rise_q32_ = 0;  // rise of the row
};

// Ray rise: computes the band at which a pixel's ray starts and its slope through the bands (RECONSTRUCTION.md, section
// 6, up to per_d). Six multipliers in five consecutive steps; a pixel per cycle. A pixel waits for its column.

// Ray of a pixel through the bands, without the clock.
PixelBandRay pixel_band_ray(const ScannedPixel& pixel, const ColumnSetup& column, const ShapeRegisters& shape,
                            std::int32_t b_q20);

class RayRise final : public Block {
public:
    static constexpr int kStages = 5 * kProductCycles;
    struct Ports {
        Fifo<ColumnSetup>& columns;
        Fifo<ScannedPixel>& in;
        Fifo<PixelBandRay>& out;
    };
    RayRise(const RegisterFile& registers, const Ports& ports);
    Activity tick(std::uint64_t now) override;

private:
    const RegisterFile& registers_;
    Fifo<ColumnSetup>& columns_;
    Fifo<ScannedPixel>& in_;
    ColumnTable table_;
    PipelinedStage<PixelBandRay> stage_;
};

}  // namespace rs::engine::model
