// Conformance set on the verilated board: all views that prototype-2000 renders. Images must have the hashes of the
// set, and in every cycle the fill of every FIFO must be that of the model, so that each block of the RTL works in the
// same cycles as the model's.

#include "engine/conformance/run_vectors.hpp"
#include "engine/model/layout/object_image.hpp"
#include "tests/engine/rtl/board_lockstep.hpp"

#include <Vboard_top.h>

#include <filesystem>

namespace rs::engine::rtl {
namespace {

/// The RTL in lockstep with the model, as an executor. Loads place objects into memory.
class LockstepExecutor final : public Executor {
public:
    explicit LockstepExecutor(const model::BoardConfig& config)
        : traits_(model::board_traits(config)), module_(&context_), lockstep_(module_, config) {
        EXPECT_EQ(lockstep_.compared_fifos(), 29U);
    }

    [[nodiscard]] const ExecutorTraits& traits() const override { return traits_; }
    [[nodiscard]] Status supports(const RaySpaceObject& object) const override {
        return layout_.drawable(object, limits_);
    }
    [[nodiscard]] Status can_render(const ViewRegisters& registers) const override {
        RS_TRY(model::board_view(registers, 0));
        if (std::max(registers.width, registers.height) > limits_.image_buffer_side_px) return Error{"too large"};
        return {};
    }
    [[nodiscard]] RaySpaceObject as_rendered(RaySpaceObject object) const override {
        return layout_.as_rendered(std::move(object));
    }
    Result<std::optional<int>> load(const RaySpaceObject& object) override {
        RS_ASSIGN_OR_RETURN(const int slot, lockstep_.place(object));
        return std::optional<int>(slot);
    }
    Status evict(int slot) override { return lockstep_.evict(slot); }
    Result<std::vector<ExecutedView>> render(const std::vector<SlotView>& views) override {
        std::vector<model::BoardView> cycle;
        for (const SlotView& view : views) {
            RS_ASSIGN_OR_RETURN(const model::BoardView registers, lockstep_.board().view(view.slot, view.registers));
            cycle.push_back(registers);
        }
        lockstep_.submit(cycle);
        const std::string difference = lockstep_.run();
        EXPECT_EQ(difference, "");
        if (!difference.empty()) return Error{difference};
        const std::deque<model::HostImage> images = lockstep_.take_images();
        if (images.size() != cycle.size()) return Error{"the board refused the views"};
        std::vector<ExecutedView> executed;
        for (std::size_t n = 0; n < cycle.size(); ++n) {
            executed.push_back({model::unpack_host_image(images[n], cycle[n]), {}});
        }
        return executed;
    }
    [[nodiscard]] std::uint64_t board_cycles() const { return lockstep_.board_cycles(); }

private:
    const ExecutorTraits traits_;
    const BoardLimits limits_ = model::read_board_config("prototype-2000")->limits;
    const model::ObjectLayout& layout_ = model::layout_of(BoardKind::raw_images);
    VerilatedContext context_;
    Vboard_top module_;
    BoardLockstep<Vboard_top> lockstep_;
};

TEST(RtlConformance, ImagesAndCyclesAreThoseOfTheSetAndTheModel) {
    const auto set = read_vectors(std::filesystem::path(RAYSPACE_SOURCE_DIR) / "engine" / "conformance" / "vectors");
    ASSERT_TRUE(set.ok()) << set.error().message;
    const auto config = model::read_board_config("prototype-2000");
    const auto rtl = std::make_shared<LockstepExecutor>(*config);
    const auto matrix =
        run_vectors(*set, {implementation_of(rtl), implementation_of(model::make_simulated_board(*config, true))});
    ASSERT_TRUE(matrix.ok()) << matrix.error().message;
    EXPECT_TRUE(matrix->passed());
    int cases = 0;
    int views = 0;
    for (std::size_t c = 0; c < set->cases.size(); ++c) {
        const CaseResult& found = matrix->results[c][0];
        const CaseResult& expected = matrix->results[c][1];
        EXPECT_EQ(found.same, expected.same) << set->cases[c].name << ": " << found.first << found.declined;
        cases += found.same > 0;
        views += found.same;
    }
    EXPECT_GE(cases, 7);
    EXPECT_GE(views, 80);
    std::printf("%d views of %d cases in %llu board cycles\n", views, cases,
                static_cast<unsigned long long>(rtl->board_cycles()));
}

}  // namespace
}  // namespace rs::engine::rtl
