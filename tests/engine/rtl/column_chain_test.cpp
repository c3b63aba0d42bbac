// The column side of a pipe of `parallel` in RTL beside a board of the model that renders views of objects with and
// without a shape map: columns, and all requests and words of the memory must be those of the model in every cycle.

#include "tests/engine/model/parallel_test_objects.hpp"
#include "tests/engine/rtl/lockstep.hpp"

#include <Vcolumn_chain_2.h>
#include <Vcolumn_chain_2_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class ColumnChainBench final : public LockstepBench<Module> {
public:
    ColumnChainBench(Module& module, model::Board& board, Random& random)
        : LockstepBench<Module>(module, board, random), fifos_(model::test::pipes(board).front()->fifos) {
        this->input(fifos_.jobs, RS_RTL_PORTS(module, jobs));
        this->input(fifos_.stripe_free, RS_RTL_PORTS(module, stripe_free));
        this->output(fifos_.map_reads, RS_RTL_PORTS(module, map_reads));
        this->input(fifos_.map_words, RS_RTL_PORTS(module, map_words));
        this->output(fifos_.bracket_reads, RS_RTL_PORTS(module, bracket_reads));
        this->input(fifos_.bracket_words, RS_RTL_PORTS(module, bracket_words));
        this->output(fifos_.line_reads, RS_RTL_PORTS(module, line_reads));
        this->input(fifos_.line_words, RS_RTL_PORTS(module, line_words));
        this->output(fifos_.band_reads, RS_RTL_PORTS(module, band_reads));
        this->output(fifos_.rise_columns, RS_RTL_PORTS(module, rise_columns));
        this->output(fifos_.march_columns, RS_RTL_PORTS(module, march_columns));
        this->output(fifos_.place_columns, RS_RTL_PORTS(module, place_columns));
    }

private:
    [[nodiscard]] const model::PlaneView& plane(int view, unsigned number) const {
        return this->view(view).planes[std::min<std::size_t>(number, model::kMaxPlanes - 1)];
    }
    void look_up() override {
        look_up_rays();
        look_up_images();
        look_up_cells();
    }
    void look_up_rays() {
        Module& m = this->module_;
        const model::PlaneView& raster = plane(m.raster_view, m.raster_plane);
        m.raster_view_width = static_cast<SData>(this->view(m.raster_view).width);
        m.raster_object_planes = static_cast<CData>(this->object(m.raster_view).planes);
        m.raster_plane_c_q20 = static_cast<IData>(raster.c_q20) & kMask29;
        m.raster_plane_n0_q32 = static_cast<QData>(raster.n0_q32) & mask(36);
        m.raster_plane_nx_q32 = static_cast<QData>(raster.nx_q32) & mask(36);
        m.raster_plane_t0_q32 = static_cast<QData>(raster.t0_q32) & mask(36);
        m.raster_plane_tx_q32 = static_cast<QData>(raster.tx_q32) & mask(36);
        const model::ObjectRegisters& object = this->object(m.position_view);
        const model::PlaneView& position = plane(m.position_view, m.position_plane);
        m.position_object_x_cells = static_cast<SData>(object.x_cells);
        m.position_object_u_cells = static_cast<SData>(object.u_cells);
        m.position_object_x_half_q20 = static_cast<IData>(object.x_half_q20);
        m.position_object_u_half_q28 = static_cast<IData>(object.u_half_q28);
        m.position_object_x_cells_per_unit_q12 = static_cast<IData>(object.x_cells_per_unit_q12);
        m.position_object_u_cells_per_unit_q12 = static_cast<IData>(object.u_cells_per_unit_q12);
        m.position_object_map = object.map;
        m.position_plane_a_q20 = static_cast<IData>(position.a_q20) & kMask29;
        m.position_plane_c_q20 = static_cast<IData>(position.c_q20) & kMask29;
    }
    void look_up_images() {
        Module& m = this->module_;
        const model::ObjectRegisters& bracket = this->object(m.bracket_view);
        m.bracket_object_has_shape = bracket.shape.exists;
        m.bracket_object_images = static_cast<CData>(bracket.images);
        m.bracket_object_planes = static_cast<CData>(bracket.planes);
        m.bracket_object_lines = bracket.lines;
        const model::ObjectRegisters& picture = this->object(m.picture_view);
        m.picture_object_planes = static_cast<CData>(picture.planes);
        m.picture_object_lines = picture.lines;
    }
    void look_up_cells() {
        Module& m = this->module_;
        const model::BoardView& view = this->view(m.setup_view);
        const model::PlaneView& setup = plane(m.setup_view, m.setup_plane);
        const model::ShapeRegisters& shape = this->object(m.setup_view).shape;
        m.setup_view_b_q20 = static_cast<IData>(view.b_q20) & kMask29;
        m.setup_view_s0_q28 = static_cast<IData>(view.s0_q32 >> 4);
        m.setup_view_sy_q32 = static_cast<QData>(view.sy_q32) & mask(34);
        m.setup_plane_a_q20 = static_cast<IData>(setup.a_q20) & kMask29;
        m.setup_plane_c_q20 = static_cast<IData>(setup.c_q20) & kMask29;
        m.setup_object_width = static_cast<SData>(this->object(m.setup_view).width);
        m.setup_shape_p_cells = static_cast<SData>(shape.p_cells);
        m.setup_shape_lines = static_cast<IData>(shape.lines);
        m.setup_shape_p_half_q20 = static_cast<IData>(shape.p_half_q20);
        m.setup_shape_p_cells_per_unit_q12 = static_cast<IData>(shape.p_cells_per_unit_q12);
        m.setup_shape_reference_distance_q20 = static_cast<IData>(shape.reference_distance_q20);
        m.setup_shape_depth_low_q20 = static_cast<IData>(shape.depth_low_q20);
        m.setup_shape_depth_step_q24 = static_cast<IData>(shape.depth_step_q24);
        const model::ShapeRegisters& band = this->object(m.band_view).shape;
        m.band_view_width = static_cast<SData>(this->view(m.band_view).width);
        m.band_shape_p_cells = static_cast<SData>(band.p_cells);
        m.band_shape_bands = static_cast<SData>(band.bands);
        m.band_shape_cells = band.cells;
    }

    static constexpr auto kMask29 = static_cast<IData>(mask(29));
    model::ParallelFifos& fifos_;
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
