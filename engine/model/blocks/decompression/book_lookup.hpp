#pragma once
// Codebook look-up: the last step of block decompression. One bank of block RAM for each stage of flat and of predicted
// records gives Y, U and V of a pixel's entry in one cycle. The sums are added to the flat colour and clamped, then the
// predicted sums are added to the result:
//
//     1 addresses | 2 banks | 3, 4 two trees of adders | 5 + flat colour, clamp | 6 + prediction, clamp
//
// A pixel per cycle; the second and third prediction use the predicted banks again and cost one cycle each.
//
// The banks hold the codebooks of one object. A pixel of another object waits until all pixels before it have left;
// then its codebooks are read, a word per cycle, through the memory port of this block.

#include "engine/model/blocks/shared/stages.hpp"
#include "engine/model/clock/block.hpp"
#include "engine/model/signals/coded_messages.hpp"
#include "engine/model/signals/registers.hpp"

#include <array>
#include <optional>

namespace rs::engine::model {

// Codebook banks: [flat, predicted][stage], block RAM of 256 entries.
struct BookBanks {
    static constexpr std::size_t kBlockBytes = std::size_t{codec::kBookEntries} * codec::kBlockDimensions;
    static constexpr std::size_t kQuarterBytes = std::size_t{codec::kBookEntries} * codec::kQuarterDimensions;
    static constexpr std::size_t kAlphaBytes = std::size_t{codec::kBookEntries} * 16;
    static constexpr std::size_t kBits =
        8 * (2 * (codec::kMaxBlockStages * kBlockBytes + codec::kMaxQuarterStages * kQuarterBytes) + kAlphaBytes);
    std::array<std::array<std::array<std::int8_t, kBlockBytes>, codec::kMaxBlockStages>, 2> block;
    std::array<std::array<std::array<std::int8_t, kQuarterBytes>, codec::kMaxQuarterStages>, 2> quarter;
    std::array<std::uint8_t, kAlphaBytes> alpha;

    // Sets byte `place` of the codebooks in memory order, for an object with the given counts.
    void set_byte(const BookCounts& counts, std::size_t place, std::uint8_t value);
};

// Sum of a pixel's codebook entries, without the clock.
YuvaPixel decode_coded_pixel(const BookBanks& banks, const CodedPixel& pixel);

class BookLookup final : public Block {
public:
    static constexpr int kStages = 6;
    struct Ports {
        Fifo<CodedPixel>& in;
        Fifo<MemoryRead>& requests;
        Fifo<MemoryWord>& words;
        Fifo<YuvaPixel>& out;
    };
    BookLookup(const RegisterFile& registers, const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override {
        return loading_ ? "book words written " + std::to_string(written_)
                        : "books of load " + std::to_string(resident_);
    }
    [[nodiscard]] std::uint64_t book_loads() const { return book_loads_; }

private:
    Activity load();
    Activity look_up(std::optional<YuvaPixel>& out);

    const RegisterFile& registers_;
    Fifo<CodedPixel>& in_;
    Fifo<MemoryRead>& requests_;
    Fifo<MemoryWord>& words_;
    PipelinedStage<YuvaPixel> stage_;
    int turns_ = 0;  // cycles for which the front pixel has used the banks
    BookBanks banks_{};
    std::uint32_t resident_ = 0;  // serial number of the object's load; 0: none
    bool loading_ = false;
    std::uint32_t requested_ = 0;
    std::uint32_t written_ = 0;
    std::uint64_t book_loads_ = 0;
};

}  // namespace rs::engine::model
