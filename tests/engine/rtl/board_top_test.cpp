// The whole board in RTL in lockstep with the board of the model: random views of several objects, loads from the disk
// beside them, objects that are replaced, and programs that are refused.

#include "tests/engine/model/board_test_objects.hpp"
#include "tests/engine/rtl/board_lockstep.hpp"

#include <Vboard_top.h>
#include <Vboard_top_mutants.h>

namespace rs::engine::rtl {
namespace {

/// A board of the model, and the same in RTL, with `Module` as the verilated board_top.
template <class Module>
class Boards {
public:
    explicit Boards(const model::BoardConfig& config, int mutant = 0) {
        context_.randReset(2);
        context_.randSeed(seed_++);
        module_ = std::make_unique<Module>(&context_);
        if constexpr (requires { module_->mutant; }) module_->mutant = static_cast<CData>(mutant);
        lockstep_ = std::make_unique<BoardLockstep<Module>>(*module_, config);
    }
    BoardLockstep<Module>* operator->() { return lockstep_.get(); }

    /// Submits a cycle of random views of the objects in `slots`.
    void submit_views(const std::vector<std::pair<int, const RaySpaceObject*>>& slots, std::size_t views, int most_px) {
        std::vector<model::BoardView> cycle;
        while (cycle.size() < views) {
            const auto& [slot, object] = slots[cycle.size() % slots.size()];
            const auto prepared =
                prepare_view(*object, model::test::random_upright(random_, most_px), TexelFilter::kBilinear);
            cycle.push_back(*lockstep_->board().view(slot, *prepared));
        }
        lockstep_->submit(cycle);
    }

private:
    VerilatedContext context_;
    std::unique_ptr<Module> module_;
    std::unique_ptr<BoardLockstep<Module>> lockstep_;
    static inline int seed_ = 1;  // of the registers before the reset
    std::mt19937_64 random_{7};
};

const RaySpaceObject& large_object() {
    static const RaySpaceObject kObject = rs::test::ring_object({.views = 12, .planes = 12});
    return kObject;
}
const RaySpaceObject& small_object() {
    static const RaySpaceObject kObject = rs::test::ring_object({.views = 4, .width = 16, .height = 16, .planes = 3});
    return kObject;
}

/// Draws and delivers cycles of one object while the other is loaded, then cycles of both, of which the third is one
/// too many, bad registers, and a third object in the slot of the second one. Returns the first difference, or "".
template <class Module>
std::string render_in_lockstep(std::size_t views, int most_px, int mutant = 0) {
    model::BoardConfig config = model::test::prototype();
    config.pci.retry_every = 7;
    Boards<Module> boards(config, mutant);
    const Result<int> large = boards->place(large_object());
    const Result<int> loaded = boards->start_load(small_object());
    EXPECT_TRUE(large.ok() && loaded.ok());
    for (int cycle = 0; cycle < 2; ++cycle) boards.submit_views({{*large, &large_object()}}, views, most_px);
    std::string difference = boards->run();
    if (!difference.empty()) return "while loading: " + difference;

    for (int cycle = 0; cycle < 5; ++cycle) {
        boards.submit_views({{*large, &large_object()}, {*loaded, &small_object()}}, views, most_px);
    }
    std::vector<model::BoardView> invalid(1);
    invalid.front().object = *large;
    boards->submit(invalid);
    boards->submit({});
    difference = boards->run();
    if (!difference.empty()) return "with refusals: " + difference;
    if (mutant == 0) {
        EXPECT_GE(boards->rtl().status().refused, 2U);
        EXPECT_EQ(boards->rtl().card().failed(), 0);
    }

    EXPECT_TRUE(boards->evict(*loaded).ok());
    boards.submit_views({{*loaded, &small_object()}}, 1, most_px);  // refused: the slot is empty
    EXPECT_EQ(*boards->start_load(small_object()), *loaded);
    boards.submit_views({{*large, &large_object()}}, views, most_px);
    difference = boards->run();
    if (!difference.empty()) return "after the eviction: " + difference;
    boards.submit_views({{*loaded, &small_object()}}, views, most_px);
    return boards->run();
}

TEST(RtlBoard, EqualsTheBoard) {
    EXPECT_EQ(render_in_lockstep<Vboard_top>(7, 64), "");
}

TEST(RtlBoard, AFullRenderingCycleEqualsTheBoard) {
    Boards<Vboard_top> boards(model::test::prototype());
    const Result<int> slot = boards->place(large_object());
    for (int cycle = 0; cycle < 3; ++cycle) boards.submit_views({{*slot, &large_object()}}, 15, 24);
    EXPECT_EQ(boards->run(), "");
    EXPECT_EQ(boards->rtl().status().ended, 2U + (boards->rtl().status().refused == 0));
}

TEST(RtlBoard, ALoadWithoutDataFailsAsOnTheBoard) {
    model::BoardConfig config = model::test::prototype();
    config.disk.stall_after_bytes = 512;
    config.disk.stall_cycles = 9000;
    config.disk.timeout_cycles = 4000;
    Boards<Vboard_top> boards(config);
    const Result<int> slot = boards->place(small_object());
    ASSERT_TRUE(boards->start_load(large_object()).ok());
    boards.submit_views({{*slot, &small_object()}}, 2, 24);
    EXPECT_EQ(boards->run(), "");
    EXPECT_EQ(boards->rtl().card().failed(), 1);
}

TEST(RtlBoard, MutantsDifferFromTheBoard) {
    EXPECT_EQ(render_in_lockstep<Vboard_top_mutants>(2, 32), "");
    VerilatedContext context;
    Vboard_top_mutants module(&context);
    module.eval();
    EXPECT_GE(module.mutants, kLeastMutants);
    for (int n = 1; n <= module.mutants; ++n) {
        EXPECT_NE(render_in_lockstep<Vboard_top_mutants>(2, 32, n), "") << "mutant " << n << " is not noticed";
    }
}

}  // namespace
}  // namespace rs::engine::rtl
