#include "engine/model/blocks/parallel/patch_store.hpp"

namespace rs::engine::model {

PatchStore::PatchStore(const RegisterFile& registers, const Ports& ports)
    : Block("patch_store", "a pixel per cycle, beside it a word of a complete patch per cycle"),
      registers_(registers),
      patches_(reads(ports.patches)),
      pixels_(reads(ports.pixels)),
      empty_(reads(ports.empty)),
      image_writes_(writes(ports.image_writes)),
      patch_free_(writes(ports.patch_free)),
      stripe_free_(writes(ports.stripe_free)),
      view_done_scan_(writes(ports.view_done_scan)),
      view_done_books_(writes(ports.view_done_books)) {}

bool PatchStore::take_patch() {
    if (!patches_.can_pop()) return false;
    const PatchJob job = patches_.pop();
    Slot& slot = slots_[static_cast<std::size_t>(job.slot)];
    RS_CHECK(!slot.used);
    slot = {true, job, job.columns * job.rows};
    return true;
}

bool PatchStore::take_pixel() {
    Fifo<FinishedPixel>& from = pixels_.can_pop() ? pixels_ : empty_;
    if (!from.can_pop()) return false;
    const FinishedPixel pixel = from.pop();
    store_[static_cast<std::size_t>(pixel.id)] = pixel.rgba;
    Slot& slot = slots_[static_cast<std::size_t>(pixel.id / kPatchPixels)];
    RS_CHECK(slot.used && slot.left > 0);
    --slot.left;
    return true;
}

// Pixel of a patch; 0 below the view, if its height is odd.
std::uint32_t PatchStore::pixel(int slot, int column, int row) const {
    const PatchJob& job = slots_[static_cast<std::size_t>(slot)].job;
    if (row >= job.rows) return 0;
    return store_[static_cast<std::size_t>(slot * kPatchPixels + row * kStripeColumns + column)];
}

Activity PatchStore::write_word() {
    Slot& slot = slots_[static_cast<std::size_t>(writing_)];
    if (!slot.used || slot.left > 0) return Activity::idle;
    const PatchJob& job = slot.job;
    const int pairs = (job.rows + 1) / 2;
    const bool ends = column_ + 1 == job.columns && pair_ + 1 == pairs;
    if (!image_writes_.can_push()) return Activity::output_full;
    if (ends && !(patch_free_.can_push() && stripe_free_.can_push() && view_done_scan_.can_push() &&
                  view_done_books_.can_push())) {
        return Activity::output_full;
    }
    const int pitch = registers_.view(job.view).words_per_column();
    const int word = (job.first_column + column_) * pitch + job.first_row / 2 + pair_;
    image_writes_.push({registers_.image(registers_.active, job.view) + static_cast<WordAddress>(word),
                        std::uint64_t{pixel(writing_, column_, 2 * pair_)} |
                            std::uint64_t{pixel(writing_, column_, 2 * pair_ + 1)} << 32U,
                        ends && job.ends_view});
    if (++pair_ == pairs) {
        pair_ = 0;
        ++column_;
    }
    if (!ends) return Activity::busy;
    patch_free_.push({});
    if (job.ends_stripe) stripe_free_.push({});
    if (job.ends_view) {
        view_done_scan_.push({});
        view_done_books_.push({});
    }
    slot.used = false;
    column_ = 0;
    writing_ = (writing_ + 1) % kPatchSlots;
    return Activity::busy;
}

Activity PatchStore::tick(std::uint64_t) {
    const Activity written = write_word();
    const bool patch = take_patch();
    const bool pixel = take_pixel();
    return patch || pixel ? Activity::busy : written;
}

std::string PatchStore::state_text() const {
    std::string text = "writing slot " + std::to_string(writing_) + ", to come";
    for (const Slot& slot : slots_) text += " " + (slot.used ? std::to_string(slot.left) : "-");
    return text;
}

}  // namespace rs::engine::model
