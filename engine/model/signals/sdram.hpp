#pragma once
// SDRAM chips of one memory channel: banks with one open row each, the timing rules between commands, and the 64-bit
// words. A device, not a block: the memory controller drives its pins, one command per cycle.
//
//     closed --activate--> open --read, write--> open --precharge--> closed;  refresh: all closed
//
// Every command is checked against the rules; `allows` reports whether it is legal in a cycle. Storage is allocated on
// the first write; unwritten words read as 0.

#include "engine/model/signals/board_config.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rs::engine::model {

using WordAddress = std::uint32_t;  // in words of 8 bytes

// Consecutive words of memory.
struct MemorySegment {
    WordAddress address = 0;
    std::vector<std::uint64_t> words;
};

enum class SdramCommand { activate, read, write, precharge, precharge_all, refresh };

class Sdram {
public:
    Sdram(const SdramShape& shape, const SdramTiming& timing);

    [[nodiscard]] int bank_of(WordAddress address) const {
        return static_cast<int>(address >> (shape_.row_bits + shape_.column_bits));
    }
    [[nodiscard]] int row_of(WordAddress address) const {
        return static_cast<int>((address >> shape_.column_bits) & ((1U << shape_.row_bits) - 1U));
    }
    [[nodiscard]] bool is_open(int bank) const { return banks_[static_cast<std::size_t>(bank)].row >= 0; }
    [[nodiscard]] bool has_row(int bank, int row) const { return banks_[static_cast<std::size_t>(bank)].row == row; }

    // True if the command is legal in cycle `now`. `address` gives bank and row; refresh and precharge_all ignore it.
    [[nodiscard]] bool allows(SdramCommand command, WordAddress address, std::uint64_t now) const;

    // Issues a command, which must be allowed (RS_CHECK). Read data are on the pins timing.read_latency cycles later;
    // write data arrive with the command.
    void issue(SdramCommand command, WordAddress address, std::uint64_t now);

    // Access to a word without a clock: for testbenches, and for the data of read and write commands.
    [[nodiscard]] std::uint64_t word(WordAddress address) const;
    void set_word(WordAddress address, std::uint64_t value);
    void set_words(const MemorySegment& segment);

    [[nodiscard]] const SdramTiming& timing() const { return timing_; }
    [[nodiscard]] const SdramShape& shape() const { return shape_; }
    [[nodiscard]] std::uint64_t commands(SdramCommand command) const {
        return issued_[static_cast<std::size_t>(command)];
    }

private:
    struct Bank {
        int row = -1;
        std::uint64_t activate_from = 0;  // first cycle in which the command is legal
        std::uint64_t column_from = 0;
        std::uint64_t precharge_from = 0;
    };
    [[nodiscard]] const Bank& bank(WordAddress address) const {
        return banks_[static_cast<std::size_t>(bank_of(address))];
    }
    void close(Bank& bank, std::uint64_t now) const;

    static constexpr int kPageBits = 12;  // words of storage: allocated in pages of 32 KByte
    using Page = std::array<std::uint64_t, std::size_t{1} << kPageBits>;

    SdramShape shape_;
    SdramTiming timing_;
    std::vector<Bank> banks_;
    std::uint64_t any_from_ = 0;    // first cycle of any command after a refresh
    std::uint64_t write_from_ = 0;  // first cycle of a write after a read (turnaround of the data bus)
    std::array<std::uint64_t, 6> issued_{};
    std::vector<std::unique_ptr<Page>> pages_;
};

}  // namespace rs::engine::model
