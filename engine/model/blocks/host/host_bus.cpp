#include "engine/model/blocks/host/host_bus.hpp"

#include <algorithm>

namespace rs::engine::model {

int HostBus::burst_clocks(const PciSettings& settings, int words) {
    return settings.grant_clocks + 1 + settings.target_clocks + 2 * words * (1 + settings.wait_per_transfer) + 1;
}

HostBus::HostBus(const PciSettings& settings, const HostPrograms& programs, const Ports& ports)
    : Block("host_bus", "a burst of " + std::to_string(settings.burst_words) + " words in " +
                            std::to_string(burst_clocks(settings, settings.burst_words)) +
                            " bus clocks, a register write in " + std::to_string(settings.register_clocks)),
      settings_(settings),
      programs_(programs),
      words_(reads(ports.words)),
      commands_(writes(ports.commands)),
      transferred_(writes(ports.transferred)) {}

void HostBus::enter(State state, int clocks) {
    state_ = state;
    left_ = clocks;
}

bool HostBus::burst_is_ready() const {
    return words_left_ > 0 && words_.visible() >= std::min(words_left_, settings_.burst_words);
}

Activity HostBus::tick(std::uint64_t now) {
    if (state_ == State::idle) return decide(now);
    if (state_ == State::data) return transfer(now);
    const State state = state_;
    if (--left_ > 0) {
        // fall through: activity of a state that continues
    } else if (state == State::grant) {
        enter(State::address, 1);
    } else if (state == State::address) {
        enter(State::target, settings_.target_clocks);
    } else if (state == State::target) {
        if (retry_) {
            ++counters_.retries;
            enter(State::turnaround, 2);
        } else {
            enter(State::data, 1 + settings_.wait_per_transfer);
        }
    } else if (state == State::register_write && registers_left_ == 0) {
        if (!commands_.can_push()) {
            left_ = 1;
            return Activity::target_wait;  // the board stalls the last write
        }
        commands_.push({next_program_++});
        registers_left_ = -1;
        enter(State::idle, 0);
    } else {
        enter(State::idle, 0);
    }
    switch (state) {
        case State::grant:
            return Activity::arbitration;
        case State::target:
            return Activity::target_wait;
        case State::turnaround:
            return Activity::turnaround;
        default:
            return Activity::busy;
    }
}

// Arbitrates the bus. The clock of the decision is the first clock of the winner.
Activity HostBus::decide(std::uint64_t now) {
    if (words_left_ == 0 && words_.can_pop() && words_.front().head) {
        const ImageWord head = words_.pop();
        words_left_ = static_cast<int>(head.data & 0xFFFFFFFFU);
        images_.push_back(
            {static_cast<int>(head.data >> 32U), head.last_view, now, {}, static_cast<std::size_t>(words_left_)});
        images_.back().words.reserve(images_.back().expected_words);
        return Activity::busy;
    }
    const bool host_requests = next_program_ < programs_.size();
    const bool board_requests = burst_is_ready();
    if (host_requests && (!board_requests || !host_was_last_)) {
        if (registers_left_ < 0) registers_left_ = programs_[next_program_].register_writes;
        --registers_left_;
        ++counters_.register_writes;
        host_was_last_ = true;
        enter(State::register_write, settings_.register_clocks);
        return tick(now);
    }
    if (!board_requests) return Activity::idle;
    host_was_last_ = false;
    burst_left_ = 2 * std::min(words_left_, settings_.burst_words);
    ++counters_.bursts;
    const auto asked = counters_.bursts;
    retry_ = settings_.retry_every > 0 && asked % static_cast<std::uint64_t>(settings_.retry_every) == 0;
    enter(State::grant, settings_.grant_clocks);
    return tick(now);
}

Activity HostBus::transfer(std::uint64_t now) {
    if (--left_ > 0) return Activity::master_wait;
    --burst_left_;
    counters_.image_bytes += 4;
    if (burst_left_ % 2 == 0) {  // second half of the word: the word is complete
        images_.back().words.push_back(words_.pop().data);
        images_.back().arrived = now;
        --words_left_;
    }
    if (burst_left_ > 0) {
        enter(State::data, 1 + settings_.wait_per_transfer);
        return Activity::busy;
    }
    return after_burst();
}

Activity HostBus::after_burst() {
    if (words_left_ == 0) {
        if (images_.back().last_view) transferred_.push({});
        enter(State::interrupt, 1 + settings_.interrupt_clocks);
    } else {
        enter(State::turnaround, 1);
    }
    return Activity::busy;
}

std::string HostBus::state_text() const {
    constexpr const char* kNames[] = {"idle", "grant",      "address",        "target",
                                      "data", "turnaround", "register write", "interrupt"};
    return std::string(kNames[static_cast<int>(state_)]) + ", words left " + std::to_string(words_left_) +
           ", programs written " + std::to_string(next_program_) + " of " + std::to_string(programs_.size());
}

}  // namespace rs::engine::model
