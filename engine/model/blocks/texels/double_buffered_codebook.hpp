#pragma once
// Codebook look-up with two sets of banks: book_lookup, whose books are loaded beside the look-ups. It knows the views
// that will come, in order. Where the object of the next one is in neither set its books are read, a word per cycle,
// into the set all of whose views are done: while a view is drawn, those of the next one come. A pixel waits where its
// object's books are not there yet.

#include "engine/model/blocks/decompression/book_lookup.hpp"
#include "engine/model/blocks/shared/stages.hpp"

#include <array>
#include <memory>
#include <optional>

namespace rs::engine::model {

class DoubleBufferedCodebook final : public Block {
public:
    static constexpr int kStages = BookLookup::kStages;
    static constexpr std::size_t kBits = 2 * BookBanks::kBits;
    DoubleBufferedCodebook(const RegisterFile& registers, Fifo<ViewJob>& jobs, Fifo<Done>& view_done,
                           Fifo<CodedPixel>& in, Fifo<MemoryRead>& requests, Fifo<MemoryWord>& words,
                           Fifo<YuvaPixel>& out);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override {
        return "books of loads " + std::to_string(sets_[0].serial) + " and " + std::to_string(sets_[1].serial) +
               (loading_ >= 0 ? ", written " + std::to_string(written_) : "");
    }
    [[nodiscard]] std::uint64_t book_loads() const { return book_loads_; }

private:
    bool next_view();
    bool load();
    Activity look_up(std::optional<YuvaPixel>& out);

    const RegisterFile& registers_;
    Fifo<ViewJob>& jobs_;
    Fifo<Done>& view_done_;
    Fifo<CodedPixel>& in_;
    Fifo<MemoryRead>& requests_;
    Fifo<MemoryWord>& words_;
    struct Set {
        std::uint32_t serial = 0;     // number of the object's load; 0: none
        std::uint64_t last_view = 0;  // that needs it, counted from 1
        std::unique_ptr<BookBanks> banks = std::make_unique<BookBanks>();
    };
    std::array<Set, 2> sets_;
    std::uint64_t views_ = 0;       // known
    std::uint64_t views_done_ = 0;  // of them
    int loading_ = -1;              // set
    ObjectRegisters object_;        // whose books are loaded
    std::uint32_t requested_ = 0;
    std::uint32_t written_ = 0;
    std::uint64_t book_loads_ = 0;
    int turns_ = 0;  // for which the first pixel has had the banks
    PipelinedStage<YuvaPixel> stage_;
};

}  // namespace rs::engine::model
