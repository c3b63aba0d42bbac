#include "capture/opencv/connected_parts.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <iterator>
#include <numeric>
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
}

}  // namespace
}  // namespace rs::capture
