// Rays of the pixels of a pipe in RTL beside a board of the model that renders views of objects with shape maps:
// columns, cells, hits, texels and patches must be those of the model in every cycle.

#include "tests/engine/model/parallel_test_objects.hpp"
#include "tests/engine/rtl/lockstep.hpp"

#include <Vmarch_pipe_2.h>
#include <Vmarch_pipe_2_mutants.h>

namespace rs::engine::rtl {
namespace {

constexpr int kPipesOfBoard = 2;  // the module is the first one

template <class Module>
class MarchPipeBench final : public LockstepBench<Module> {
public:
    MarchPipeBench(Module& module, model::Board& board, Random& random)
        : LockstepBench<Module>(module, board, random), pipe_(*model::test::pipes(board).front()) {
        model::ParallelFifos& fifos = pipe_.fifos;
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
    static std::uint64_t bits(std::int64_t value, int width) { return static_cast<std::uint64_t>(value) & mask(width); }

    // Effective depths of all objects, which the host writes before the first view.
    void drive() override {
        const auto& objects = this->board_.top().registers.objects;
        const auto object = static_cast<std::size_t>(written_ / EffectiveDepth::kDepths);
        const auto depth = static_cast<std::size_t>(written_ % EffectiveDepth::kDepths);
        Module& m = this->module_;
        m.effective_depths_valid = object < objects.size() && objects[object].valid;
        if (m.effective_depths_valid == 0) return;
        m.effective_depths_data =
            static_cast<IData>(bits(objects[object].shape.effective_depth_q3[depth], 13) | bits(written_, 13) << 13U);
    }
    std::string compare() override {
        if (this->module_.effective_depths_valid != 0 && this->module_.effective_depths_ready != 0) ++written_;
        return {};
    }
    void look_up() override {
        Module& m = this->module_;
        const model::BoardView& scan = this->view(m.scan_view);
        m.scan_view_width = static_cast<SData>(scan.width);
        m.scan_view_height = static_cast<SData>(scan.height);
        m.scan_view_s0_q32 = bits(scan.s0_q32, 36);
        m.scan_view_sy_q32 = bits(scan.sy_q32, 34);
        const model::ShapeRegisters& rise = this->object(m.rise_view).shape;
        m.rise_view_b_q20 = static_cast<IData>(bits(this->view(m.rise_view).b_q20, 29));
        m.rise_shape_h_low_q20 = static_cast<IData>(bits(rise.h_low_q20, 29));
        m.rise_shape_reference_height_q20 = static_cast<IData>(bits(rise.reference_height_q20, 29));
        m.rise_shape_bands_per_unit_q12 = static_cast<IData>(rise.bands_per_unit_q12);
        m.rise_shape_depth_step_q24 = static_cast<IData>(rise.depth_step_q24);
        const model::ShapeRegisters& loading = this->object(m.loading_view).shape;
        m.loading_shape_bands = static_cast<SData>(loading.bands);
        m.loading_shape_jump = static_cast<CData>(loading.jump);
        const model::ShapeRegisters& march = this->object(m.march_view).shape;
        m.march_view_object = static_cast<CData>(this->view(m.march_view).object);
        m.march_shape_bands = static_cast<SData>(march.bands);
        m.march_shape_jump = static_cast<CData>(march.jump);
        m.march_shape_thickness = static_cast<CData>(march.thickness);
        m.march_shape_foot_d_q3 = static_cast<SData>(march.foot_d_q3);
        const model::RegisterFile& registers = this->board_.top().registers;
        m.store_view_height = static_cast<SData>(this->view(m.store_view).height);
        m.store_view_image = registers.image(registers.active, m.store_view);
    }

    model::ParallelPipe& pipe_;
    int written_ = 0;  // effective depths, object by object
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
