#pragma once
// Band reader: gives a column its place in the stripe, hands its set-up to the three blocks that keep a part of it, and
// requests the four columns of cells beside its ray, all of them always, a word a cycle: for each of the two places in
// p, word by word, that of the first line and then that of the second. The words go to cell_march, which keeps them:
// for a ray beside the same four columns as the last one nothing is requested. The addresses take two products of 9
// cycles, with a multiplier for either line. The first column of a stripe waits until the stripe before the last is
// drawn, whose place it takes.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/arithmetic.hpp"
#include "engine/model/signals/parallel_messages.hpp"
#include "engine/model/signals/registers.hpp"

#include <array>

namespace rs::engine::model {

class BandReader final : public Block {
public:
    BandReader(const RegisterFile& registers, const StripeShare& share, Fifo<ColumnSetup>& in, Fifo<Done>& stripe_free,
               Fifo<MemoryRead>& requests, Fifo<ColumnSetup>& to_rise, Fifo<ColumnSetup>& to_march,
               Fifo<ColumnSetup>& to_place);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override {
        return "stripe " + std::to_string(stripe_) + " column " + std::to_string(column_) + ", words to ask " +
               std::to_string(to_request_) + ", free stripes " + std::to_string(free_stripes_);
    }

private:
    Activity hand_over();
    const RegisterFile& registers_;
    StripeShare share_;
    Fifo<ColumnSetup>& in_;
    Fifo<Done>& stripe_free_;
    Fifo<MemoryRead>& requests_;
    Fifo<ColumnSetup>& to_rise_;
    Fifo<ColumnSetup>& to_march_;
    Fifo<ColumnSetup>& to_place_;
    int free_stripes_ = kStripeSlots;
    int stripe_ = kStripeNumbers - 1;
    int column_ = 0;       // next of the stripe
    int view_column_ = 0;  // next of the view
    bool in_view_ = false;
    int multiplying_ = 0;
    int requested_ = 0;
    int to_request_ = 0;
    using CellAddresses = std::array<std::array<WordAddress, 2>, 2>;  // [p][line]: a column's first word
    CellAddresses column_at_{};
    CellAddresses held_at_{};  // of the words that cell_march has
    bool holds_cells_ = false;
    int column_words_ = 0;
};

}  // namespace rs::engine::model
