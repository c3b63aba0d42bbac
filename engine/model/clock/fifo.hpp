#pragma once
// Two-phase FIFOs: the only connection between blocks. During a cycle all blocks see the FIFO as it was at the start of
// the cycle; pushes and pops take effect at its end (commit). Therefore the order in which blocks are ticked cannot
// matter: a push and the space freed by a pop are visible in the next cycle. A FIFO of depth 1 moves an item every
// second cycle, deeper ones one per cycle.
//
// One push and one pop per cycle, as in a RAM with a write port and a read port. A violation is a defect of the block
// and stops the program (RS_CHECK).

#include "rayspace/api/types/check.hpp"

#include <bit>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace rs::engine::model {

class FifoState;

// Group of FIFOs: each registers itself, and the suffix of the group is appended to its name.
class FifoGroup {
public:
    explicit FifoGroup(std::string suffix = "") : suffix_(std::move(suffix)) {}
    FifoGroup(const FifoGroup&) = delete;
    FifoGroup& operator=(const FifoGroup&) = delete;

    [[nodiscard]] const std::vector<FifoState*>& fifos() const { return fifos_; }

private:
    friend class FifoState;
    std::string suffix_;
    std::vector<FifoState*> fifos_;
};

// State of a FIFO without its items: for diagrams, waveforms and dumps.
class FifoState {
public:
    FifoState(std::string name, int depth, int width_bits)
        : name_(std::move(name)), depth_(depth), width_bits_(width_bits) {
        RS_CHECK(depth >= 1 && width_bits >= 1);
    }
    FifoState(FifoGroup& group, const std::string& name, int depth, int width_bits)
        : FifoState(name + group.suffix_, depth, width_bits) {
        group.fifos_.push_back(this);
    }
    virtual ~FifoState() = default;
    FifoState(const FifoState&) = delete;
    FifoState& operator=(const FifoState&) = delete;

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] int depth() const { return depth_; }
    [[nodiscard]] int width_bits() const { return width_bits_; }

    // State at the beginning of the cycle.
    [[nodiscard]] int count() const { return count_; }
    [[nodiscard]] int room() const { return depth_ - count_; }
    [[nodiscard]] bool can_push() const { return count_ < depth_; }
    [[nodiscard]] bool can_pop() const { return count_ > 0; }
    [[nodiscard]] std::uint64_t total_pushed() const { return total_pushed_; }

    // Ends the cycle. Returns true if an item was pushed or popped.
    bool commit() {
        if (!pushed_ && !popped_) return false;
        count_ += static_cast<int>(pushed_) - static_cast<int>(popped_);
        total_pushed_ += static_cast<std::uint64_t>(pushed_);
        pushed_ = popped_ = false;
        return true;
    }

    // Item `index` from the front, as text, for the dump of a stalled run.
    [[nodiscard]] virtual std::string item_text(int index) const = 0;

protected:
    int count_ = 0;
    bool pushed_ = false;
    bool popped_ = false;

private:
    std::string name_;
    int depth_;
    int width_bits_;
    std::uint64_t total_pushed_ = 0;
};

// T requires `std::string text(const T&)`, found by argument-dependent look-up. `width_bits`: bits that the hardware
// stores per item.
template <class T>
class Fifo final : public FifoState {
public:
    Fifo(std::string name, int depth, int width_bits)
        : FifoState(std::move(name), depth, width_bits), items_(places(depth)) {}
    Fifo(FifoGroup& group, const std::string& name, int depth, int width_bits)
        : FifoState(group, name, depth, width_bits), items_(places(depth)) {}

    void push(const T& item) {
        RS_CHECK(can_push() && !pushed_);
        items_[(head_ + static_cast<std::size_t>(count_) + (popped_ ? mask_ : 0)) & mask_] = item;
        pushed_ = true;
    }
    [[nodiscard]] const T& front() const {
        RS_CHECK(can_pop() && !popped_);
        return items_[head_];
    }
    T pop() {
        RS_CHECK(can_pop() && !popped_);
        const T item = items_[head_];
        head_ = (head_ + 1) & mask_;
        popped_ = true;
        return item;
    }
    [[nodiscard]] std::string item_text(int index) const override {
        return text(items_[(head_ + static_cast<std::size_t>(index)) & mask_]);
    }

private:
    static std::size_t places(int depth) { return std::bit_ceil(static_cast<std::size_t>(depth)); }

    std::vector<T> items_;
    std::size_t mask_ = items_.size() - 1;
    std::size_t head_ = 0;
};

}  // namespace rs::engine::model
