#include "engine/model/blocks/memory/disk_controller.hpp"

#include <algorithm>

namespace rs::engine::model {

constexpr std::uint64_t kSector_bytes = 512;

DiskController::DiskController(const DiskSettings& settings, RegisterFile& registers, const Ports& ports)
    : Block("disk_controller", "a word in " + std::to_string(4 * settings.cycles_per_transfer) + " cycles"),
      settings_(settings),
      registers_(registers),
      words_(writes(ports.words)),
      loaded_(reads(ports.loaded)),
      object_ready_(writes(ports.object_ready)) {}

bool DiskController::is_loading(int slot) const {
    return std::any_of(jobs_.begin(), jobs_.end(), [&](const LoadJob& job) { return job.slot == slot; });
}

void DiskController::begin(std::uint64_t now) {
    all_bytes_ = sent_bytes_ = platter_bytes_ = 0;
    for (const MemorySegment& segment : *jobs_.front().segments) all_bytes_ += 8 * segment.words.size();
    segment_ = word_ = 0;
    next_sector_ = now + settings_.start_cycles + static_cast<std::uint64_t>(settings_.media_cycles_per_sector);
    stalled_ = false;
    wait_ = settings_.cycles_per_transfer;
    last_byte_ = now;
    loads_.push_back({jobs_.front().slot, false, now, 0, all_bytes_, 0});
    active_ = true;
}

void DiskController::read_platter(std::uint64_t now) {
    if (now < next_sector_ || platter_bytes_ >= all_bytes_) return;
    const std::uint64_t room = static_cast<std::uint64_t>(settings_.buffer_sectors) * kSector_bytes;
    if (platter_bytes_ - sent_bytes_ + kSector_bytes > room) return;  // drive buffer full
    platter_bytes_ += kSector_bytes;
    next_sector_ = now + static_cast<std::uint64_t>(settings_.media_cycles_per_sector);
    if (!stalled_ && settings_.stall_after_bytes > 0 && platter_bytes_ >= settings_.stall_after_bytes) {
        next_sector_ += settings_.stall_cycles;
        stalled_ = true;
    }
}

void DiskController::end(std::uint64_t now, bool failed) {
    loads_.back().finished = now;
    loads_.back().failed = failed;
    if (!failed) {
        ObjectRegisters registers = jobs_.front().registers;
        registers.valid = true;
        registers_.loaded[static_cast<std::size_t>(jobs_.front().slot)] = registers;
        object_ready_.push({jobs_.front().slot});
    }
    jobs_.pop_front();
    active_ = false;
}

Activity DiskController::tick(std::uint64_t now) {
    if (!active_) {
        if (jobs_.empty()) return Activity::idle;
        begin(now);
        return Activity::busy;
    }
    read_platter(now);
    if (sent_bytes_ == all_bytes_) {
        if (!loaded_.can_pop() || !object_ready_.can_push()) return Activity::output_full;
        loaded_.pop();
        end(now, false);
        return Activity::busy;
    }
    if (wait_ > 1) {
        --wait_;
        return Activity::busy;
    }
    if (platter_bytes_ <= sent_bytes_) {
        ++loads_.back().underrun_cycles;
        if (now - last_byte_ < settings_.timeout_cycles) return Activity::disk_wait;
        end(now, true);
        return Activity::busy;
    }
    last_byte_ = now;
    return send();
}

// Sends two bytes; the fourth transfer completes a word.
Activity DiskController::send() {
    const MemorySegment& segment = (*jobs_.front().segments)[segment_];
    if (sent_bytes_ % 8 == 6) {
        if (!words_.can_push()) return Activity::output_full;
        words_.push(
            {segment.address + static_cast<WordAddress>(word_), segment.words[word_], sent_bytes_ + 2 == all_bytes_});
        if (++word_ == segment.words.size()) {
            word_ = 0;
            ++segment_;
        }
    }
    sent_bytes_ += 2;
    wait_ = settings_.cycles_per_transfer;
    return Activity::busy;
}

std::string DiskController::state_text() const {
    if (!active_) return "no load";
    return "sent " + std::to_string(sent_bytes_) + " of " + std::to_string(all_bytes_) +
           " bytes, read from the platter " + std::to_string(platter_bytes_);
}

}  // namespace rs::engine::model
