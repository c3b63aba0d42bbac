// Cycles and memory reads of the parallel board.

#include "engine/core/definition/fixed_point.hpp"
#include "engine/core/definition/ray_setup.hpp"
#include "engine/core/definition/shape_setup.hpp"
#include "engine/model/limits/coded_layout.hpp"
#include "engine/model/limits/parallel_layout.hpp"
#include "engine/model/report/report.hpp"
#include "tests/engine/model/board_comparison.hpp"
#include "tests/engine/model/parallel_test_objects.hpp"

namespace rs::engine::model {
namespace {

constexpr int kViews = 5;

engine::ViewRegisters view_of(const RaySpaceObject& object, int v, int width, int height) {
    return *prepare_view(object, test::upright_at(0.7 * v, 3.3, 0.1, 0.95, width, height),
                         engine::TexelFilter::kBilinear);
}

Result<BoardRun> drawn_in_parallel(Board& board, const RaySpaceObject& object, int width, int height,
                                   int views = kViews) {
    const Result<int> slot = board.place(object);
    if (!slot) return slot.error();
    std::vector<BoardView> cycle;
    for (int v = 0; v < views; ++v) cycle.push_back(*board.view(*slot, view_of(object, v, width, height)));
    return board.render({cycle});
}

std::uint64_t words_of(const Board& board, const std::string& client) {
    std::uint64_t words = 0;
    for (int c = 0; c < board.top().channels(); ++c) {
        const MemoryController& memory = board.top().memory(c);
        if (client == "image_writer") words += memory.counters().image_words;
        for (std::size_t n = 0; n < memory.read_ports().size(); ++n) {
            if (memory.read_ports()[n].client == client) words += memory.counters().words_read[n];
        }
    }
    return words;
}

constexpr std::size_t kPipes = 3;

// Expected words for the set-up of a view's columns, computed from RECONSTRUCTION.md and the layout only.
struct ColumnReads {
    std::uint64_t map = 0, bracket = 0, lines = 0, bands = 0;

    void count(const RaySpaceObject& object, const engine::ViewRegisters& view) {
        const Ring& ring = object.rings.front();
        std::array<std::array<const ShapeCell*, 4>, kPipes> held{};  // cells of each pipe's previous column
        for (int i = 0; i < view.width; ++i) {
            const PlanePoint point = plane_point(ring, view, i, 0);
            if (!point.exists) continue;
            ++map;
            const std::uint16_t answer = look_up_rs_map(ring, point);
            if (answer == kNoImage) continue;
            if (ring.shape.empty()) {
                lines += 4;
                continue;
            }
            const bool found = count_bracket(ring, point, answer);
            lines += found ? 10 : 5;
            const ShapeSetup setup = set_up_shape(object, view, i, 0);
            if (!setup.has_shape()) continue;
            const std::array<const ShapeCell*, 4> cells{setup.cells.at[0][0], setup.cells.at[0][1],
                                                        setup.cells.at[1][0], setup.cells.at[1][1]};
            const auto pipe = static_cast<std::size_t>(i / kStripeColumns % kPipes);
            if (cells != held[pipe]) bands += 4 * ((static_cast<std::uint64_t>(ring.shape.bands) + 3) / 4);
            held[pipe] = cells;
        }
    }

    // One word for the lines of a gap, one for each crossing that the previous look did not read.
    bool count_bracket(const Ring& ring, const PlanePoint& point, int answer) {
        const int count = static_cast<int>(ring.views.size());
        const auto crossing = [&](int n) {
            const NormalLine& line = ring.shape.normal_lines[static_cast<std::size_t>(n * ring.planes + point.plane)];
            return line.a_q20 + ((point.u_q28 * line.c_q20) >> 28);
        };
        int gap = static_cast<int>(std::find(ring.views.begin(), ring.views.end(), answer) - ring.views.begin());
        ++bracket;
        if (crossing(gap) > point.x_q20) gap = (gap + count - 1) % count;
        for (int look = 0; look < count; ++look) {
            ++bracket;
            if (ring.shape.gaps[static_cast<std::size_t>(gap)].lines == 0) return false;
            ++bracket;  // one of the two crossings is already read
            if (point.x_q20 < crossing(gap)) {
                gap = (gap + count - 1) % count;
            } else if (point.x_q20 >= crossing((gap + 1) % count)) {
                gap = (gap + 1) % count;
            } else {
                return true;
            }
        }
        return false;
    }
};

TEST(ParallelBoardCycles, MemoryReadsAreThoseOfTheFormula) {
    constexpr int kWidth = 75;
    constexpr int kHeight = 41;
    for (int kind = 0; kind < 4; ++kind) {
        const test::AnyObject any{.coded = kind % 2 == 1, .shape = kind >= 2};
        const RaySpaceObject object = test::any_object(
            {.views = 9, .width = 60, .height = 50, .planes = 5, .x_cells = 24, .u_cells = 24, .seed = 41}, any, true);
        Board board(test::parallel(kPipes));
        ASSERT_TRUE(drawn_in_parallel(board, object, kWidth, kHeight).ok());
        ColumnReads counted;
        for (int v = 0; v < kViews; ++v) counted.count(object, view_of(object, v, kWidth, kHeight));
        EXPECT_EQ(words_of(board, "map_reader"), counted.map);
        EXPECT_EQ(words_of(board, "bracket_finder"), counted.bracket);
        EXPECT_EQ(words_of(board, "picture_reader"), counted.lines);
        EXPECT_EQ(words_of(board, "band_reader"), counted.bands);
        EXPECT_EQ(words_of(board, "image_writer"), std::uint64_t{kViews} * kWidth * ((kHeight + 1) / 2));
        EXPECT_EQ(words_of(board, "host_dma"), std::uint64_t{kViews} * kWidth * ((kHeight + 1) / 2));
        EXPECT_EQ(counted.bands > 0, any.shape);
        std::uint64_t fills = 0;
        std::uint64_t asks = 0;
        std::uint64_t texels = 0;
        for (const auto& pipe : test::pipes(board)) {
            fills += pipe->texel_tags.fills_requested();
            asks += pipe->chains.hop_fifos[0]->asks.total_pushed();
            texels += pipe->fifos.texels.total_pushed();
        }
        EXPECT_GT(fills, 50U);
        EXPECT_EQ(texels, 64 * fills);
        EXPECT_EQ(asks, any.coded ? 8 * fills : 0);
        EXPECT_EQ(words_of(board, "fill_fetch"), any.coded ? 0 : kRawBlockWords * fills);
        EXPECT_EQ(words_of(board, "double_buffered_codebook"), any.coded ? 3 * book_words(object.coded->board) : 0);
    }
}

TEST(ParallelBoardCycles, TickOrderChangesNeitherCyclesNorBits) {
    for (const bool coded : {false, true}) {
        const RaySpaceObject object = test::any_object({.views = 12, .width = 70, .height = 70, .fl_px = 90, .seed = 4},
                                                       {.coded = coded, .shape = true});
        Board reference(test::parallel(3));
        const Result<BoardRun> expected = drawn_in_parallel(reference, object, 50, 40);
        ASSERT_TRUE(expected.ok());
        for (const std::uint64_t seed : {1, 2}) {
            Board board(test::parallel(3), seed);
            const Result<BoardRun> run = drawn_in_parallel(board, object, 50, 40);
            ASSERT_TRUE(run.ok());
            test::expect_same_run(*run, *expected, board);
        }
    }
}

// 100 Mpixel/s with decompression, bands and blending. The object is two balls over the rendered images, in views that
// it fills; the first rendering cycle includes the load of the codebooks, so the second is measured.
TEST(ParallelBoardCycles, OneHundredMpixelsASecondWithinItsMemory) {
    RaySpaceObject object = test::encoded_object(20, 128).coded;
    object.rings.front().shape = rs::test::small_shape(object, 0, {.p_cells = 40, .bands = 64, .lines = {2}});
    Board board(*read_board_config("parallel"));
    const Result<int> slot = board.place(object);
    ASSERT_TRUE(slot.ok()) << slot.error().message;
    std::vector<std::vector<BoardView>> cycles(2);
    std::vector<engine::ViewRegisters> registers;
    for (int v = 0; v < 2; ++v) {
        registers.push_back(
            *prepare_view(object, test::upright_at(0.35 + v, 3.5, 0, 0.75, 512, 512), engine::TexelFilter::kBilinear));
        cycles[static_cast<std::size_t>(v)].push_back(*board.view(*slot, registers.back()));
    }
    const Result<BoardRun> run = board.render(cycles);
    ASSERT_TRUE(run.ok()) << run.error().message;
    EXPECT_EQ(run->cycles[1].images[0], test::defined(object, registers[1]));
    const double mpixels = 40.0 * 512 * 512 / double(run->cycles[1].render_cycles());
    EXPECT_GT(mpixels, 100);
    const BoardReport report = make_report(board, *run);
    ASSERT_EQ(report.channels.size(), 16U);
    for (const ChannelReport& channel : report.channels) {
        EXPECT_GT(channel.rendering.share(Activity::busy), 0.1);
        EXPECT_LT(channel.rendering.occupied(), 0.95);
    }
}

// Codebooks of the next view's object are loaded while a view is rendered.
TEST(ParallelBoardCycles, BooksOfTheNextViewAreLoadedDuringThisOne) {
    const RaySpaceObject a = test::any_object({.views = 6, .planes = 4, .x_cells = 16, .u_cells = 16, .seed = 5},
                                              {.coded = true, .shape = true});
    const RaySpaceObject b = test::any_object({.views = 6, .planes = 4, .x_cells = 16, .u_cells = 16, .seed = 6},
                                              {.coded = true, .shape = true});
    const auto cycles_of = [&](bool other, bool resident) {
        Board board(test::parallel(2));
        const int slots[] = {*board.place(a), *board.place(b)};
        const auto view = [&](int n) {
            return *board.view(slots[n], view_of(n == 0 ? a : b, 1, n == 0 ? 400 : 40, n == 0 ? 400 : 40));
        };
        if (resident) {
            EXPECT_TRUE(board.render({{view(0), view(1)}}).ok());
        }
        const Result<BoardRun> run = board.render({other ? std::vector{view(0), view(1)} : std::vector{view(0)}});
        EXPECT_TRUE(run.ok());
        std::uint64_t loads = 0;
        for (const auto& pipe : test::pipes(board)) loads += pipe->double_buffered_codebook.book_loads();
        EXPECT_EQ(loads, other || resident ? 4U : 2U);
        return run->cycles[0].render_cycles();
    };
    const std::uint64_t alone = cycles_of(false, false);
    const std::uint64_t both = cycles_of(true, false);
    EXPECT_LT(both - alone, std::uint64_t{book_words(b.coded->board)} / 2);
    EXPECT_LT(cycles_of(true, true), both);  // both sets are loaded
}

// Golden counts from a run whose parts were verified; any change of timing changes them.
TEST(ParallelBoardCyclesGolden, AllKinds) {
    const auto cycles_of = [](int kind, int pipes, int width, int height) {
        Board board(test::parallel(pipes));
        const RaySpaceObject object = test::any_object({.views = 12, .width = 70, .height = 70, .fl_px = 90, .seed = 9},
                                                       {.coded = kind % 2 == 1, .shape = kind >= 2});
        const Result<BoardRun> run = drawn_in_parallel(board, object, width, height);
        return run ? run->cycles[0].render_cycles() : 0;
    };
    EXPECT_EQ(cycles_of(0, 8, 96, 64), 11'895U);
    EXPECT_EQ(cycles_of(1, 8, 96, 64), 35'800U);
    EXPECT_EQ(cycles_of(2, 8, 96, 64), 19'905U);
    EXPECT_EQ(cycles_of(3, 8, 96, 64), 47'161U);
    EXPECT_EQ(cycles_of(3, 3, 50, 33), 48'618U);
}

}  // namespace
}  // namespace rs::engine::model
