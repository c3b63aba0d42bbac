// The whole pipe in RTL beside a board of the model that renders views, delivers them and loads another object. In
// every cycle its commands to the SDRAM, the words that it writes, and its ends of the FIFOs must be those of the
// model.

#include "tests/engine/model/board_test_objects.hpp"
#include "tests/engine/rtl/lockstep.hpp"
#include "tests/engine/rtl/sdram_pins.hpp"

#include <Vpipe.h>
#include <Vpipe_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class PipeBench final : public LockstepBench<Module> {
public:
    PipeBench(Module& module, model::Board& board, Random& random)
        : LockstepBench<Module>(module, board, random),
          body_(dynamic_cast<model::SingleBoard<model::SampleReading>&>(*board.top().body)),
          pins_(module, body_.sdram, random) {
        this->input(body_.fifos.jobs, RS_RTL_PORTS(module, jobs));
        this->output(body_.fifos.view_written, RS_RTL_PORTS(module, view_written));
        this->input(body_.host_reads, RS_RTL_PORTS(module, host_reads));
        this->output(body_.host_words, RS_RTL_PORTS(module, host_words));
        this->input(board.top().load_words, RS_RTL_PORTS(module, load_words));
        this->output(board.top().object_loaded, RS_RTL_PORTS(module, object_loaded));
    }

private:
    static const model::PlaneView& plane(const model::BoardView& view, int number) {
        return view.planes[static_cast<std::size_t>(std::min(number, model::kMaxPlanes - 1))];
    }
    void drive() override { module_.host_words_room = static_cast<CData>(body_.host_words.room()); }
    std::string compare() override { return pins_.clock(); }
    void look_up() override {
        look_up_columns();
        look_up_photos();
    }
    void look_up_columns() {
        const model::BoardView& scanned = view(module_.raster_view);
        const model::PlaneView& raster = plane(scanned, module_.raster_plane);
        module_.raster_view_width = static_cast<SData>(scanned.width);
        module_.raster_object_planes = static_cast<CData>(object(module_.raster_view).planes);
        module_.raster_plane_c_q20 = static_cast<IData>(raster.c_q20) & static_cast<IData>(mask(29));
        module_.raster_plane_n0_q32 = static_cast<QData>(raster.n0_q32) & mask(36);
        module_.raster_plane_nx_q32 = static_cast<QData>(raster.nx_q32) & mask(36);
        module_.raster_plane_t0_q32 = static_cast<QData>(raster.t0_q32) & mask(36);
        module_.raster_plane_tx_q32 = static_cast<QData>(raster.tx_q32) & mask(36);

        const model::PlaneView& position = plane(view(module_.position_view), module_.position_plane);
        const model::ObjectRegisters& met = object(module_.position_view);
        module_.position_object_x_cells = static_cast<SData>(met.x_cells);
        module_.position_object_u_cells = static_cast<SData>(met.u_cells);
        module_.position_object_x_half_q20 = static_cast<IData>(met.x_half_q20);
        module_.position_object_u_half_q28 = static_cast<IData>(met.u_half_q28);
        module_.position_object_x_cells_per_unit_q12 = static_cast<IData>(met.x_cells_per_unit_q12);
        module_.position_object_u_cells_per_unit_q12 = static_cast<IData>(met.u_cells_per_unit_q12);
        module_.position_object_map = met.map;
        module_.position_plane_a_q20 = static_cast<IData>(position.a_q20) & static_cast<IData>(mask(29));
        module_.position_plane_c_q20 = static_cast<IData>(position.c_q20) & static_cast<IData>(mask(29));
    }
    void look_up_photos() {
        module_.line_object_planes = static_cast<CData>(object(module_.line_view).planes);
        module_.line_object_lines = object(module_.line_view).lines;

        const model::BoardView& compensated = view(module_.compensation_view);
        module_.compensation_view_b_q20 = static_cast<IData>(compensated.b_q20) & static_cast<IData>(mask(29));
        module_.compensation_view_s0_q28 = static_cast<IData>(compensated.s0_q32 >> 4);
        module_.compensation_view_sy_q32 = static_cast<QData>(compensated.sy_q32) & mask(34);
        module_.compensation_object_width = static_cast<SData>(object(module_.compensation_view).width);

        const model::ObjectRegisters& addressed = object(module_.address_view);
        module_.address_object_width = static_cast<SData>(addressed.width);
        module_.address_object_luma_pitch = static_cast<CData>(addressed.luma_pitch);
        module_.address_object_chroma_pitch = static_cast<CData>(addressed.chroma_pitch);
        module_.address_object_alpha_pitch = static_cast<CData>(addressed.alpha_pitch);
        module_.address_object_luma = addressed.luma;
        module_.address_object_chroma = addressed.chroma;
        module_.address_object_alpha = addressed.alpha;

        module_.scan_view_height = static_cast<SData>(view(module_.scan_view).height);
        module_.scan_object_height = static_cast<SData>(object(module_.scan_view).height);
        module_.writer_view_width = static_cast<SData>(view(module_.writer_view).width);
        module_.writer_view_height = static_cast<SData>(view(module_.writer_view).height);
        module_.active_buffer = static_cast<CData>(board_.top().registers.active);
    }

    using LockstepBench<Module>::module_;
    using LockstepBench<Module>::board_;
    using LockstepBench<Module>::view;
    using LockstepBench<Module>::object;
    model::SingleBoard<model::SampleReading>& body_;
    SdramPins<Module> pins_;
};

// Two rendering cycles of random views, beside which another object is loaded. Returns the first difference, or "".
template <class Module>
LockstepRun render_in_lockstep(Module& module, std::size_t views_per_cycle, std::uint64_t seed) {
    const RaySpaceObject object = rs::test::ring_object({.views = 12, .planes = 12});
    model::Board board(model::test::prototype());
    const Result<int> slot = board.place(object);
    EXPECT_TRUE(slot.ok());
    EXPECT_TRUE(board.start_load(rs::test::ring_object({.views = 4, .width = 16, .height = 16, .planes = 3})).ok());
    std::mt19937_64 random_views(7 + seed);
    for (int cycle = 0; cycle < 2; ++cycle) {
        std::vector<model::BoardView> views;
        while (views.size() < views_per_cycle) {
            const auto prepared = prepare_view(object, model::test::random_upright(random_views, 64));
            views.push_back(*board.view(*slot, *prepared));
        }
        board.submit(views);
    }
    Random random(5 + seed);
    const std::string difference = PipeBench<Module>(module, board, random).run(2 * views_per_cycle);
    return {difference, board.top().simulator.board_cycles()};
}

TEST(RtlPipe, EqualsTheBoard) {
    expect_equal_in_lockstep<Vpipe>(
        [](Vpipe& module, std::uint64_t seed) { return render_in_lockstep(module, 7, seed); });
}

TEST(RtlPipe, MutantsDifferFromTheBoard) {
    expect_mutants_differ_in_lockstep<Vpipe_mutants>(
        [](Vpipe_mutants& module) { return render_in_lockstep(module, 2, 0); });
}

}  // namespace
}  // namespace rs::engine::rtl
