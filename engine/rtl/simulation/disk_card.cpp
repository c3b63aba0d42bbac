#include "engine/rtl/simulation/disk_card.hpp"

namespace rs::engine::rtl {
namespace {

constexpr int kValidRegister = 12;

}  // namespace

void Drive::begin(std::uint64_t now, std::uint64_t bytes) {
    all_ = bytes;
    read_ = sent_ = 0;
    next_ = now + settings_.start_cycles + static_cast<std::uint64_t>(settings_.media_cycles_per_sector);
    has_stalled_ = false;
}

void Drive::clock(std::uint64_t now) {
    constexpr std::uint64_t kSector_bytes = 512;
    const std::uint64_t room = static_cast<std::uint64_t>(settings_.buffer_sectors) * kSector_bytes;
    if (now < next_ || read_ >= all_ || read_ - sent_ + kSector_bytes > room) return;
    read_ += kSector_bytes;
    next_ = now + static_cast<std::uint64_t>(settings_.media_cycles_per_sector);
    if (has_stalled_ || settings_.stall_after_bytes == 0 || read_ < settings_.stall_after_bytes) return;
    next_ += settings_.stall_cycles;
    has_stalled_ = true;
}

model::MemoryWrite word_at(const model::LoadJob& job, std::uint64_t at) {
    std::uint64_t word = at / 8;
    for (const model::MemorySegment& segment : *job.segments) {
        if (word < segment.words.size()) {
            const bool is_last = &segment == &job.segments->back() && word + 1 == segment.words.size();
            return {segment.address + static_cast<model::WordAddress>(word), segment.words[word], is_last};
        }
        word -= segment.words.size();
    }
    return {};
}

std::uint64_t bytes_of(const model::LoadJob& job) {
    std::uint64_t bytes = 0;
    for (const model::MemorySegment& segment : *job.segments) bytes += 8 * segment.words.size();
    return bytes;
}

void DiskCard::write_registers(int slot, const model::ObjectRegisters& r) {
    const auto low = [](int value) { return static_cast<std::uint32_t>(value); };
    const std::uint32_t values[] = {low(r.planes) << 20U | low(r.height) << 10U | low(r.width),
                                    low(r.u_cells) << 16U | low(r.x_cells),
                                    low(r.x_half_q20),
                                    low(r.u_half_q28),
                                    low(r.x_cells_per_unit_q12),
                                    low(r.u_cells_per_unit_q12),
                                    low(r.alpha_pitch) << 16U | low(r.chroma_pitch) << 8U | low(r.luma_pitch),
                                    r.luma,
                                    r.chroma,
                                    r.alpha,
                                    r.map,
                                    r.lines};
    int number = 0;
    for (const std::uint32_t value : values) writes_.push_back({slot, number++, value});
}

void DiskCard::place(int slot, const model::ObjectRegisters& registers) {
    write_registers(slot, registers);
    writes_.push_back({slot, kValidRegister, 1});
}

void DiskCard::evict(int slot) {
    writes_.push_back({slot, kValidRegister, 0});
}

DiskCard::Inputs DiskCard::inputs() {
    Inputs inputs;
    inputs.timeout_cycles = static_cast<std::uint32_t>(settings_.timeout_cycles);
    inputs.writes_register = !writes_.empty();
    if (!writes_.empty()) {
        inputs.write = writes_.front();
        writes_.pop_front();
    }
    if (jobs_.empty()) return inputs;
    inputs.load_available = true;
    inputs.load_object = jobs_.front().slot;
    if (!is_loading_) return inputs;
    drive_.clock(now_);
    inputs.has_data = drive_.has_data();
    const model::MemoryWrite word = word_at(jobs_.front(), drive_.sent_bytes());
    inputs.data = static_cast<std::uint16_t>(word.data >> (8 * (drive_.sent_bytes() % 8)));
    inputs.address = word.address;
    inputs.is_last = word.last;
    return inputs;
}

void DiskCard::clock(const Outputs& outputs) {
    if (outputs.takes) drive_.take();
    if (outputs.begins && !jobs_.empty()) {
        drive_.begin(now_, bytes_of(jobs_.front()));
        write_registers(jobs_.front().slot, jobs_.front().registers);
        is_loading_ = true;
        ++begun_;
    }
    if (outputs.ends && !jobs_.empty()) {
        is_loading_ = false;
        jobs_.pop_front();
        ++ended_;
    }
    failed_ += static_cast<int>(outputs.fails);
    ++now_;
}

}  // namespace rs::engine::rtl
