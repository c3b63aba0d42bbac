// The whole pipe in RTL beside a board of the model that renders views, delivers them and loads another object. In
// every cycle its commands to the SDRAM, the words that it writes, and its ends of the FIFOs must be those of the
// model.

#include "tests/engine/model/board_test_objects.hpp"
#include "tests/engine/rtl/random_registers.hpp"
#include "tests/engine/rtl/sdram_pins.hpp"

#include <Vpipe.h>
#include <Vpipe_mutants.h>

namespace rs::engine::rtl {
namespace {

constexpr std::uint64_t mask(int width_bits) {
    return (std::uint64_t{1} << width_bits) - 1;
}

/// Ports of the module at a FIFO of the model that the module reads or writes.
class PipeEnd {
public:
    virtual ~PipeEnd() = default;
    virtual void drive(Random& random) = 0;
    virtual void sample() = 0;                                 // before the model's cycle, with stable outputs
    [[nodiscard]] virtual std::string difference() const = 0;  // after it
};

template <class T, class Data>
class PipeInput final : public PipeEnd {
public:
    PipeInput(model::Fifo<T>& fifo, CData& valid, const CData& ready, Data& data)
        : fifo_(fifo), valid_(valid), ready_(ready), data_(data) {}
    void drive(Random& random) override {
        valid_ = fifo_.can_pop();
        write_port(data_, valid_ != 0 ? pack(fifo_.front()) : random_bits(random), fifo_.width_bits());
        popped_ = total_popped();
    }
    void sample() override { pops_ = valid_ != 0 && ready_ != 0; }
    [[nodiscard]] std::string difference() const override {
        return (total_popped() != popped_) == pops_ ? "" : fifo_.name() + ": only one of RTL and model pops";
    }

private:
    [[nodiscard]] std::uint64_t total_popped() const {
        return fifo_.total_pushed() - static_cast<std::uint64_t>(fifo_.count());
    }
    model::Fifo<T>& fifo_;
    CData& valid_;
    const CData& ready_;
    Data& data_;
    std::uint64_t popped_ = 0;
    bool pops_ = false;
};

template <class T, class Data>
class PipeOutput final : public PipeEnd {
public:
    PipeOutput(model::Fifo<T>& fifo, const CData& valid, CData& ready, const Data& data)
        : fifo_(fifo), valid_(valid), ready_(ready), data_(data) {}
    void drive(Random& /*random*/) override {
        ready_ = fifo_.can_push();
        pushed_ = fifo_.total_pushed();
    }
    void sample() override {
        pushes_ = valid_ != 0 && ready_ != 0;
        text_ = std::to_string(data_);  // as text(MemoryWord) and text(Done)
    }
    [[nodiscard]] std::string difference() const override {
        if ((fifo_.total_pushed() != pushed_) != pushes_) return fifo_.name() + ": only one of RTL and model pushes";
        if (pushes_ && fifo_.item_text(fifo_.count() - 1) != text_) return fifo_.name() + ": the message differs";
        return {};
    }

private:
    model::Fifo<T>& fifo_;
    const CData& valid_;
    CData& ready_;
    const Data& data_;
    std::uint64_t pushed_ = 0;
    bool pushes_ = false;
    std::string text_;
};

template <class Module>
class PipeBench {
public:
    PipeBench(Module& module, model::Board& board, Random& random)
        : module_(module),
          board_(board),
          body_(dynamic_cast<model::SingleBoard<model::SampleReading>&>(*board.top().body)),
          random_(random),
          pins_(module, body_.sdram, random) {
        input(body_.fifos.jobs, RS_RTL_PORTS(module, jobs));
        output(body_.fifos.view_written, RS_RTL_PORTS(module, view_written));
        input(body_.host_reads, RS_RTL_PORTS(module, host_reads));
        output(body_.host_words, RS_RTL_PORTS(module, host_words));
        input(board.top().load_words, RS_RTL_PORTS(module, load_words));
        output(board.top().object_loaded, RS_RTL_PORTS(module, object_loaded));
        module.rst = 1;
        for (int n = 0; n < 3; ++n) clock_edge();
        module.rst = 0;
    }

    /// Runs until `views` views are delivered, and loads are finished. Returns the first difference, or "".
    std::string run(std::size_t views) {
        constexpr int kMostCycles = 400'000;
        for (int cycle = 0; cycle < kMostCycles; ++cycle) {
            const std::string difference = step();
            if (!difference.empty()) return "cycle " + std::to_string(cycle) + ": " + difference;
            const auto& images = board_.top().host_bus.images();
            const bool is_done = images.size() == views && images.back().words.size() == images.back().expected_words;
            if (is_done && board_.top().disk_controller.is_idle()) return {};
        }
        return "the views are not delivered";
    }

private:
    template <class T, class Data>
    void input(model::Fifo<T>& fifo, CData& valid, const CData& ready, Data& data) {
        ends_.push_back(std::make_unique<PipeInput<T, Data>>(fifo, valid, ready, data));
    }
    template <class T, class Data>
    void output(model::Fifo<T>& fifo, const CData& valid, CData& ready, const Data& data) {
        ends_.push_back(std::make_unique<PipeOutput<T, Data>>(fifo, valid, ready, data));
    }
    void clock_edge() {
        module_.clk = 0;
        module_.eval();
        module_.clk = 1;
        module_.eval();
        module_.clk = 0;
    }
    std::string step() {
        for (const auto& end : ends_) end->drive(random_);
        module_.host_words_room = static_cast<CData>(body_.host_words.room());
        module_.eval();
        look_up_columns();
        look_up_photos();
        std::string difference = pins_.clock();
        module_.eval();
        for (const auto& end : ends_) end->sample();
        board_.top().simulator.step();
        for (const auto& end : ends_) difference += end->difference();
        clock_edge();
        return difference;
    }

    [[nodiscard]] int valid(int view) const {
        const model::RegisterFile& registers = board_.top().registers;
        const auto views = static_cast<int>(registers.banks[static_cast<std::size_t>(registers.active)].views.size());
        return view < views ? view : 0;
    }
    // An empty bank is read only while no block has a view.
    [[nodiscard]] const model::BoardView& view(int number) const {
        static const model::BoardView kNone;
        const model::RegisterFile& registers = board_.top().registers;
        const auto& views = registers.banks[static_cast<std::size_t>(registers.active)].views;
        return views.empty() ? kNone : views[static_cast<std::size_t>(valid(number))];
    }
    [[nodiscard]] const model::ObjectRegisters& object(int number) const {
        return board_.top().registers.objects[static_cast<std::size_t>(view(number).object)];
    }
    static const model::PlaneView& plane(const model::BoardView& view, int number) {
        return view.planes[static_cast<std::size_t>(std::min(number, model::kMaxPlanes - 1))];
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

    Module& module_;
    model::Board& board_;
    model::SingleBoard<model::SampleReading>& body_;
    Random& random_;
    SdramPins<Module> pins_;
    std::vector<std::unique_ptr<PipeEnd>> ends_;
};

// Two rendering cycles of random views, beside which another object is loaded. Returns the first difference, or "".
template <class Module, class Select>
std::string render_in_lockstep(std::size_t views_per_cycle, Select&& select) {
    const RaySpaceObject object = rs::test::ring_object({.views = 12, .planes = 12});
    model::Board board(model::test::prototype());
    const Result<int> slot = board.place(object);
    EXPECT_TRUE(slot.ok());
    EXPECT_TRUE(board.start_load(rs::test::ring_object({.views = 4, .width = 16, .height = 16, .planes = 3})).ok());
    std::mt19937_64 random_views(7);
    for (int cycle = 0; cycle < 2; ++cycle) {
        std::vector<model::BoardView> views;
        while (views.size() < views_per_cycle) {
            const auto prepared = prepare_view(object, model::test::random_upright(random_views, 64));
            views.push_back(*board.view(*slot, *prepared));
        }
        board.submit(views);
    }
    Random random(5);
    VerilatedContext context;
    context.randReset(2);
    Module module(&context);
    select(module);
    return PipeBench<Module>(module, board, random).run(2 * views_per_cycle);
}

TEST(RtlPipe, EqualsTheBoard) {
    EXPECT_EQ(render_in_lockstep<Vpipe>(7, [](Vpipe&) {}), "");
}

TEST(RtlPipe, MutantsDifferFromTheBoard) {
    int mutants = 0;
    EXPECT_EQ(render_in_lockstep<Vpipe_mutants>(2,
                                                [&](Vpipe_mutants& module) {
                                                    module.mutant = 0;
                                                    module.eval();
                                                    mutants = module.mutants;
                                                }),
              "");
    EXPECT_GE(mutants, kLeastMutants);
    for (int n = 1; n <= mutants; ++n) {
        const auto select = [&](Vpipe_mutants& module) { module.mutant = static_cast<CData>(n); };
        EXPECT_NE(render_in_lockstep<Vpipe_mutants>(2, select), "") << "mutant " << n << " is not noticed";
    }
}

}  // namespace
}  // namespace rs::engine::rtl
