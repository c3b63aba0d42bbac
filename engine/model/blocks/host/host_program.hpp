#pragma once
// Contents of host memory: register values that the driver writes for each rendering cycle, and images received from
// the board. Not a block: the environment of the board.

#include "engine/model/signals/registers.hpp"
#include "rayspace/api/types/check.hpp"

#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

namespace rs::engine::model {

struct HostProgram {
    ViewBank bank;
    int register_writes = 0;  // 32-bit bus writes that transfer it
};

// Program of a rendering cycle, with as many register writes as the planes of the views' objects need.
HostProgram host_program(std::vector<BoardView> views, const std::vector<ObjectRegisters>& objects);

// Programs by number of their start command. Finished programs are dropped, so that memory stays bounded over many
// cycles.
class HostPrograms {
public:
    void push_back(HostProgram program) { programs_.push_back(std::move(program)); }
    [[nodiscard]] std::uint64_t size() const { return dropped_ + programs_.size(); }  // including dropped ones
    [[nodiscard]] const HostProgram& operator[](std::uint64_t number) const {
        RS_CHECK(number >= dropped_ && number < size());
        return programs_[static_cast<std::size_t>(number - dropped_)];
    }
    void drop_before(std::uint64_t number) {
        for (; dropped_ < number && !programs_.empty(); ++dropped_) programs_.pop_front();
    }
    [[nodiscard]] std::size_t stored() const { return programs_.size(); }

private:
    std::deque<HostProgram> programs_;
    std::uint64_t dropped_ = 0;
};

struct HostImage {
    int view = 0;
    bool last_view = false;
    std::uint64_t arrived = 0;  // bus clock of its last word
    std::vector<std::uint64_t> words;
    std::size_t expected_words = 0;
};

}  // namespace rs::engine::model
