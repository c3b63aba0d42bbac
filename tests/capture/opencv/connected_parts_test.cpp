#include "capture/opencv/connected_parts.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <iterator>
#include <numeric>
#include <random>
#include <vector>

namespace rs::capture {
namespace {

// A bar at the upper border, a square below it, a pixel that touches the square at its corner, and one at the right.
cv::Mat1b four_parts() {
    cv::Mat1b mask(12, 16, std::uint8_t{0});
    mask(cv::Rect(2, 0, 8, 2)) = 255;
    mask(cv::Rect(4, 5, 3, 3)) = 255;
    mask(8, 7) = 255;
    mask(6, 15) = 255;
    return mask;
}

TEST(ConnectedParts, CornersConnectWhereEightNeighboursAreAsked) {
    EXPECT_EQ(ConnectedParts(four_parts(), 4).count(), 5);
    EXPECT_EQ(ConnectedParts(four_parts(), 8).count(), 4);
}

TEST(ConnectedParts, PlaceAndSize) {
    const ConnectedParts parts(four_parts(), 8);
    const int bar = parts.label(2, 0), square = parts.label(4, 5), spot = parts.label(15, 6);
    EXPECT_EQ(parts.label(0, 11), 0);
    EXPECT_EQ(parts.area(bar), 16);
    EXPECT_EQ(parts.area(square), 10);
    EXPECT_TRUE(parts.touches_border(bar));
    EXPECT_TRUE(parts.touches_border(spot));
    EXPECT_FALSE(parts.touches_border(square));
    EXPECT_EQ(parts.sides(square, 3), 8U) << "three rows are free below it";
    EXPECT_EQ(parts.rows_above(bar, square), 3);
    EXPECT_LT(parts.rows_above(square, spot), 0);
    EXPECT_TRUE(parts.share_columns(bar, square));
    EXPECT_FALSE(parts.share_columns(bar, spot));
}

TEST(ConnectedParts, PlacesAreThePicturesWhereverThePartsStand) {
    cv::Mat1b mask(12, 16, std::uint8_t{0});
    mask(cv::Rect(4, 5, 3, 2)) = 255;
    mask(8, 9) = 255;
    const ConnectedParts parts(mask, 8);
    cv::Mat1b visited(mask.size(), std::uint8_t{0});
    parts.for_each_pixel([&](int x, int y, int label) {
        EXPECT_EQ(parts.label(x, y), label);
        visited(y, x) = 255;
    });
    EXPECT_EQ(cv::countNonZero(visited != mask), 0);
    const int square = parts.label(6, 6), spot = parts.label(9, 8);
    EXPECT_NE(square, spot);
    EXPECT_EQ(parts.sides(square, 4), 1U) << "left of it four columns are free, five rows above and below";
    EXPECT_EQ(parts.sides(spot, 3), 8U);
    EXPECT_EQ(parts.sides(spot, 6), 4U | 8U);
    EXPECT_EQ(parts.rows_above(square, spot), 1);
    for (const cv::Point& beside : {cv::Point(0, 0), {3, 5}, {15, 11}, {4, 4}}) {
        EXPECT_EQ(parts.label(beside.x, beside.y), 0);
    }
}

// Only the box around the parts is looked at; what is found there is what is found in the whole picture.
TEST(ConnectedParts, AreThoseOfTheWholePicture) {
    std::minstd_rand random(5);
    const auto below = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
    for (int trial = 0; trial < 3000; ++trial) {
        cv::Mat1b mask(1 + below(20), 1 + below(20), std::uint8_t{0});
        for (int pixels = below(trial % 3 == 0 ? 5 : 80); pixels > 0; --pixels) {
            mask(below(mask.rows), below(mask.cols)) = 255;
        }
        const int connectivity = trial % 2 == 0 ? 4 : 8;
        const ConnectedParts parts(mask, connectivity);
        cv::Mat1i labels, found(mask.size(), 0);
        cv::Mat stats, centroids;
        ASSERT_EQ(parts.count(), cv::connectedComponentsWithStats(mask, labels, stats, centroids, connectivity));
        parts.for_each_pixel([&](int x, int y, int label) { found(y, x) = label; });
        ASSERT_EQ(cv::countNonZero(found != labels), 0) << mask;
        for (int y = 0; y < mask.rows; ++y) {
            for (int x = 0; x < mask.cols; ++x) ASSERT_EQ(parts.label(x, y), labels(y, x)) << mask;
        }
        parts.for_each_pixel_at_border([&](int x, int y, int label) { ASSERT_EQ(label, labels(y, x)) << mask; });
        for (int label = 1; label < parts.count(); ++label) {
            const int left = stats.at<int>(label, cv::CC_STAT_LEFT), top = stats.at<int>(label, cv::CC_STAT_TOP);
            const bool right = left + stats.at<int>(label, cv::CC_STAT_WIDTH) == mask.cols;
            const bool bottom = top + stats.at<int>(label, cv::CC_STAT_HEIGHT) == mask.rows;
            ASSERT_EQ(parts.area(label), stats.at<int>(label, cv::CC_STAT_AREA));
            ASSERT_EQ(parts.sides(label, 0),
                      (left == 0 ? 1U : 0U) | (top == 0 ? 2U : 0U) | (right ? 4U : 0U) | (bottom ? 8U : 0U));
        }
    }
}

// Those that the mask encloses are the whole picture's; the others touch the border there, too.
TEST(ConnectedParts, LeftBareAreThoseOfTheOtherMask) {
    std::minstd_rand random(9);
    const auto below = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
    int enclosed = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        cv::Mat1b mask(1 + below(20), 1 + below(20), std::uint8_t{0});
        for (int pixels = below(120); pixels > 0; --pixels) mask(below(mask.rows), below(mask.cols)) = 255;
        cv::Mat1b other;
        cv::bitwise_not(mask, other);
        const ConnectedParts bare = ConnectedParts::left_bare(mask), whole(other, 4);
        for (int y = 0; y < mask.rows; ++y) {
            for (int x = 0; x < mask.cols; ++x) {
                const int label = bare.label(x, y), of_whole = whole.label(x, y);
                const bool is_enclosed = of_whole != 0 && !whole.touches_border(of_whole);
                ASSERT_EQ(label != 0 && !bare.touches_border(label), is_enclosed) << mask;
                if (!is_enclosed) continue;
                ASSERT_EQ(bare.area(label), whole.area(of_whole)) << mask;
                ++enclosed;
            }
        }
    }
    EXPECT_GT(enclosed, 1000);
}

TEST(BoxOf, IsTheOneAroundAllThatIsSet) {
    std::minstd_rand random(7);
    const auto below = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
    for (int trial = 0; trial < 20'000; ++trial) {
        cv::Mat1b mask(1 + below(4), 1 + below(20), std::uint8_t{0});
        for (int pixels = below(4); pixels > 0; --pixels) mask(below(mask.rows), below(mask.cols)) = 255;
        cv::Rect around;
        for (int y = 0; y < mask.rows; ++y) {
            for (int x = 0; x < mask.cols; ++x) {
                if (mask(y, x) != 0) around |= cv::Rect(x, y, 1, 1);
            }
        }
        ASSERT_EQ(box_of(mask), around) << mask;
    }
}

TEST(ConnectedParts, TalliesCountWhatIsOfEachPart) {
    const ConnectedParts parts(four_parts(), 4);
    const auto even_columns = parts.tallied<int>([](int x, int, int& count) { count += x % 2 == 0 ? 1 : 0; });
    EXPECT_EQ(even_columns[parts.label(2, 0)], 8);
    EXPECT_EQ(even_columns[parts.label(4, 5)], 6);
    EXPECT_EQ(even_columns[parts.label(7, 8)], 0);
    EXPECT_EQ(even_columns[0], 0) << "what is in no part is not visited";
    EXPECT_EQ(std::accumulate(even_columns.begin(), even_columns.end(), 0), 14);
    EXPECT_EQ(std::distance(even_columns.begin(), even_columns.end()), 4) << "label 0 is no part";
}

TEST(ConnectedParts, EveryPixelAtTheBorderIsVisitedOnce) {
    const auto at_border = [](const cv::Mat1b& mask) {
        const ConnectedParts parts(mask, 4);
        PerPart<int> count(parts.count());
        parts.for_each_pixel_at_border([&](int, int, int label) { ++count[label]; });
        return std::vector<int>(count.begin(), count.end());
    };
    EXPECT_EQ(at_border(four_parts()), (std::vector<int>{8, 0, 1, 0})) << "the bar, the square, two pixels";
    EXPECT_EQ(at_border(cv::Mat1b(5, 4, std::uint8_t{255})), std::vector<int>{14});
    EXPECT_EQ(at_border(cv::Mat1b(3, 2, std::uint8_t{255})), std::vector<int>{6});
    EXPECT_EQ(at_border(cv::Mat1b(4, 1, std::uint8_t{255})), std::vector<int>{4});
    EXPECT_EQ(at_border(cv::Mat1b(1, 7, std::uint8_t{255})), std::vector<int>{7});
}

TEST(ConnectedParts, AnEmptyMaskHasNone) {
    const ConnectedParts parts(cv::Mat1b(4, 4, std::uint8_t{0}), 8);
    EXPECT_EQ(parts.count(), 1);
    const PerPart<int> none(parts.count());
    EXPECT_EQ(none.begin(), none.end());
    const ConnectedParts nowhere(cv::Mat1b(), 8);
    EXPECT_EQ(nowhere.count(), 1);
    nowhere.for_each_pixel([](int, int, int) { ADD_FAILURE(); });
    nowhere.for_each_pixel_at_border([](int, int, int) { ADD_FAILURE(); });
}

}  // namespace
}  // namespace rs::capture
