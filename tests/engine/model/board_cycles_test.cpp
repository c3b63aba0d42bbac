// Cycles of whole images: independence of the tick order, memory reads by a formula, golden counts, and the published
// figures.

#include "engine/core/definition/ray_setup.hpp"
#include "engine/model/report/report.hpp"
#include "tests/engine/model/board_comparison.hpp"
#include "tests/engine/model/board_test_objects.hpp"

namespace rs::engine::model {
namespace {

using test::filled;
using test::Scene;

Result<BoardRun> drawn(Board& board, const Scene& scene) {
    const Result<int> slot = board.place(scene.object);
    if (!slot) return slot.error();
    std::vector<std::vector<BoardView>> cycles;
    for (const auto& views : scene.cycles) {
        cycles.emplace_back();
        for (const engine::ViewRegisters& view : views) cycles.back().push_back(*board.view(*slot, view));
    }
    return board.render(cycles);
}

// Renders the scene while the disk loads another object.
Result<BoardRun> drawn_while_loading(Board& board, const Scene& scene) {
    const Result<int> other = board.start_load(rs::test::ring_object({.views = 8, .seed = 3}));
    if (!other) return other.error();
    return drawn(board, scene);
}

TEST(BoardCycles, TickOrderChangesNeitherCyclesNorBits) {
    const Scene scene = filled(40, 4, 3);
    Board reference(test::prototype());
    const Result<BoardRun> expected = drawn_while_loading(reference, scene);
    ASSERT_TRUE(expected.ok());
    for (const std::uint64_t seed : {1, 2, 3}) {
        Board board(test::prototype(), seed);
        const Result<BoardRun> run = drawn_while_loading(board, scene);
        ASSERT_TRUE(run.ok());
        test::expect_same_run(*run, *expected, board);
    }
}

// Per view column with a ray of the plane: a map word; with an image: four words of records. Per pair of pixels with
// rows of the images: alpha once, or twice across words; chroma and Y per pixel. Half a word of output per pixel.
TEST(BoardCycles, MemoryReadsAreThoseOfTheFormula) {
    const Scene scene = filled(45, 3, 1);
    Board board(test::prototype());
    const Result<BoardRun> run = drawn(board, scene);
    ASSERT_TRUE(run.ok());
    std::uint64_t lines = 0;
    std::uint64_t samples = 0;
    std::uint64_t nulls = 0;
    std::uint64_t words = 0;
    for (const engine::ViewRegisters& view : scene.cycles.front()) {
        for (int i = 0; i < view.width; ++i) {
            const RaySetup ray = set_up_ray(scene.object, view, i, 0);
            lines += ray.image >= 0 ? 4 : 0;
            words += static_cast<std::uint64_t>((view.height + 1) / 2);
            for (int j = 0; j < view.height; j += 2) {
                const auto is_visible = [&](int at) {
                    return ray.image >= 0 && at < view.height && ray.row(at) >= 0 && ray.row(at) < scene.object.height;
                };
                const bool both = is_visible(j) && is_visible(j + 1);
                const std::uint64_t alpha = both && ray.row(j) / 32 != ray.row(j + 1) / 32 ? 2 : 1;
                const std::uint64_t pixels =
                    static_cast<std::uint64_t>(is_visible(j)) + static_cast<std::uint64_t>(is_visible(j + 1));
                samples += (pixels > 0 ? alpha : 0) + 2 * pixels;
                nulls += (pixels > 0 ? 0 : 1) + 2 * (2 - pixels);
            }
        }
    }
    const BoardReport report = make_report(board, *run);
    EXPECT_EQ(report.memory[0].words, words);  // host
    EXPECT_GE(report.memory[1].words * 4, lines);
    EXPECT_LE(report.memory[1].words, 3U * 45U);
    EXPECT_EQ(report.memory[2].words, lines);
    EXPECT_EQ(report.memory[3].words, samples);
    EXPECT_EQ(report.memory[3].nulls, nulls);
    EXPECT_EQ(report.memory[4].words, words);  // image
    EXPECT_EQ(report.bus.image_bytes, words * 8);
    EXPECT_GT(nulls, 0U);
}

// Golden counts from a run whose parts were verified; any change of timing changes them.
TEST(BoardCyclesGolden, FullImages) {
    const auto cycles_of = [](int side, int views) {
        Board board(test::prototype());
        const Result<BoardRun> run = drawn(board, filled(side, views, 1));
        return run ? run->cycles[0].render_cycles() : 0;
    };
    EXPECT_EQ(cycles_of(64, 1), 15'240U);
    EXPECT_EQ(cycles_of(128, 2), 118'427U);
}

// The published table. None of its figures is an input; DIAGRAM.md derives them by hand.
TEST(PublishedFigures, OneImageOf512) {
    Board board(test::prototype());
    const Result<BoardRun> run = drawn(board, filled(512, 1, 1));
    ASSERT_TRUE(run.ok());
    const BoardReport report = make_report(board, *run);
    EXPECT_GE(report.pixels_per_second, 10.0e6);
    EXPECT_LE(report.pixels_per_second, 12.5e6);
    EXPECT_GT(report.cycles_per_second, 40.0);
    EXPECT_EQ(report.rendering.limiting_block, "memory_controller");
}

TEST(PublishedFigures, FifteenImagesOf256) {
    Board board(test::prototype());
    const Result<BoardRun> run = drawn(board, filled(256, 15, 1));
    ASSERT_TRUE(run.ok());
    const BoardReport report = make_report(board, *run);
    EXPECT_GE(report.cycles_per_second, 10.0);
    EXPECT_LE(report.cycles_per_second, 12.5);
    EXPECT_EQ(report.rendering.limiting_block, "memory_controller");
}

TEST(PublishedFigures, NineShowroomImagesAreLimitedByTheHostBus) {
    Board board(test::prototype());
    const Result<BoardRun> run = drawn(board, filled(256, 9, 4));
    ASSERT_TRUE(run.ok());
    const BoardReport report = make_report(board, *run);
    EXPECT_NEAR(report.arrivals_per_second, 15.0, 1.0);
    EXPECT_EQ(report.delivering.limiting_block, "host_bus");
    // The paper states that 44 MByte/s cannot be reached over PCI.
    EXPECT_LT(double(report.bus.image_bytes) / report.delivering.seconds, 44e6);
}

// The remedies that the paper names for its bus, with the rates of `rs-engine board --buses` and of drawing, which
// takes 53 ms a cycle: the slower of the two limits.
TEST(PublishedFigures, RemediesOfTheBusLeaveDrawingAsTheLimit) {
    constexpr double kDrawn_per_s = 18.7;             // nine images, nothing delivered meanwhile
    constexpr double kDrawn_while_delivering = 15.5;  // both share the memory's port
    const Scene scene = filled(256, 9, 3);
    for (const std::string& name : bus_remedy_configs()) {
        const BoardConfig config = *read_board_config(name);
        Board board(config);
        const Result<BoardRun> run = drawn(board, scene);
        ASSERT_TRUE(run.ok()) << name;
        const BoardReport report = make_report(board, *run);
        EXPECT_GT(1 / bus_rates(config, 9, 256).cycle_seconds, kDrawn_per_s) << name;
        EXPECT_GT(report.arrivals_per_second, kDrawn_while_delivering) << name;
        EXPECT_LT(report.arrivals_per_second, kDrawn_per_s + 0.3) << name;
        EXPECT_EQ(report.rendering.limiting_block, "memory_controller") << name;
        for (std::size_t n = 0; n < 9; ++n) {
            EXPECT_EQ(run->cycles[0].images[n], test::defined(with_board_alpha(scene.object), scene.cycles[0][n]))
                << name;
        }
    }
}

TEST(PublishedFigures, RatesOfTheBusFollowFromItsBursts) {
    const BusRates pci = bus_rates(test::prototype(), 9, 256);
    EXPECT_NEAR(1 / pci.cycle_seconds, 15.6, 0.05);
    EXPECT_NEAR(pci.image_bytes_per_second, 36.8e6, 0.05e6);
    const BusRates pci_x = bus_rates(*read_board_config("prototype-2000-pci-x"), 9, 256);
    EXPECT_NEAR(pci_x.image_bytes_per_second, 588.5e6, 0.05e6);
    EXPECT_GT(pci_x.image_bytes_per_second, 400e6);  // 100 Mpixel/s, the aim of the paper's section 7
}

// A board of twice the clock is limited by the same bus, and delivers at the same rate.
TEST(BoardCycles, TheBusHasItsOwnClock) {
    const Scene scene = filled(64, 9, 4);
    const auto rate_at = [&](int clock_mhz) {
        BoardConfig config = test::prototype();
        config.clock_mhz = clock_mhz;
        Board board(config);
        const Result<BoardRun> run = drawn(board, scene);
        EXPECT_TRUE(run.ok());
        return run ? make_report(board, *run).arrivals_per_second : 0;
    };
    const double published = rate_at(40);
    EXPECT_NEAR(rate_at(80) / published, 1, 0.1);
    EXPECT_LT(rate_at(20) / published, 0.7);  // limited by drawing, with a bus that is faster than the board
}

TEST(PublishedFigures, LoadingRunsAtTwentyMegabytesAndDisturbsNothing) {
    const Scene scene = filled(64, 4, 2);
    Board quiet(test::prototype());
    const Result<BoardRun> alone = drawn(quiet, scene);
    ASSERT_TRUE(alone.ok());
    Board loading(test::prototype());
    const RaySpaceObject second = rs::test::ring_object({.views = 30, .width = 96, .height = 96, .seed = 9});
    const Result<int> slot = loading.place(scene.object);
    ASSERT_TRUE(slot.ok());
    const Result<int> other = loading.start_load(second);
    ASSERT_TRUE(other.ok());
    std::vector<std::vector<BoardView>> cycles;
    for (const auto& views : scene.cycles) {
        cycles.emplace_back();
        for (const engine::ViewRegisters& view : views) cycles.back().push_back(*loading.view(*slot, view));
    }
    const Result<BoardRun> both = loading.render(cycles);
    ASSERT_TRUE(both.ok());
    EXPECT_GT(loading.top().memory().counters().load_words, 1000U);
    for (std::size_t c = 0; c < cycles.size(); ++c) {
        EXPECT_EQ(both->cycles[c].started, alone->cycles[c].started);
        EXPECT_EQ(both->cycles[c].rendered, alone->cycles[c].rendered);
        EXPECT_EQ(both->cycles[c].arrived, alone->cycles[c].arrived);
        EXPECT_EQ(both->cycles[c].images, alone->cycles[c].images);
    }
    ASSERT_TRUE(loading.finish_loads().ok());
    const DiskController::Load& load = loading.top().disk_controller.loads().front();
    EXPECT_NEAR(double(load.bytes) / (double(load.finished - load.started) / 40e6), 20e6, 0.4e6);
    // The loaded object is rendered correctly.
    const auto prepared = prepare_view(second, test::upright_at(1, 3, 0, 1, 50, 50));
    const Result<BoardRun> run = loading.render({{*loading.view(*other, *prepared)}});
    ASSERT_TRUE(run.ok());
    EXPECT_EQ(run->cycles[0].images[0], test::defined(with_board_alpha(second), *prepared));
}

}  // namespace
}  // namespace rs::engine::model
