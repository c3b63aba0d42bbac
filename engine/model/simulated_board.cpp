#include "engine/model/board.hpp"

#include "engine/model/layout/object_image.hpp"

#include <utility>

namespace rs::engine::model {
namespace {

class SimulatedBoard final : public Executor {
public:
    SimulatedBoard(const BoardConfig& config, bool instant_loads)
        : traits_(board_traits(config)), limits_(config.limits), board_(config), instant_loads_(instant_loads) {}

    [[nodiscard]] const ExecutorTraits& traits() const override { return traits_; }

    [[nodiscard]] Status supports(const RaySpaceObject& object) const override {
        return layout_.drawable(object, limits_);
    }

    [[nodiscard]] Status can_render(const ViewRegisters& registers) const override {
        RS_TRY(board_view(registers, 0));
        if (registers.width > limits_.image_buffer_side_px || registers.height > limits_.image_buffer_side_px) {
            return Error{"the view is larger than the board's image buffer, " +
                         std::to_string(limits_.image_buffer_side_px) +
                         " px a side; render a smaller image, or from farther away"};
        }
        return {};
    }

    [[nodiscard]] RaySpaceObject as_rendered(RaySpaceObject object) const override {
        return layout_.as_rendered(std::move(object));
    }

    Result<std::optional<int>> load(const RaySpaceObject& object) override {
        const Result<int> slot = instant_loads_ ? board_.place(object) : board_.start_load(object);
        if (!slot) return std::optional<int>();  // supports() was checked before: only lack of memory or slots can fail
        if (instant_loads_) return std::optional<int>(*slot);
        RS_TRY(board_.finish_loads());
        return std::optional<int>(*slot);
    }

    Status evict(int slot) override { return board_.evict(slot); }

    Result<std::vector<ExecutedView>> render(const std::vector<SlotView>& views) override {
        std::vector<BoardView> cycle;
        for (const SlotView& view : views) {
            RS_ASSIGN_OR_RETURN(const BoardView registers, board_.view(view.slot, view.registers));
            cycle.push_back(registers);
        }
        RS_ASSIGN_OR_RETURN(BoardRun run, board_.render({cycle}));
        std::vector<ExecutedView> drawn;
        for (Image<Rgba8>& image : run.cycles.front().images) drawn.push_back({std::move(image), {}});
        return drawn;
    }

private:
    const ExecutorTraits traits_;
    const BoardLimits limits_;  // read from any thread
    const ObjectLayout& layout_ = layout_of(limits_.kind);
    Board board_;
    bool instant_loads_;
};

}  // namespace

ExecutorTraits board_traits(const BoardConfig& config) {
    return {.name = "board:" + config.name,
            .depth = false,
            .tilted = false,
            .filters = false,
            .views_per_cycle = config.limits.views_per_cycle};
}

std::unique_ptr<Executor> make_simulated_board(const BoardConfig& config, bool instant_loads) {
    return std::make_unique<SimulatedBoard>(config, instant_loads);
}

}  // namespace rs::engine::model
