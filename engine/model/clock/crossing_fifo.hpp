#pragma once
// FIFO between two clocks: a dual-port RAM whose pointers pass through two flip-flops of the other clock. A push is
// visible to the reader at the second edge of its clock after the push; space freed by a pop is visible to the writer
// at the second edge of its clock after the pop. Edges of both clocks never coincide (simulator.hpp).

#include "rayspace/api/types/check.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace rs::engine::model {

class CrossingState {
public:
    CrossingState(std::string name, int depth, int width_bits)
        : name_(std::move(name)), depth_(depth), width_bits_(width_bits) {
        RS_CHECK(depth >= 1 && width_bits >= 1);
    }
    virtual ~CrossingState() = default;
    CrossingState(const CrossingState&) = delete;
    CrossingState& operator=(const CrossingState&) = delete;

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] int depth() const { return depth_; }
    [[nodiscard]] int width_bits() const { return width_bits_; }
    [[nodiscard]] int count() const { return static_cast<int>(pushes_ - pops_); }  // actual number of items
    [[nodiscard]] std::uint64_t total_pushed() const { return pushes_; }

    [[nodiscard]] int room() const { return depth_ - static_cast<int>(pushes_ - pops_seen_[1]); }  // writer's view
    [[nodiscard]] bool can_push() const { return room() > 0; }
    [[nodiscard]] int visible() const { return static_cast<int>(pushes_seen_[1] - pops_); }  // reader's view
    [[nodiscard]] bool can_pop() const { return visible() > 0; }

    bool commit_writer() {
        pops_seen_[1] = pops_seen_[0];
        pops_seen_[0] = pops_;
        const bool moved = pushed_;
        pushes_ += static_cast<std::uint64_t>(pushed_);
        pushed_ = false;
        return moved;
    }
    bool commit_reader() {
        pushes_seen_[1] = pushes_seen_[0];
        pushes_seen_[0] = pushes_;
        const bool moved = popped_;
        pops_ += static_cast<std::uint64_t>(popped_);
        popped_ = false;
        return moved;
    }
    [[nodiscard]] virtual std::string item_text(int index) const = 0;

protected:
    std::uint64_t pushes_ = 0;
    std::uint64_t pops_ = 0;
    bool pushed_ = false;
    bool popped_ = false;

private:
    std::string name_;
    int depth_;
    int width_bits_;
    std::uint64_t pushes_seen_[2] = {0, 0};
    std::uint64_t pops_seen_[2] = {0, 0};
};

template <class T>
class CrossingFifo final : public CrossingState {
public:
    CrossingFifo(std::string name, int depth, int width_bits)
        : CrossingState(std::move(name), depth, width_bits), items_(static_cast<std::size_t>(depth)) {}

    void push(const T& item) {
        RS_CHECK(can_push() && !pushed_);
        items_[pushes_ % items_.size()] = item;
        pushed_ = true;
    }
    [[nodiscard]] const T& front() const {
        RS_CHECK(can_pop() && !popped_);
        return items_[pops_ % items_.size()];
    }
    T pop() {
        const T item = front();
        popped_ = true;
        return item;
    }
    [[nodiscard]] std::string item_text(int index) const override {
        return text(items_[(pops_ + static_cast<std::uint64_t>(index)) % items_.size()]);
    }

private:
    std::vector<T> items_;
};

}  // namespace rs::engine::model
