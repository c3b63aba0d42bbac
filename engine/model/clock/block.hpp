#pragma once
// A block of the board: a clocked machine that communicates through FIFOs only. It declares its FIFOs (the diagram is
// generated from the declarations), counts its cycles by activity, and works in tick(). Blocks hold no pointers to
// other blocks; board_top constructs and wires them.

#include "engine/model/clock/activity.hpp"
#include "engine/model/clock/crossing_fifo.hpp"
#include "engine/model/clock/fifo.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace rs::engine::model {

// Name of a block or FIFO without the suffix of its pipe ("_p" and digits).
inline std::string name_without_pipe(const std::string& name) {
    const std::size_t digits = name.find_last_not_of("0123456789");
    const bool has_pipe = digits != std::string::npos && digits >= 1 && digits + 1 < name.size() &&
                          name[digits] == 'p' && name[digits - 1] == '_';
    return has_pipe ? name.substr(0, digits - 1) : name;
}

struct Port {
    enum class Direction { in, out };
    Direction direction = Direction::in;
    std::string fifo;
    int width_bits = 0;
    int depth = 0;
};

class Block {
public:
    // `timing`: latency and interval between results in cycles, as one line of the diagram.
    Block(std::string name, std::string timing) : name_(std::move(name)), timing_(std::move(timing)) {}
    virtual ~Block() = default;
    Block(const Block&) = delete;
    Block& operator=(const Block&) = delete;

    // Executes one cycle of the block's clock. `now` counts cycles from 0.
    virtual Activity tick(std::uint64_t now) = 0;

    void clock(std::uint64_t now) {
        last_ = tick(now);
        ++counts_.cycles[static_cast<std::size_t>(last_)];
    }

    [[nodiscard]] const std::string& name() const { return name_; }
    // Suffix of a block that has several instances.
    void append_to_name(const std::string& suffix) { name_ += suffix; }
    [[nodiscard]] const std::string& timing() const { return timing_; }
    [[nodiscard]] const std::vector<Port>& ports() const { return ports_; }
    [[nodiscard]] const ActivityCounts& counts() const { return counts_; }
    [[nodiscard]] Activity last_activity() const { return last_; }

    // Internal registers as text, for the dump of a stalled run.
    [[nodiscard]] virtual std::string state_text() const { return {}; }

protected:
    template <class F>
    F& reads(F& fifo) {
        ports_.push_back({Port::Direction::in, fifo.name(), fifo.width_bits(), fifo.depth()});
        return fifo;
    }
    template <class F>
    F& writes(F& fifo) {
        ports_.push_back({Port::Direction::out, fifo.name(), fifo.width_bits(), fifo.depth()});
        return fifo;
    }

private:
    std::string name_;
    std::string timing_;
    std::vector<Port> ports_;
    ActivityCounts counts_;
    Activity last_ = Activity::idle;
};

}  // namespace rs::engine::model
