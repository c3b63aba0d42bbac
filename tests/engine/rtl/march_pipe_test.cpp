// Rays of the pixels of a pipe in RTL beside a board of the model that renders views of objects with shape maps:
// columns, cells, hits, texels and patches must be those of the model in every cycle.

#include "tests/engine/rtl/parallel_lockstep.hpp"

#include <Vmarch_pipe_2.h>
#include <Vmarch_pipe_2_mutants.h>

namespace rs::engine::rtl {
namespace {

constexpr int kPipesOfBoard = 2;  // the module is the first one

template <class Module>
class MarchPipeBench final : public ParallelLockstepBench<Module> {
public:
    MarchPipeBench(Module& module, model::Board& board, Random& random)
        : ParallelLockstepBench<Module>(module, board, random) {
        model::ParallelFifos& fifos = this->pipe_.fifos;
        this->input(fifos.scan_jobs, RS_RTL_PORTS(module, scan_jobs));
        this->input(fifos.rise_columns, RS_RTL_PORTS(module, rise_columns));
        this->input(fifos.march_columns, RS_RTL_PORTS(module, march_columns));
        this->input(fifos.band_words, RS_RTL_PORTS(module, band_words));
        this->output(fifos.met, RS_RTL_PORTS(module, met));
        this->input(fifos.quads, RS_RTL_PORTS(module, quads));
        this->output(fifos.image_writes, RS_RTL_PORTS(module, image_writes));
        this->output(fifos.stripe_free, RS_RTL_PORTS(module, stripe_free));
        this->output(fifos.view_done_books, RS_RTL_PORTS(module, view_done_books));
    }

private:
    void drive() override { this->drive_effective_depths(); }
    std::string compare() override {
        this->count_effective_depths();
        return {};
    }
    void look_up() override { this->look_up_pixels(); }
};

// Views of an object without and two with a shape map.
template <class Module>
LockstepRun march_in_lockstep(Module& module, std::size_t views_of_each, std::uint64_t seed) {
    model::Board board(model::test::parallel(kPipesOfBoard));
    std::vector<model::BoardView> views;
    std::mt19937_64 random_views(seed);
    for (const std::uint64_t n : {1U, 2U, 0U}) {
        const RaySpaceObject object =
            model::test::any_object({.views = 12, .width = 70, .height = 60, .planes = 6, .seed = 3 * seed + n},
                                    {.coded = n == 2, .shape = n > 0});
        const Result<int> slot = board.place(object);
        EXPECT_TRUE(slot.ok());
        for (std::size_t v = 0; v < views_of_each; ++v) {
            const auto prepared =
                prepare_view(object, model::test::random_upright(random_views, 100), TexelFilter::kBilinear);
            views.push_back(*board.view(*slot, *prepared));
        }
    }
    board.submit(views);
    Random random(seed);
    const std::string difference = MarchPipeBench<Module>(module, board, random).run(views.size());
    const model::ParallelPipe& pipe = *model::test::pipes(board).front();
    if (difference.empty() && seed == 0) {
        EXPECT_GT(pipe.surface_blend.sent_back(), 50U);
    }
    return {difference, board.top().simulator.board_cycles()};
}

TEST(RtlMarchPipe, EqualsTheBoard) {
    expect_equal_in_lockstep<Vmarch_pipe_2>(
        [](Vmarch_pipe_2& module, std::uint64_t seed) { return march_in_lockstep(module, 5, seed); });
}

TEST(RtlMarchPipe, MutantsDifferFromTheBoard) {
    expect_mutants_differ_in_lockstep<Vmarch_pipe_2_mutants>(
        [](Vmarch_pipe_2_mutants& module) { return march_in_lockstep(module, 5, 0); });
}

}  // namespace
}  // namespace rs::engine::rtl
