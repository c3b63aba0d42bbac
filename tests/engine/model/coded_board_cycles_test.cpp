// Cycles and memory reads of the board with compressed images.

#include "engine/core/definition/ray_setup.hpp"
#include "engine/model/limits/coded_layout.hpp"
#include "engine/model/report/report.hpp"
#include "tests/engine/model/board_comparison.hpp"
#include "tests/engine/model/coded_test_objects.hpp"

namespace rs::engine::model {
namespace {

// Expected reads of each hop, computed from the layout only.
struct ReadCounts {
    explicit ReadCounts(const RaySpaceObject& from) : object(from), coded(*from.coded) {}

    void column(const RaySetup& ray, int rows) {
        last_tile.fill(-1);
        unsigned run_rows = 0;
        int run_block = -1;
        int pixels = 0;
        const bool down = ray.row_step_q16 >= 0;
        const auto end_run = [&] {
            if (pixels > 0) block(0, ray.image, ray.column, run_block, run_rows, down);
            pixels = 0;
            run_rows = 0;
        };
        for (int j = 0; j < rows; ++j) {
            const std::int64_t row = ray.row(j);
            if (row < 0 || row >= object.height) {
                end_run();
                continue;
            }
            if (static_cast<int>(row / 8) != run_block || pixels == 16) end_run();
            run_block = static_cast<int>(row / 8);
            run_rows |= 1U << (row % 8);
            ++pixels;
        }
        end_run();
    }

    void block(std::size_t hop, int view, int x, int block_row, unsigned rows, bool down) {
        const codec::CodedImage& image = coded.images[static_cast<std::size_t>(view)];
        const int tile = block_row / 4 * coded.tile_columns() + x / 32;
        const int number = view * 10'000 + tile;
        const int words = tile_words(coded, image, static_cast<std::size_t>(tile));
        if (number != last_tile[hop]) {
            ++table[hop];
            tiles[hop] += words > 0 ? 1 : 0;
            last_tile[hop] = number;
        }
        if (words == 0) return;
        const std::span<const std::byte> bytes = image.tile_bytes(static_cast<std::size_t>(tile));
        const std::uint64_t classes = codec::board_tile_classes(bytes);
        const auto& sizes = coded.board.classes[image.head.references() > 0 ? 1 : 0];
        const int place = x / 8 % 4 * 4 + block_row % 4;
        const int number_of_class = block_class(classes, place);
        if (number_of_class == 0) return;
        const codec::RecordClass& of = sizes[static_cast<std::size_t>(number_of_class)];
        const int first = record_offset(classes, place, sizes);
        records[hop] += static_cast<std::uint64_t>((first + of.bytes() - 1) / 8 - first / 8 + 1);
        if (!of.predicted) return;
        const auto byte = [&](int n) {
            const auto at = static_cast<std::size_t>(6 + first + n);
            return at < bytes.size() ? static_cast<int>(bytes[at]) : 0;
        };
        const codec::BoardMotion motion = codec::board_motion(static_cast<std::uint16_t>(byte(0) | byte(1) << 8));
        const int reference =
            image.head.reference[image.head.references() < 2 ? 0U : static_cast<unsigned>(motion.reference)];
        std::array<unsigned, 64> wanted{};
        for (int n = 0; n < 8; ++n) {
            if (((rows >> n) & 1U) == 0) continue;
            const int row = std::clamp(8 * block_row + n + motion.y, 0, coded.coded_height() - 1);
            wanted[static_cast<std::size_t>(row / 8)] |= 1U << (row % 8);
        }
        const int column = std::clamp(x + motion.x, 0, coded.coded_width() - 1);
        for (int n = 0; n < 64; ++n) {
            const int at = down ? n : 63 - n;
            if (wanted[static_cast<std::size_t>(at)] != 0) {
                block(hop + 1, reference, column, at, wanted[static_cast<std::size_t>(at)], down);
            }
        }
    }

    const RaySpaceObject& object;
    const codec::CodedImages& coded;
    std::array<int, kHops> last_tile{};
    std::array<std::uint64_t, kHops> table{}, tiles{}, records{};
};

Result<BoardRun> drawn(Board& board, const RaySpaceObject& object, int side, int views, double turn = 0.1) {
    const Result<int> slot = board.place(object);
    if (!slot) return slot.error();
    std::vector<BoardView> cycle;
    for (int v = 0; v < views; ++v) {
        cycle.push_back(
            *board.view(*slot, *prepare_view(object, test::upright_at(turn * v, 3.5, 0, 0.95, side, side))));
    }
    return board.render({cycle});
}

TEST(CodedBoardCycles, MemoryReadsAreThoseOfTheFormula) {
    constexpr int kSide = 70;
    constexpr int kViews = 6;
    constexpr double kTurn = 1.1;  // the views use images of all levels
    std::array<std::uint64_t, kHops> records{};
    for (std::uint64_t seed = 21; seed < 27; ++seed) {
        const RaySpaceObject object = test::random_coded_object(
            {.views = 16, .width = 100, .height = 90, .fl_px = 140, .x_cells = 64, .u_cells = 64, .seed = seed});
        Board board(test::compressed());
        ASSERT_TRUE(drawn(board, object, kSide, kViews, kTurn).ok());
        ReadCounts counted(object);
        for (int v = 0; v < kViews; ++v) {
            const auto view = *prepare_view(object, test::upright_at(kTurn * v, 3.5, 0, 0.95, kSide, kSide));
            for (int i = 0; i < kSide; ++i) {
                const RaySetup ray = set_up_ray(object, view, i, 0);
                if (ray.image >= 0) counted.column(ray, kSide);
            }
        }
        const auto reads = [&](const std::string& client) {
            const auto& ports = board.top().memory().read_ports();
            const auto port =
                std::find_if(ports.begin(), ports.end(), [&](const ReadPort& p) { return p.client == client; });
            RS_CHECK(port != ports.end());
            return board.top().memory().counters().words_read[static_cast<std::size_t>(port - ports.begin())];
        };
        EXPECT_EQ(reads("book_lookup"), book_words(object.coded->board));
        for (std::size_t hop = 0; hop < kHops; ++hop) {
            const std::string number = "_" + std::to_string(hop);
            EXPECT_EQ(reads("tile_finder" + number), counted.table[hop]) << "hop " << hop << ", seed " << seed;
            EXPECT_EQ(reads("tile_reader" + number), counted.tiles[hop]) << "hop " << hop << ", seed " << seed;
            EXPECT_EQ(reads("record_reader" + number), counted.records[hop]) << "hop " << hop << ", seed " << seed;
            records[hop] += counted.records[hop];
        }
    }
    for (const std::uint64_t of_hop : records) EXPECT_GT(of_hop, 0U);
}

TEST(CodedBoardCycles, TickOrderChangesNeitherCyclesNorBits) {
    const RaySpaceObject object =
        test::random_coded_object({.views = 12, .width = 70, .height = 70, .fl_px = 90, .seed = 4});
    Board reference(test::compressed());
    const Result<BoardRun> expected = drawn(reference, object, 40, 4);
    ASSERT_TRUE(expected.ok());
    for (const std::uint64_t seed : {1, 2, 3}) {
        Board board(test::compressed(), seed);
        const Result<BoardRun> run = drawn(board, object, 40, 4);
        ASSERT_TRUE(run.ok());
        test::expect_same_run(*run, *expected, board);
    }
}

// Compared with the same images, uncompressed, on the published board. The load of the codebooks is included.
TEST(CodedBoardCycles, IsNotSlowerThanThePrototype) {
    const test::EncodedObject object = test::encoded_object(20, 128);
    Board coded_board(test::compressed());
    Board raw_board(test::prototype());
    const Result<BoardRun> coded = drawn(coded_board, object.coded, 128, 3);
    const Result<BoardRun> raw = drawn(raw_board, object.raw, 128, 3);
    ASSERT_TRUE(coded.ok());
    ASSERT_TRUE(raw.ok());
    EXPECT_LE(coded->cycles[0].render_cycles(), raw->cycles[0].render_cycles());
    EXPECT_EQ(make_report(coded_board, *coded).rendering.limiting_block, "memory_controller");
}

// Golden counts from a run whose parts were verified; any change of timing changes them.
TEST(CodedBoardCyclesGolden, RandomTiles) {
    const auto cycles_of = [](int side, int views, std::uint64_t seed) {
        Board board(test::compressed());
        const RaySpaceObject object =
            test::random_coded_object({.views = 12, .width = 70, .height = 70, .fl_px = 90, .seed = seed});
        const Result<BoardRun> run = drawn(board, object, side, views);
        return run ? run->cycles[0].render_cycles() : 0;
    };
    EXPECT_EQ(cycles_of(64, 1, 4), 32'836U);
    EXPECT_EQ(cycles_of(100, 2, 6), 46'966U);
}

}  // namespace
}  // namespace rs::engine::model
