#include "engine/rtl/board/rtl_board.hpp"

#include "engine/model/layout/object_slots.hpp"
#include "engine/rtl/simulation/board_simulation.hpp"

#include <Vboard_top.h>
#include <verilated_vcd_c.h>

#include <algorithm>
#include <utility>

namespace rs::engine::rtl {
namespace {

class VerilatedBoard final : public RtlBoard {
public:
    explicit VerilatedBoard(const model::BoardConfig& config)
        : config_(config), slots_(config), module_(std::make_unique<Vboard_top>(&context_)), rtl_(*module_, config) {
        objects_.resize(static_cast<std::size_t>(config.limits.objects));
    }

    Result<int> place(const RaySpaceObject& object) override {
        RS_ASSIGN_OR_RETURN(const model::ObjectSlots::Taken taken, slots_.take(object));
        for (const model::MemorySegment& segment : taken.image.segments) rtl_.chips().sdram().set_words(segment);
        rtl_.card().place(taken.slot, taken.image.registers);
        objects_[static_cast<std::size_t>(taken.slot)] = taken.image.registers;
        return taken.slot;
    }
    Result<int> start_load(const RaySpaceObject& object) override {
        RS_ASSIGN_OR_RETURN(model::ObjectSlots::Taken taken, slots_.take(object));
        rtl_.card().load({taken.slot, taken.image.registers,
                          std::make_shared<const std::vector<model::MemorySegment>>(std::move(taken.image.segments))});
        objects_[static_cast<std::size_t>(taken.slot)] = taken.image.registers;
        return taken.slot;
    }
    Status finish_loads() override {
        if (!rtl_.card().has_loads()) return {};
        while (!rtl_.card().is_idle()) rtl_.step();
        rtl_.step();  // the last object becomes valid
        if (rtl_.card().failed() == 0) return {};
        return Error{"the board's disk delivered no data before the timeout; begin again with an empty board"};
    }
    Result<std::vector<model::RenderedCycle>> render(const std::vector<std::vector<model::BoardView>>& cycles) override;
    Status trace(const std::filesystem::path& path, std::uint64_t max_cycles) override;
    [[nodiscard]] std::uint64_t board_cycles() const override { return rtl_.board_cycles(); }

private:
    Status step();
    void collect(const std::vector<model::BoardView>& views, model::RenderedCycle& cycle);

    const model::BoardConfig config_;
    model::ObjectSlots slots_;
    std::vector<model::ObjectRegisters> objects_;  // [slot]
    VerilatedContext context_;
    std::unique_ptr<VerilatedVcdC> waveform_;
    std::unique_ptr<Vboard_top> module_;
    BoardSimulation<Vboard_top> rtl_;
    std::uint64_t progress_ = 0;  // sum of counters that a working board increases
    std::uint64_t last_progress_cycle_ = 0;
};

Status VerilatedBoard::step() {
    rtl_.step();
    if (!rtl_.chips().error().empty()) return Error{"RTL: " + rtl_.chips().error() + "; this is a defect of the RTL"};
    if (rtl_.status().refused > 0) return Error{"the RTL refused a rendering cycle: bad registers"};
    const std::uint64_t progress = rtl_.chips().sdram().commands(model::SdramCommand::read) +
                                   rtl_.chips().sdram().commands(model::SdramCommand::write) +
                                   rtl_.host().register_writes() + rtl_.status().begun;
    if (progress != progress_) {
        progress_ = progress;
        last_progress_cycle_ = rtl_.board_cycles();
    } else if (rtl_.board_cycles() - last_progress_cycle_ > config_.no_progress_cycles) {
        return Error{"the RTL made no progress for " + std::to_string(config_.no_progress_cycles) +
                     " cycles; this is a defect of the RTL; record it with --trace"};
    }
    return {};
}

void VerilatedBoard::collect(const std::vector<model::BoardView>& views, model::RenderedCycle& cycle) {
    std::deque<model::HostImage>& images = rtl_.host().images();
    const model::BoardConfig::Periods periods = config_.clock_periods();
    for (const model::BoardView& view : views) {
        RS_CHECK(images.front().words.size() == static_cast<std::size_t>(view.words()));
        cycle.images.push_back(model::unpack_host_image(images.front(), view));
        cycle.arrived = (images.front().arrived + 1) * static_cast<std::uint64_t>(periods.bus) /
                        static_cast<std::uint64_t>(periods.board);
        images.pop_front();
    }
}

Result<std::vector<model::RenderedCycle>> VerilatedBoard::render(
    const std::vector<std::vector<model::BoardView>>& cycles) {
    std::vector<model::RenderedCycle> rendered(cycles.size());
    const auto begun_before = rtl_.status().begun;
    std::size_t submitted = 0, begun = 0, ended = 0, collected = 0;
    const auto queue_cycles = static_cast<std::size_t>(config_.queue_cycles);
    last_progress_cycle_ = rtl_.board_cycles();
    while (collected < cycles.size()) {
        while (submitted < cycles.size() && submitted - ended < queue_cycles) {
            rtl_.host().submit(program_writes({cycles[submitted++]}, objects_));
        }
        RS_TRY(step());
        const std::uint64_t now = rtl_.board_cycles() - 1;
        // A rendering cycle begins and ends in different clock cycles.
        if (rtl_.status().ended - begun_before > ended) rendered[ended++].rendered = now;
        if (rtl_.status().begun - begun_before > begun) rendered[begun++].started = now;
        const std::deque<model::HostImage>& images = rtl_.host().images();
        if (images.size() < cycles[collected].size()) continue;
        const model::HostImage& last = images[cycles[collected].size() - 1];
        if (last.words.size() < last.expected_words) continue;
        collect(cycles[collected], rendered[collected]);
        ++collected;
    }
    return rendered;
}

Status VerilatedBoard::trace(const std::filesystem::path& path, std::uint64_t max_cycles) {
    constexpr int kAllLevels = 99;
    constexpr int kNanoseconds = -9;
    context_.timeunit(kNanoseconds);
    context_.timeprecision(kNanoseconds);
    context_.traceEverOn(true);
    waveform_ = std::make_unique<VerilatedVcdC>();
    module_->trace(waveform_.get(), kAllLevels);
    waveform_->open(path.c_str());
    if (!waveform_->isOpen()) return Error{path.string() + ": cannot be written; choose another folder"};
    const std::uint64_t last = rtl_.board_cycles() + max_cycles;
    rtl_.observe([this, last](std::uint64_t time_ns) {
        if (rtl_.board_cycles() <= last) {
            waveform_->dump(time_ns);
        } else if (waveform_->isOpen()) {
            waveform_->close();
        }
    });
    return {};
}

// True if the RTL was verilated with the constants of `config`.
bool has_constants_of(model::BoardConfig config, const model::BoardConfig& verilated) {
    config.name = verilated.name;
    config.pci.retry_every = verilated.pci.retry_every;
    const int transfer = config.disk.cycles_per_transfer;
    config.disk = verilated.disk;
    config.disk.cycles_per_transfer = transfer;
    config.no_progress_cycles = verilated.no_progress_cycles;
    return model::board_config_json(config) == model::board_config_json(verilated);
}

}  // namespace

Result<std::unique_ptr<RtlBoard>> make_rtl_board(const model::BoardConfig& config) {
    RS_ASSIGN_OR_RETURN(const model::BoardConfig verilated, model::read_board_config("prototype-2000"));
    if (!has_constants_of(config, verilated)) {
        return Error{config.name + ": the RTL was verilated for prototype-2000; give prototype-2000, or simulate " +
                     config.name + " with the model, without --rtl"};
    }
    return std::unique_ptr<RtlBoard>(std::make_unique<VerilatedBoard>(config));
}

}  // namespace rs::engine::rtl
