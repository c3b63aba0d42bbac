#pragma once
// The verilated board beside the board of the model. Both get the same objects, loads and views; in every cycle of the
// board's clock their commands to the SDRAM, their bus, their disk, their status and the fill of every FIFO must be the
// same. The RTL's surroundings are its own: its SDRAM has only the words that it wrote or loaded itself.

#include "engine/model/board.hpp"
#include "engine/rtl/simulation/board_simulation.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <verilated_sym_props.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace rs::engine::rtl {

/// Counter `name` of a FIFO of board_top, or nullptr if the module was verilated without board_top.vlt.
inline const CData* find_counter(VerilatedContext& context, const std::string& fifo, const char* name) {
    for (const char* parent : {"TOP.board_top.", "TOP.board_top.pipe_block."}) {
        const VerilatedScope* scope = context.scopeFind((parent + fifo + "_fifo").c_str());
        if (scope == nullptr) continue;
        if (const VerilatedVar* counter = scope->varFind(name)) return static_cast<const CData*>(counter->datap());
    }
    return nullptr;
}

template <class Module>
class BoardLockstep {
public:
    BoardLockstep(Module& module, const model::BoardConfig& config)
        : model_(config), slots_(config), rtl_(module, config) {
        find_fifos(*module.contextp());
    }

    Result<int> place(const RaySpaceObject& object) {
        RS_ASSIGN_OR_RETURN(const int slot, model_.place(object));
        RS_ASSIGN_OR_RETURN(const model::ObjectSlots::Taken taken, slots_.take(object));
        for (const model::MemorySegment& segment : taken.image.segments) rtl_.chips().sdram().set_words(segment);
        rtl_.card().place(taken.slot, taken.image.registers);
        return slot;
    }
    Result<int> start_load(const RaySpaceObject& object) {
        RS_ASSIGN_OR_RETURN(const int slot, model_.start_load(object));
        RS_ASSIGN_OR_RETURN(model::ObjectSlots::Taken taken, slots_.take(object));
        rtl_.card().load({taken.slot, taken.image.registers,
                          std::make_shared<const std::vector<model::MemorySegment>>(std::move(taken.image.segments))});
        return slot;
    }
    Status evict(int slot) {
        RS_TRY(model_.evict(slot));
        slots_.release(slot);
        rtl_.card().evict(slot);
        return {};
    }
    void submit(const std::vector<model::BoardView>& views) {
        rtl_.host().submit(program_writes({views}, model_.top().registers.objects));
        model_.submit(views);
    }

    /// Runs until every submitted program is finished or refused, and all loads are. Returns the first difference, or
    /// "".
    std::string run(std::uint64_t most_cycles = 4'000'000) {
        for (std::uint64_t n = 0; n < most_cycles; ++n) {
            const std::string difference = step();
            if (!difference.empty()) return "cycle " + std::to_string(rtl_.board_cycles() - 1) + ": " + difference;
            if (is_done()) return compare_images();
        }
        return "the board is not done";
    }
    std::string step() {
        const auto model_commands = issued(model_.top().sdram());
        const std::string bus_state = model_.top().host_bus.state_text();
        const std::uint64_t clocks = model_.top().simulator.pci_cycles();
        model_.top().simulator.step();
        rtl_.step();
        if (!rtl_.chips().error().empty()) return rtl_.chips().error();
        if (issued(rtl_.chips().sdram()) != model_commands) return "another SDRAM command";
        if (rtl_.host().clocks() != model_.top().simulator.pci_cycles()) return "another number of bus clocks";
        std::string difference = compare_fifos() + compare_status();
        if (rtl_.host().clocks() != clocks) difference += compare_bus(bus_state);
        return difference;
    }

    /// Images that the RTL has delivered since the last call.
    std::deque<model::HostImage> take_images() {
        model_.top().host_bus.images().clear();
        return std::exchange(rtl_.host().images(), {});
    }

    [[nodiscard]] std::size_t compared_fifos() const { return fifos_.size() + crossings_.size(); }
    [[nodiscard]] std::uint64_t board_cycles() const { return rtl_.board_cycles(); }
    [[nodiscard]] model::Board& board() { return model_; }
    [[nodiscard]] BoardSimulation<Module>& rtl() { return rtl_; }

private:
    static std::array<std::uint64_t, 6> issued(const model::Sdram& sdram) {
        std::array<std::uint64_t, 6> counts{};
        for (std::size_t n = 0; n < counts.size(); ++n) counts[n] = sdram.commands(static_cast<model::SdramCommand>(n));
        return counts;
    }
    std::string compare_fifos() {
        std::string difference;
        for (const auto& [fifo, count] : fifos_) {
            if (*count != fifo->count()) difference += text(*fifo, *count);
        }
        for (const auto& [fifo, pushes, pops] : crossings_) {
            const int turns = 2 * fifo->depth() - 1;  // its pointers count to twice its depth
            const int count = (*pushes - *pops) & turns;
            if (count != fifo->count()) difference += text(*fifo, count);
        }
        return difference;
    }
    template <class Fifo>
    static std::string text(const Fifo& fifo, int count) {
        return fifo.name() + " has " + std::to_string(count) + " messages, in the model " +
               std::to_string(fifo.count()) + ". ";
    }
    void find_fifos(VerilatedContext& context) {
        if (find_counter(context, "jobs", "count") == nullptr) return;
        for (const model::Domain domain : {model::Domain::board, model::Domain::pci}) {
            const auto& parts = model_.top().simulator.parts(domain);
            for (const model::FifoState* fifo : parts.fifos) {
                fifos_.push_back({fifo, find_counter(context, fifo->name(), "count")});
                RS_CHECK(fifos_.back().count != nullptr);
            }
            for (const model::CrossingState* fifo : parts.written) {
                crossings_.push_back(
                    {fifo, find_counter(context, fifo->name(), "pushes"), find_counter(context, fifo->name(), "pops")});
                RS_CHECK(crossings_.back().pushes != nullptr && crossings_.back().pops != nullptr);
            }
        }
    }
    std::string compare_status() {
        const auto& status = rtl_.status();
        const model::RenderControl& control = model_.top().render_control;
        if (status.refused != control.refusals().size()) return "another program is refused";
        if (status.accepted + status.refused != control.commands_taken()) return "another program is accepted";
        if (status.begun != control.cycles_begun()) return "another rendering cycle begins";
        const bool is_drawing = !control.cycles().empty() && control.cycles().back().rendered == 0;
        if (status.ended + static_cast<std::uint64_t>(is_drawing) != control.cycles_begun()) {
            return "another rendering cycle ends";
        }
        const auto& loads = model_.top().disk_controller.loads();
        if (static_cast<std::size_t>(rtl_.card().begun()) != loads.size()) return "another load begins";
        int ended = 0;
        int failed = 0;
        for (const auto& load : loads) {
            ended += load.finished > 0;
            failed += load.failed;
        }
        if (rtl_.card().ended() != ended || rtl_.card().failed() != failed) return "another load ends";
        return {};
    }
    // `state`: of the model's bus before its clock.
    std::string compare_bus(const std::string& state) {
        constexpr const char* kStates[] = {"idle", "grant",      "address",        "target",
                                           "data", "turnaround", "register write", "interrupt"};
        const HostSide& host = rtl_.host();
        const model::HostBus& bus = model_.top().host_bus;
        if (state.rfind(std::string(kStates[host.last_state()]) + ",", 0) != 0) {
            return std::string("the bus is in the state ") + kStates[host.last_state()] + ", in the model: " + state;
        }
        // The model counts a register write in its first clock.
        const bool is_writing = bus.state_text().rfind("register write", 0) == 0;
        if (host.register_writes() + static_cast<std::uint64_t>(is_writing) != bus.counters().register_writes) {
            return "another number of register writes";
        }
        if (host.images().size() != bus.images().size()) return "another image begins";
        if (host.images().empty()) return {};
        const model::HostImage& found = host.images().back();
        const model::HostImage& expected = bus.images().back();
        if (found.expected_words != expected.expected_words) {
            return "an image of " + std::to_string(found.expected_words) + " words, in the model " +
                   std::to_string(expected.expected_words);
        }
        if (found.words.size() != expected.words.size()) return "another number of words has arrived";
        if (!found.words.empty() && found.words.back() != expected.words.back()) return "another word arrives";
        return {};
    }
    [[nodiscard]] bool is_done() {
        const model::BoardTop& top = model_.top();
        return top.render_control.commands_taken() == top.programs.size() && top.disk_controller.is_idle() &&
               top.render_control.last_activity() == model::Activity::idle &&
               top.host_dma.last_activity() == model::Activity::idle && top.images_ready.count() == 0 &&
               top.object_ready.count() == 0 && rtl_.card().is_idle();
    }
    std::string compare_images() {
        const auto& expected = model_.top().host_bus.images();
        for (std::size_t n = 0; n < expected.size(); ++n) {
            const model::HostImage& found = rtl_.host().images()[n];
            if (found.words != expected[n].words) return "image " + std::to_string(n) + " differs";
            if (found.arrived != expected[n].arrived) return "image " + std::to_string(n) + " arrives at another time";
        }
        return {};
    }

    model::Board model_;
    model::ObjectSlots slots_;
    BoardSimulation<Module> rtl_;
    struct ComparedFifo {
        const model::FifoState* fifo = nullptr;
        const CData* count = nullptr;
    };
    struct ComparedCrossing {
        const model::CrossingState* fifo = nullptr;
        const CData* pushes = nullptr;
        const CData* pops = nullptr;
    };
    std::vector<ComparedFifo> fifos_;  // all of the model, or none
    std::vector<ComparedCrossing> crossings_;
};

}  // namespace rs::engine::rtl
