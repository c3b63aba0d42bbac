#include "engine/model/blocks/texels/double_buffered_codebook.hpp"

namespace rs::engine::model {

DoubleBufferedCodebook::DoubleBufferedCodebook(const RegisterFile& registers, const Ports& ports)
    : Block("double_buffered_codebook",
            "latency " + std::to_string(kStages + 1) +
                ", a pixel per cycle, one more for each prediction but the first; beside it a word of "
                "the next books per cycle"),
      registers_(registers),
      jobs_(reads(ports.jobs)),
      view_done_(reads(ports.view_done)),
      in_(reads(ports.in)),
      requests_(writes(ports.requests)),
      words_(reads(ports.words)),
      stage_(kStages, writes(ports.out)) {}

// Takes the next view and starts the load of its codebooks if needed.
bool DoubleBufferedCodebook::next_view() {
    if (!jobs_.can_pop()) return false;
    const ObjectRegisters& object = registers_.object_of(jobs_.front().view);
    if (object.coded) {
        const bool in_first = sets_[0].serial == object.serial;
        std::size_t set = in_first ? 0 : 1;
        if (sets_[set].serial != object.serial) {
            set = sets_[0].last_view <= sets_[1].last_view ? 0 : 1;
            if (sets_[set].last_view > views_done_) return false;
            loading_ = static_cast<int>(set);
            sets_[set].serial = 0;
            object_ = object;
            requested_ = written_ = 0;
            ++book_loads_;
        }
        sets_[set].last_view = views_ + 1;
    }
    ++views_;
    jobs_.pop();
    return true;
}

bool DoubleBufferedCodebook::load() {
    bool moved = false;
    if (requested_ < object_.book_words && requests_.can_push()) {
        requests_.push({object_.books + requested_++, false});
        moved = true;
    }
    BankSet& set = sets_[static_cast<std::size_t>(loading_)];
    if (words_.can_pop()) {
        const std::uint64_t word = words_.pop().data;
        for (std::size_t n = 0; n < 8; ++n) {
            set.banks->set_byte(object_.book_counts, 8 * std::size_t{written_} + n,
                                static_cast<std::uint8_t>(word >> (8 * n)));
        }
        ++written_;
        moved = true;
    }
    if (written_ == object_.book_words) {
        set.serial = object_.serial;
        loading_ = -1;
    }
    return moved;
}

Activity DoubleBufferedCodebook::look_up(std::optional<YuvaPixel>& out) {
    if (!in_.can_pop()) return Activity::idle;
    const CodedPixel& pixel = in_.front();
    const std::uint32_t serial = registers_.object_of(pixel.view).serial;
    const BankSet* const set = sets_[0].serial == serial ? &sets_[0] : sets_[1].serial == serial ? &sets_[1] : nullptr;
    if (set == nullptr) return Activity::memory_data;
    // Flat and predicted banks process one hop each per cycle; the pixel leaves with its last prediction.
    if (turns_ < pixel.hops - 2) {
        ++turns_;
        return Activity::busy;
    }
    out = decode_coded_pixel(*set->banks, pixel);
    in_.pop();
    turns_ = 0;
    return Activity::busy;
}

Activity DoubleBufferedCodebook::tick(std::uint64_t) {
    if (view_done_.can_pop()) {
        view_done_.pop();
        ++views_done_;
    }
    const Activity activity = stage_.step([&](auto& out) { return look_up(out); });  // uses the state before this cycle
    const bool loads = loading_ >= 0 ? load() : next_view();
    return loads ? Activity::busy : activity;
}

}  // namespace rs::engine::model
