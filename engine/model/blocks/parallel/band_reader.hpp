#pragma once
// Band reader: assigns a column its place in the stripe, sends its set-up to the three blocks that store a part of it,
// and requests the four columns of cells beside its ray, always all four, a word per cycle: for each of the two places
// in p, word by word, first that of the first line and then that of the second. The words go to cell_march, which
// stores them; a ray beside the same four columns as the previous ray requests nothing. The addresses take two products
// of 9 cycles, with one multiplier per line. The first column of a stripe waits until the second to last stripe is
// drawn, because it uses the same storage.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/arithmetic.hpp"
#include "engine/model/signals/parallel_messages.hpp"
#include "engine/model/signals/registers.hpp"

#include <array>

namespace rs::engine::model {

class BandReader final : public Block {
public:
    struct Ports {
        Fifo<ColumnSetup>& in;
        Fifo<Done>& stripe_free;
        Fifo<MemoryRead>& requests;
        Fifo<ColumnSetup>& to_rise;
        Fifo<ColumnSetup>& to_march;
        Fifo<ColumnSetup>& to_place;
    };
    BandReader(const RegisterFile& registers, const StripeShare& share, const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override {
        return "stripe " + std::to_string(stripe_) + " column " + std::to_string(column_) + ", words to request " +
               std::to_string(to_request_) + ", free stripes " + std::to_string(free_stripes_);
    }

private:
    Activity send_output();
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
    int column_ = 0;       // next column of the stripe
    int view_column_ = 0;  // next column of the view
    bool in_view_ = false;
    int multiplying_ = 0;
    int requested_ = 0;
    int to_request_ = 0;
    using CellAddresses = std::array<std::array<WordAddress, 2>, 2>;  // [p][line]: first word of a column of cells
    CellAddresses column_at_{};
    CellAddresses held_at_{};  // columns whose words are in cell_march
    bool holds_cells_ = false;
    int column_words_ = 0;
};

}  // namespace rs::engine::model
