#pragma once
// Codebook look-up with two sets of banks: book_lookup whose codebooks are loaded concurrently with look-ups. It
// receives the views in advance, in order. If the object of the next view is in neither set, its codebooks are read, a
// word per cycle, into the set whose views are all done, while the current view is drawn. A pixel waits until the
// codebooks of its object are loaded.

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
    struct Ports {
        Fifo<ViewJob>& jobs;
        Fifo<Done>& view_done;
        Fifo<CodedPixel>& in;
        Fifo<MemoryRead>& requests;
        Fifo<MemoryWord>& words;
        Fifo<YuvaPixel>& out;
    };
    DoubleBufferedCodebook(const RegisterFile& registers, const Ports& ports);
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
    struct BankSet {
        std::uint32_t serial = 0;     // number of the object's load; 0: none
        std::uint64_t last_view = 0;  // last view that needs the set, counted from 1
        std::unique_ptr<BookBanks> banks = std::make_unique<BookBanks>();
    };
    std::array<BankSet, 2> sets_;
    std::uint64_t views_ = 0;       // views received
    std::uint64_t views_done_ = 0;  // views finished
    int loading_ = -1;              // set that is being loaded; -1: none
    ObjectRegisters object_;        // object whose codebooks are being loaded
    std::uint32_t requested_ = 0;
    std::uint32_t written_ = 0;
    std::uint64_t book_loads_ = 0;
    int turns_ = 0;  // cycles for which the front pixel has used the banks
    PipelinedStage<YuvaPixel> stage_;
};

}  // namespace rs::engine::model
