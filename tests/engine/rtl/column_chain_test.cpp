// The column side of a pipe of `parallel` in RTL beside a board of the model that renders views of objects with and
// without a shape map: columns, and all requests and words of the memory must be those of the model in every cycle.

#include "tests/engine/rtl/parallel_lockstep.hpp"

#include <Vcolumn_chain_2.h>
#include <Vcolumn_chain_2_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class ColumnChainBench final : public ParallelLockstepBench<Module> {
public:
    ColumnChainBench(Module& module, model::Board& board, Random& random)
        : ParallelLockstepBench<Module>(module, board, random) {
        model::ParallelFifos& fifos = this->pipe_.fifos;
        this->input(fifos.jobs, RS_RTL_PORTS(module, jobs));
        this->input(fifos.stripe_free, RS_RTL_PORTS(module, stripe_free));
        this->output(fifos.map_reads, RS_RTL_PORTS(module, map_reads));
        this->input(fifos.map_words, RS_RTL_PORTS(module, map_words));
        this->output(fifos.bracket_reads, RS_RTL_PORTS(module, bracket_reads));
        this->input(fifos.bracket_words, RS_RTL_PORTS(module, bracket_words));
        this->output(fifos.line_reads, RS_RTL_PORTS(module, line_reads));
        this->input(fifos.line_words, RS_RTL_PORTS(module, line_words));
        this->output(fifos.band_reads, RS_RTL_PORTS(module, band_reads));
        this->output(fifos.rise_columns, RS_RTL_PORTS(module, rise_columns));
        this->output(fifos.march_columns, RS_RTL_PORTS(module, march_columns));
        this->output(fifos.place_columns, RS_RTL_PORTS(module, place_columns));
    }

private:
    void look_up() override { this->look_up_columns(); }
};

// Views of three objects, one of them without a shape map.
template <class Module>
LockstepRun set_up_in_lockstep(Module& module, std::size_t views_of_each, std::uint64_t seed) {
    model::Board board(model::test::parallel(2));
    std::vector<model::BoardView> views;
    for (unsigned n = 0; n < 3; ++n) {
        std::mt19937_64 random_views(7 + n);
        const RaySpaceObject object = model::test::any_object(
            {.views = 12, .width = 90, .height = 70, .planes = 6, .seed = 3 * seed + n}, {.shape = n != 1}, true);
        const Result<int> slot = board.place(object);
        EXPECT_TRUE(slot.ok());
        for (std::size_t view = 0; view < views_of_each; ++view) {
            const auto prepared =
                prepare_view(object, model::test::random_upright(random_views, 100), TexelFilter::kBilinear);
            views.push_back(*board.view(*slot, *prepared));
        }
    }
    board.submit(views);
    Random random(seed);
    const std::string difference = ColumnChainBench<Module>(module, board, random).run(views.size());
    return {difference, board.top().simulator.board_cycles()};
}

TEST(RtlColumnChain, EqualsTheBoard) {
    expect_equal_in_lockstep<Vcolumn_chain_2>(
        [](Vcolumn_chain_2& module, std::uint64_t seed) { return set_up_in_lockstep(module, 5, seed); });
}

TEST(RtlColumnChain, MutantsDifferFromTheBoard) {
    expect_mutants_differ_in_lockstep<Vcolumn_chain_2_mutants>(
        [](Vcolumn_chain_2_mutants& module) { return set_up_in_lockstep(module, 2, 0); });
}

}  // namespace
}  // namespace rs::engine::rtl
