#include "engine/model/blocks/parallel/band_reader.hpp"

#include "engine/model/limits/parallel_layout.hpp"

namespace rs::engine::model {

BandReader::BandReader(const RegisterFile& registers, const StripeShare& share, const Ports& ports)
    : Block("band_reader",
            "1 cycle to hand over, " + std::to_string(2 * kMultiplyCycles) +
                " before and a word per cycle after it where the ray has bands that the last one had not"),
      registers_(registers),
      share_(share),
      in_(reads(ports.in)),
      stripe_free_(reads(ports.stripe_free)),
      requests_(writes(ports.requests)),
      to_rise_(writes(ports.to_rise)),
      to_march_(writes(ports.to_march)),
      to_place_(writes(ports.to_place)) {}

Activity BandReader::send_output() {
    if (!to_rise_.can_push() || !to_march_.can_push() || !to_place_.can_push()) return Activity::output_full;
    ColumnSetup setup = in_.pop();
    const BoardView& view = registers_.view(setup.view);
    if (!in_view_) {
        view_column_ = share_.first_column(setup.view);
        in_view_ = true;
        holds_cells_ = false;  // the object may have changed
    }
    if (column_ == 0) {
        --free_stripes_;
        stripe_ = (stripe_ + 1) % kStripeNumbers;
    }
    setup.stripe = stripe_;
    setup.column = column_;
    if (setup.kind == RayKind::shape) {
        const ShapeRegisters& shape = registers_.object_of(setup.view).shape;
        column_words_ = column_words(shape.bands);
        for (std::size_t p = 0; p < 2; ++p) {
            for (std::size_t line = 0; line < 2; ++line) {
                const std::int64_t column = setup.map_line[line] * shape.p_cells + setup.map_place[p];
                column_at_[p][line] = shape.cells + static_cast<WordAddress>(column * column_words_);
            }
        }
        requested_ = 0;
        setup.same_cells = holds_cells_ && column_at_ == held_at_;
        to_request_ = setup.same_cells ? 0 : 4 * column_words_;
        held_at_ = column_at_;
        holds_cells_ = true;
    }
    to_rise_.push(setup);
    to_march_.push(setup);
    to_place_.push(setup);
    multiplying_ = 0;
    ++view_column_;
    if (++column_ == kStripeColumns) {
        column_ = 0;
        view_column_ += (share_.pipes - 1) * kStripeColumns;
    }
    if (view_column_ >= view.width) {
        column_ = 0;
        in_view_ = false;
    }
    return Activity::busy;
}

Activity BandReader::tick(std::uint64_t) {
    if (stripe_free_.can_pop()) {
        stripe_free_.pop();
        ++free_stripes_;
    }
    if (to_request_ > 0) {
        if (!requests_.can_push()) return Activity::memory_port;
        const auto p = static_cast<std::size_t>(requested_ / (2 * column_words_));
        const int word = requested_ / 2 % column_words_;
        const WordAddress at = column_at_[p][static_cast<std::size_t>(requested_ % 2)] + static_cast<WordAddress>(word);
        requests_.push({at, false});
        ++requested_;
        --to_request_;
        return Activity::busy;
    }
    if (!in_.can_pop()) return Activity::idle;
    if (column_ == 0 && free_stripes_ == 0) return Activity::output_full;
    if (in_.front().kind == RayKind::shape && multiplying_ < 2 * kMultiplyCycles) {
        ++multiplying_;
        return Activity::busy;
    }
    return send_output();
}

}  // namespace rs::engine::model
