#include "engine/model/board.hpp"

#include <algorithm>

namespace rs::engine::model {
namespace {

constexpr std::uint64_t kMaxRunCycles = std::uint64_t{1} << 40;

}  // namespace

// Pixel (i, j) is half (j & 1) of word i * ceil(height / 2) + (j >> 1).
Image<Rgba8> unpack_host_image(const HostImage& words, const BoardView& view) {
    Image<Rgba8> image(view.width, view.height);
    const auto pitch = static_cast<std::size_t>(view.words_per_column());
    for (int j = 0; j < view.height; ++j) {
        for (int i = 0; i < view.width; ++i) {
            const std::uint64_t word =
                words.words[static_cast<std::size_t>(i) * pitch + static_cast<std::size_t>(j / 2)];
            const auto pixel = static_cast<std::uint32_t>(word >> (32 * (j % 2)));
            const auto byte = [&](unsigned n) { return static_cast<std::uint8_t>(pixel >> (8 * n)); };
            image(i, j) = {byte(0), byte(1), byte(2), byte(3)};
        }
    }
    return image;
}

Board::Board(const BoardConfig& config, std::uint64_t shuffle_seed)
    : top_(std::make_unique<BoardTop>(config, shuffle_seed)), slots_(config) {}

Result<int> Board::place(const RaySpaceObject& object) {
    RS_ASSIGN_OR_RETURN(ObjectSlots::Taken taken, slots_.take(object));
    for (int channel = 0; channel < top_->channels(); ++channel) {
        for (const MemorySegment& segment : taken.image.segments) top_->sdram(channel).set_words(segment);
    }
    taken.image.registers.valid = true;
    top_->registers.objects[static_cast<std::size_t>(taken.slot)] = taken.image.registers;
    return taken.slot;
}

Result<int> Board::start_load(const RaySpaceObject& object) {
    RS_ASSIGN_OR_RETURN(ObjectSlots::Taken taken, slots_.take(object));
    top_->disk_controller.load({taken.slot, taken.image.registers,
                                std::make_shared<const std::vector<MemorySegment>>(std::move(taken.image.segments))});
    return taken.slot;
}

Status Board::finish_loads() {
    const auto idle = [&] { return top_->disk_controller.is_idle() && top_->object_ready.count() == 0; };
    RS_TRY(top_->simulator.run_until(idle, kMaxRunCycles));
    const std::vector<DiskController::Load>& loads = top_->disk_controller.loads();
    std::string failed;
    for (; collected_loads_ < loads.size(); ++collected_loads_) {
        const DiskController::Load& load = loads[collected_loads_];
        if (!load.failed) continue;
        slots_.release(load.slot);
        failed += (failed.empty() ? "slot " : ", ") + std::to_string(load.slot);
    }
    if (failed.empty()) return {};
    return Error{"the board's disk delivered no data before the timeout while loading " + failed +
                 "; the slot is empty again; load the object once more"};
}

Status Board::evict(int slot) {
    if (!slots_.is_taken(slot)) {
        return Error{"object slot " + std::to_string(slot) + " holds nothing to evict"};
    }
    if (top_->disk_controller.is_loading(slot)) {
        return Error{"object slot " + std::to_string(slot) + " is being loaded; wait for it before evicting"};
    }
    bool is_in_use = top_->render_control.uses_object(slot);
    for (std::uint64_t n = top_->render_control.commands_taken(); n < top_->programs.size(); ++n) {
        for (const BoardView& view : top_->programs[n].bank.views) is_in_use |= view.object == slot;
    }
    if (is_in_use) {
        return Error{"object slot " + std::to_string(slot) +
                     " is being drawn; evict it when its rendering cycles are done"};
    }
    top_->registers.objects[static_cast<std::size_t>(slot)] = {};
    slots_.release(slot);
    return {};
}

Result<BoardView> Board::view(int slot, const engine::ViewRegisters& registers) const {
    return board_view(registers, slot);
}

void Board::submit(std::vector<BoardView> views) {
    top_->programs.push_back(host_program(std::move(views), top_->registers.objects));
}

RenderedCycle Board::collect(std::uint64_t cycle) {
    const RenderControl::Cycle& done = top_->render_control.cycle(cycle);
    RenderedCycle result{done.started, done.rendered, 0, {}};
    std::deque<HostImage>& arrived = top_->host_bus.images();
    for (const BoardView& view : top_->programs[done.program].bank.views) {
        RS_CHECK(!arrived.empty() && arrived.front().words.size() == static_cast<std::size_t>(view.words()));
        result.images.push_back(unpack_host_image(arrived.front(), view));
        const BoardConfig::Periods periods = top_->config.clock_periods();
        result.arrived = (arrived.front().arrived + 1) * static_cast<std::uint64_t>(periods.bus) /
                         static_cast<std::uint64_t>(periods.board);
        arrived.pop_front();
    }
    top_->programs.drop_before(done.program + 1);
    return result;
}

Result<BoardRun> Board::render(const std::vector<std::vector<BoardView>>& cycles) {
    BoardRun run;
    run.begin = snapshot();
    const RenderControl& control = top_->render_control;
    const std::uint64_t first = control.cycles_begun();
    const std::size_t refused = top_->render_control.refusals().size();
    const auto rendered = [&] {
        const bool is_drawing = !control.cycles().empty() && control.cycles().back().rendered == 0;
        return static_cast<std::size_t>(control.cycles_begun() - first) - static_cast<std::size_t>(is_drawing);
    };
    // The images of a cycle are collected after its last image, so the last image present belongs to the cycle being
    // delivered.
    const std::deque<HostImage>& at_host = top_->host_bus.images();
    const auto arrived = [&] {
        return !at_host.empty() && at_host.back().last_view &&
               at_host.back().words.size() == at_host.back().expected_words;
    };
    std::size_t submitted = 0;
    while (run.cycles.size() < cycles.size()) {
        while (submitted < cycles.size() &&
               submitted - std::min(submitted, rendered()) < static_cast<std::size_t>(top_->config.queue_cycles)) {
            submit(cycles[submitted++]);
        }
        const std::size_t was = rendered();
        const auto event = [&] {
            return rendered() != was || top_->render_control.refusals().size() != refused || arrived();
        };
        RS_TRY(top_->simulator.run_until(event, kMaxRunCycles));
        if (top_->render_control.refusals().size() != refused) {
            return Error{"the board refused a rendering cycle: " + top_->render_control.refusals().back().reason};
        }
        if (rendered() > 0 && run.first_rendered.blocks.empty()) run.first_rendered = snapshot();
        if (rendered() == cycles.size() && run.rendered.blocks.empty()) run.rendered = snapshot();
        if (arrived()) run.cycles.push_back(collect(first + run.cycles.size()));
    }
    run.end = snapshot();
    // Lets the board process the release of its buffer.
    const auto quiet = [&] {
        return top_->host_dma.last_activity() == Activity::idle && top_->buffer_free.count() == 0;
    };
    RS_TRY(top_->simulator.run_until(quiet, kMaxRunCycles));
    return run;
}

std::vector<const Block*> Board::blocks() const {
    std::vector<const Block*> all;
    for (const Domain domain : {Domain::board, Domain::pci}) {
        const std::vector<Block*>& blocks = top_->simulator.parts(domain).blocks;
        all.insert(all.end(), blocks.begin(), blocks.end());
    }
    std::sort(all.begin(), all.end(), [](const Block* a, const Block* b) { return a->name() < b->name(); });
    return all;
}

Snapshot Board::snapshot() const {
    Snapshot shot{top_->simulator.board_cycles(), top_->simulator.pci_cycles(), {}};
    for (const Block* block : blocks()) shot.blocks.push_back(block->counts());
    return shot;
}

}  // namespace rs::engine::model
