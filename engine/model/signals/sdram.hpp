#pragma once
// The SDRAM chips behind one memory channel: banks with one open row each, the time rules between commands, and the
// 64-bit words themselves. A device, not a block: the memory controller drives its pins, one command per cycle.
//
//     closed --activate--> open --read, write--> open --precharge--> closed;  refresh: all closed
//
// Every command is checked against the rules; `allows` reports whether it is legal in a cycle. Storage is taken as it
// is written, so 1 GByte costs nothing until it is used; what was never written reads as 0.

#include "engine/model/signals/board_config.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rs::engine::model {

using WordAddress = std::uint32_t;  // of 8 bytes

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

    // Legal in cycle `now`? `address` gives bank and row; refresh and precharge_all look at no address.
    [[nodiscard]] bool allows(SdramCommand command, WordAddress address, std::uint64_t now) const;

    // Issues a command, which must be allowed (RS_CHECK). A read's data are on the pins timing.read_latency cycles
    // later; a write brings its data along.
    void issue(SdramCommand command, WordAddress address, std::uint64_t now);

    // The words themselves; the testbench's back door, and what a read or write moves.
    [[nodiscard]] std::uint64_t word(WordAddress address) const;
    void set_word(WordAddress address, std::uint64_t value);

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

    static constexpr int kPageBits = 12;  // of storage: 32 KByte at a time
    using Page = std::array<std::uint64_t, std::size_t{1} << kPageBits>;

    SdramShape shape_;
    SdramTiming timing_;
    std::vector<Bank> banks_;
    std::uint64_t any_from_ = 0;    // after a refresh
    std::uint64_t write_from_ = 0;  // after a read: the bus must turn round
    std::array<std::uint64_t, 6> issued_{};
    std::vector<std::unique_ptr<Page>> pages_;
};

}  // namespace rs::engine::model
