#include "engine/rtl/simulation/host_side.hpp"

namespace rs::engine::rtl {
namespace {

constexpr unsigned kOfView = 15;  // instead of the number of a plane
constexpr unsigned kStart = 0xFFF;
constexpr unsigned kGrantState = 1;  // of host_bus.sv

class ProgramWriter {
public:
    void place(std::size_t view, unsigned plane) {
        // Views behind the last one that the board has are written to no register; their number is refused.
        address_ = static_cast<unsigned>(view & 15U) << 8U | plane << 4U;
    }
    void put(std::int64_t value) {
        writes.push_back({static_cast<std::uint16_t>(address_++), static_cast<std::uint32_t>(value)});
    }
    void put_wide(std::int64_t value) {
        put(value);
        put(value >> 32U);
    }
    std::vector<RegisterWrite> writes;

private:
    unsigned address_ = 0;
};

}  // namespace

std::vector<RegisterWrite> program_writes(const model::ViewBank& bank,
                                          const std::vector<model::ObjectRegisters>& objects) {
    ProgramWriter writer;
    for (std::size_t v = 0; v < bank.views.size(); ++v) {
        const model::BoardView& view = bank.views[v];
        writer.place(v, kOfView);
        writer.put(view.object);
        writer.put((view.width & 0xFFFF) | std::int64_t{view.height} << 16U);
        writer.put(view.b_q20);
        writer.put_wide(view.s0_q32);
        writer.put_wide(view.sy_q32);
        const bool exists = view.object >= 0 && view.object < static_cast<int>(objects.size());
        const int planes = exists ? objects[static_cast<std::size_t>(view.object)].planes : 0;
        for (int k = 0; k < planes; ++k) {
            const model::PlaneView& plane = view.planes[static_cast<std::size_t>(k)];
            writer.place(v, static_cast<unsigned>(k));
            for (const std::int64_t value : {plane.n0_q32, plane.nx_q32, plane.t0_q32, plane.tx_q32}) {
                writer.put_wide(value);
            }
            writer.put(plane.a_q20);
            writer.put(plane.c_q20);
        }
    }
    writer.writes.push_back({kStart, static_cast<std::uint32_t>(bank.views.size())});
    return std::move(writer.writes);
}

void HostSide::clock(const Outputs& outputs) {
    if (outputs.state == kGrantState && last_state_ != kGrantState) ++bursts_;
    last_state_ = outputs.state;
    if (outputs.writes_register && has_program()) {
        ++register_writes_;
        if (++next_write_ == programs_.front().size()) {
            next_write_ = 0;
            programs_.pop_front();
        }
    }
    if (outputs.head) {
        images_.push_back({.arrived = clocks_, .words = {}, .expected_words = outputs.data});
        is_high_half_ = false;
    }
    if (outputs.transfer && !images_.empty()) {
        if (is_high_half_) {
            images_.back().words.push_back(low_half_ | std::uint64_t{outputs.data} << 32U);
            images_.back().arrived = clocks_;
        }
        low_half_ = outputs.data;
        is_high_half_ = !is_high_half_;
    }
    ++clocks_;
}

}  // namespace rs::engine::rtl
