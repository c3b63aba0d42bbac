#include "rayspace/format/content_coding.hpp"

#include "tests/support/random.hpp"

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace rs;
using map_coding::Runs;

std::uint16_t number(const std::vector<std::uint8_t>& bytes, std::size_t n) {
    return static_cast<std::uint16_t>(bytes[2 * n] + 256 * bytes[2 * n + 1]);
}

// Decodes by encode/FORMAT.md, "RMAP", number by number.
Runs decoded_from_the_document(const std::vector<std::uint8_t>& bytes, std::size_t rows, std::size_t runs) {
    Runs found;
    for (std::size_t row = 0; row < rows; ++row) found.counts.push_back(number(bytes, row));
    std::size_t begin = 0;
    int first_of_row_before = 0;
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t run = begin; run < begin + found.counts[row]; ++run) {
            const int view_before = run == begin ? first_of_row_before : found.views[run - 1] + 1;
            const int view = (number(bytes, rows + run) + view_before) % 65536;
            int same_view = 0;
            for (std::size_t i = 0; i < run; ++i) same_view = found.views[i] == view ? found.lengths[i] : same_view;
            found.views.push_back(static_cast<std::uint16_t>(view));
            found.lengths.push_back(static_cast<std::uint16_t>((number(bytes, rows + runs + run) + same_view) % 65536));
        }
        if (found.counts[row] > 0) first_of_row_before = found.views[begin];
        begin += found.counts[row];
    }
    return found;
}

bool same(const Runs& a, const Runs& b) {
    return a.counts == b.counts && a.views == b.views && a.lengths == b.lengths;
}

TEST(MapCoding, RunsAreThoseOfTheDocument) {
    std::mt19937 random(1);
    for (int trial = 0; trial < 200; ++trial) {
        const int u_cells = 1 + static_cast<int>(random() % 40);
        const std::size_t rows = 1 + random() % 12;
        std::vector<std::uint16_t> cells;
        for (std::size_t i = 0; i < rows * static_cast<std::size_t>(u_cells); ++i) {
            const bool again = i > 0 && random() % 3 != 0;
            constexpr std::uint16_t kViews[] = {0, 1, 2, 3, 65534, 65535};
            cells.push_back(again ? cells.back() : kViews[random() % 6]);
        }
        const Runs runs = map_coding::encode_runs(cells, u_cells);
        const std::vector<std::uint8_t> bytes = map_coding::encode_residuals(runs);
        ASSERT_EQ(bytes.size(), map_coding::residual_bytes(rows, runs.views.size()));
        ASSERT_TRUE(same(decoded_from_the_document(bytes, rows, runs.views.size()), runs)) << "trial " << trial;
        ASSERT_TRUE(same(map_coding::decode_run_residuals(bytes, rows, runs.views.size()), runs)) << "trial " << trial;
        std::vector<std::uint16_t> again(cells.size());
        ASSERT_TRUE(map_coding::decode_runs(runs, u_cells, again).ok());
        ASSERT_EQ(again, cells);
    }
}

// Any bytes decode to runs; those that fill the rows decode to cells, the others are rejected.
TEST(MapCoding, AnyBytesAreRunsAndNeverWrittenBeyondTheCells) {
    std::mt19937 random(2);
    int accepted = 0, refused = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const std::size_t rows = 1 + random() % 4;
        const std::size_t runs = rows + random() % 5;
        std::vector<std::uint8_t> bytes(map_coding::residual_bytes(rows, runs));
        for (std::size_t i = 0; i < bytes.size(); ++i)
            bytes[i] = i % 2 == 0 ? static_cast<std::uint8_t>(random() % 3) : 0;
        const Runs found = map_coding::decode_run_residuals(bytes, rows, runs);
        std::size_t sum = 0;
        for (const std::uint16_t count : found.counts) sum += count;
        // The document only states that counts that do not add up are rejected.
        ASSERT_TRUE(sum != runs || same(found, decoded_from_the_document(bytes, rows, runs))) << "trial " << trial;
        constexpr int kWidth = 3;
        std::vector<std::uint16_t> cells(rows * kWidth);
        const bool ok = map_coding::decode_runs(found, kWidth, cells).ok();
        ++(ok ? accepted : refused);
        if (!ok) continue;
        ASSERT_EQ(sum, runs);
        std::size_t run = 0;
        for (std::size_t row = 0; row < rows; ++row) {
            std::size_t filled = 0;
            for (std::size_t i = 0; i < found.counts[row]; ++i, ++run) {
                for (int c = 0; c < found.lengths[run]; ++c)
                    ASSERT_EQ(cells[row * kWidth + filled++], found.views[run]);
            }
            ASSERT_EQ(filled, static_cast<std::size_t>(kWidth));
        }
    }
    EXPECT_GT(accepted, 50);
    EXPECT_GT(refused, 5000);
}

}  // namespace
