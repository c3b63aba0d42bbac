// The published figures of the board prototype-2000 from its verilated RTL and from its model, and how fast both
// simulate, on one thread. Ends with an error where their cycles or images differ.
//
//     bench_rtl

#include "engine/model/report/report.hpp"
#include "engine/rtl/board/rtl_board.hpp"
#include "rayspace/tool/tool_main.hpp"
#include "tests/bench/stopwatch.hpp"
#include "tests/engine/model/board_test_objects.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <string>
#include <vector>

namespace rs::bench {
namespace {

namespace model = engine::model;

struct Figure {
    const char* published;
    int side_px, views, cycles;
    bool at_the_host;  // cycles per second that arrive there, instead of drawn ones
};

struct Measured {
    std::vector<model::RenderedCycle> cycles;
    double board_mcycles_per_s = 0;
};

std::vector<std::vector<model::BoardView>> views_of(const model::test::Scene& scene, int slot) {
    std::vector<std::vector<model::BoardView>> cycles;
    for (const auto& registers : scene.cycles) {
        auto& cycle = cycles.emplace_back();
        for (const engine::ViewRegisters& view : registers) cycle.push_back(*model::board_view(view, slot));
    }
    return cycles;
}

Result<Measured> run_model(const model::test::Scene& scene) {
    model::Board board(model::test::prototype());
    RS_ASSIGN_OR_RETURN(const int slot, board.place(scene.object));
    const Stopwatch watch;
    RS_ASSIGN_OR_RETURN(model::BoardRun run, board.render(views_of(scene, slot)));
    return Measured{std::move(run.cycles), double(run.end.board_cycles) / watch.cpu_s() / 1e6};
}

Result<Measured> run_rtl(const model::test::Scene& scene) {
    RS_ASSIGN_OR_RETURN(const auto board, engine::rtl::make_rtl_board(model::test::prototype()));
    RS_ASSIGN_OR_RETURN(const int slot, board->place(scene.object));
    const Stopwatch watch;
    RS_ASSIGN_OR_RETURN(std::vector<model::RenderedCycle> cycles, board->render(views_of(scene, slot)));
    return Measured{std::move(cycles), double(board->board_cycles()) / watch.cpu_s() / 1e6};
}

Status check_equal(const Measured& rtl, const Measured& modelled) {
    for (std::size_t c = 0; c < rtl.cycles.size(); ++c) {
        const model::RenderedCycle& a = rtl.cycles[c];
        const model::RenderedCycle& b = modelled.cycles[c];
        if (a.images != b.images) return Error{"the images of the RTL differ from the model's"};
        if (a.started != b.started || a.rendered != b.rendered || a.arrived != b.arrived) {
            return Error{"the cycles of the RTL differ from the model's"};
        }
    }
    return {};
}

Status run() {
    constexpr Figure kFigures[] = {{"11 Mpixel/s, 512x512 at more than 40 /s", 512, 1, 1, false},
                                   {"15 of 256x256 at about 11 /s", 256, 15, 1, false},
                                   {"9 of 256x256 arrive at about 15 /s", 256, 9, 4, true}};
    std::printf("%-42s %9s %9s   %s\n", "published", "Mpixel/s", "cycles/s",
                "million board cycles/s: RTL, model, ratio");
    for (const Figure& figure : kFigures) {
        const model::test::Scene scene = model::test::filled(figure.side_px, figure.views, figure.cycles);
        RS_ASSIGN_OR_RETURN(const Measured rtl, run_rtl(scene));
        RS_ASSIGN_OR_RETURN(const Measured modelled, run_model(scene));
        RS_TRY(check_equal(rtl, modelled));
        const model::RenderRates rates = model::render_rates(rtl.cycles, model::test::prototype().clock_mhz);
        std::printf("%-42s %9.2f %9.2f   %.3f %.3f %.1f\n", figure.published, rates.pixels_per_second / 1e6,
                    figure.at_the_host ? rates.arrivals_per_second : rates.cycles_per_second, rtl.board_mcycles_per_s,
                    modelled.board_mcycles_per_s, modelled.board_mcycles_per_s / rtl.board_mcycles_per_s);
    }
    return {};
}

}  // namespace
}  // namespace rs::bench

int main(int argc, char** argv) {
    CLI::App app("Compares the board's RTL with its model: published figures and simulation speed.", "bench_rtl");
    std::function<rs::Status()> run = rs::bench::run;
    return rs::tool_main(app, argc, argv, run);
}
