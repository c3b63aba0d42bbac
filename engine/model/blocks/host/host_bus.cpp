#include "engine/model/blocks/host/host_bus.hpp"

#include <algorithm>

namespace rs::engine::model {

namespace {

int transfers_per_word(const PciSettings& settings) {
    return 64 / settings.width_bits;
}

}  // namespace

int HostBus::burst_transfers(const PciSettings& settings, int words) {
    return (words * transfers_per_word(settings) + settings.compression - 1) / settings.compression;
}

int HostBus::burst_clocks(const PciSettings& settings, int words) {
    return settings.grant_clocks + 1 + settings.target_clocks +
           burst_transfers(settings, words) * (1 + settings.wait_per_transfer) + 1;
}

std::uint64_t HostBus::image_clocks(const PciSettings& settings, std::uint64_t words) {
    const auto per_burst = static_cast<std::uint64_t>(settings.image_words_per_burst());
    const auto rest = static_cast<int>(words % per_burst);
    return words / per_burst * static_cast<std::uint64_t>(burst_clocks(settings, settings.image_words_per_burst())) +
           static_cast<std::uint64_t>(rest > 0 ? burst_clocks(settings, rest) : 0) +
           static_cast<std::uint64_t>(settings.interrupt_clocks);
}

HostBus::HostBus(const PciSettings& settings, const HostPrograms& programs, const Ports& ports)
    : Block("host_bus", "a burst of " + std::to_string(settings.image_words_per_burst()) + " words in " +
                            std::to_string(burst_clocks(settings, settings.image_words_per_burst())) +
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
    return words_left_ > 0 && words_.visible() >= std::min(words_left_, settings_.image_words_per_burst());
}

Activity HostBus::tick(std::uint64_t now) {
    const bool writes_beside = settings_.dedicated != 0 && write_beside();
    const Activity activity = advance(now);
    return activity == Activity::idle && writes_beside ? Activity::busy : activity;
}

// After the last register of a program: sends the start command. Returns false if the board stalls the write.
bool HostBus::finish_register_write() {
    if (registers_left_ > 0) return true;
    if (!commands_.can_push()) return false;
    commands_.push({next_program_++});
    registers_left_ = -1;
    return true;
}

// One clock of the register writes that do not use this bus. Returns false if there is nothing to write.
bool HostBus::write_beside() {
    if (register_clocks_left_ == 0) {
        if (next_program_ == programs_.size()) return false;
        if (registers_left_ < 0) registers_left_ = programs_[next_program_].register_writes;
        --registers_left_;
        ++counters_.register_writes;
        register_clocks_left_ = settings_.register_clocks;
    }
    if (--register_clocks_left_ == 0 && !finish_register_write()) register_clocks_left_ = 1;
    return true;
}

Activity HostBus::advance(std::uint64_t now) {
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
    } else if (state == State::register_write && !finish_register_write()) {
        left_ = 1;
        return Activity::target_wait;  // the board stalls the last write
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
    const bool host_requests = settings_.dedicated == 0 && next_program_ < programs_.size();
    const bool board_requests = burst_is_ready();
    if (host_requests && (!board_requests || !host_was_last_)) {
        if (registers_left_ < 0) registers_left_ = programs_[next_program_].register_writes;
        --registers_left_;
        ++counters_.register_writes;
        host_was_last_ = true;
        enter(State::register_write, settings_.register_clocks);
        return advance(now);
    }
    if (!board_requests) return Activity::idle;
    host_was_last_ = false;
    burst_words_left_ = std::min(words_left_, settings_.image_words_per_burst());
    burst_left_ = burst_transfers(settings_, burst_words_left_);
    ++counters_.bursts;
    const auto asked = counters_.bursts;
    retry_ = settings_.retry_every > 0 && asked % static_cast<std::uint64_t>(settings_.retry_every) == 0;
    enter(State::grant, settings_.grant_clocks);
    return advance(now);
}

Activity HostBus::transfer(std::uint64_t now) {
    if (--left_ > 0) return Activity::master_wait;
    --burst_left_;
    counters_.image_bytes += static_cast<std::uint64_t>(settings_.width_bits / 8);
    // A word is complete when the transfers left are those of the words behind it.
    if (burst_left_ <= burst_transfers(settings_, burst_words_left_ - 1)) {
        images_.back().words.push_back(words_.pop().data);
        images_.back().arrived = now;
        --burst_words_left_;
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
