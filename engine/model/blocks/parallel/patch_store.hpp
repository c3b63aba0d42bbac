#pragma once
// Patch store: collects the pixels of four patches in any order. A complete patch is written into the image buffer,
// column by column, two pixels to a word (pixel (i, j) of a view: image_writer.hpp), a word per cycle; then its slot is
// free. The last patch of a stripe or of a view also completes the stripe or the view.
//
// Two banks of 256 x 32 bits, even and odd rows; a pixel is written and a word read in the same cycle.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/parallel_messages.hpp"
#include "engine/model/signals/registers.hpp"

#include <array>

namespace rs::engine::model {

class PatchStore final : public Block {
public:
    static constexpr int kBits = kPatchIds * 32;
    struct Ports {
        Fifo<PatchJob>& patches;
        Fifo<FinishedPixel>& pixels;
        Fifo<FinishedPixel>& empty;
        Fifo<MemoryWrite>& image_writes;
        Fifo<Done>& patch_free;
        Fifo<Done>& stripe_free;
        Fifo<Done>& view_done_scan;
        Fifo<Done>& view_done_books;
    };
    PatchStore(const RegisterFile& registers, const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override;

private:
    bool take_patch();
    bool take_pixel();
    Activity write_word();
    [[nodiscard]] std::uint32_t pixel(int slot, int column, int row) const;

    const RegisterFile& registers_;
    Fifo<PatchJob>& patches_;
    Fifo<FinishedPixel>& pixels_;
    Fifo<FinishedPixel>& empty_;
    Fifo<MemoryWrite>& image_writes_;
    Fifo<Done>& patch_free_;
    Fifo<Done>& stripe_free_;
    Fifo<Done>& view_done_scan_;
    Fifo<Done>& view_done_books_;

    struct Slot {
        bool used = false;
        PatchJob job;
        int left = 0;  // outstanding pixels
    };
    std::array<Slot, kPatchSlots> slots_;
    std::array<std::uint32_t, kPatchIds> store_{};
    int writing_ = 0;  // slot that is being written, or will be next
    int column_ = 0;   // column of the next word
    int pair_ = 0;
};

}  // namespace rs::engine::model
