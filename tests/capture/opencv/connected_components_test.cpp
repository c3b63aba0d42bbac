#include "capture/opencv/connected_components.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <iterator>
#include <numeric>
#include <random>
#include <vector>

namespace rs::capture {
namespace {

// A bar on the upper border, a square below it, a pixel diagonally adjacent to the square, and a pixel on the right
// border.
cv::Mat1b four_components_mask() {
    cv::Mat1b mask(12, 16, std::uint8_t{0});
    mask(cv::Rect(2, 0, 8, 2)) = 255;
    mask(cv::Rect(4, 5, 3, 3)) = 255;
    mask(8, 7) = 255;
    mask(6, 15) = 255;
    return mask;
}

TEST(ConnectedComponents, ConnectivityEightJoinsDiagonalNeighbours) {
    EXPECT_EQ(ConnectedComponents(four_components_mask(), 4).count(), 5);
    EXPECT_EQ(ConnectedComponents(four_components_mask(), 8).count(), 4);
}

TEST(ConnectedComponents, LabelAreaAndBorderContact) {
    const ConnectedComponents components(four_components_mask(), 8);
    const int bar = components.label(2, 0), square = components.label(4, 5), spot = components.label(15, 6);
    EXPECT_EQ(components.label(0, 11), 0);
    EXPECT_EQ(components.area(bar), 16);
    EXPECT_EQ(components.area(square), 10);
    EXPECT_TRUE(components.touches_border(bar));
    EXPECT_TRUE(components.touches_border(spot));
    EXPECT_FALSE(components.touches_border(square));
}

TEST(ConnectedComponents, CoordinatesAreThoseOfTheImage) {
    cv::Mat1b mask(12, 16, std::uint8_t{0});
    mask(cv::Rect(4, 5, 3, 2)) = 255;
    mask(8, 9) = 255;
    const ConnectedComponents components(mask, 8);
    cv::Mat1b visited(mask.size(), std::uint8_t{0});
    components.for_each_pixel([&](int x, int y, int label) {
        EXPECT_EQ(components.label(x, y), label);
        visited(y, x) = 255;
    });
    EXPECT_EQ(cv::countNonZero(visited != mask), 0);
    const int square = components.label(6, 6), spot = components.label(9, 8);
    EXPECT_NE(square, spot);
    EXPECT_FALSE(components.touches_border(square));
    EXPECT_FALSE(components.touches_border(spot));
    for (const cv::Point& beside : {cv::Point(0, 0), {3, 5}, {15, 11}, {4, 4}}) {
        EXPECT_EQ(components.label(beside.x, beside.y), 0);
    }
}

// Only the bounding box is labelled; the result must equal labelling the whole mask.
TEST(ConnectedComponents, EqualsOpenCvOnTheWholeMask) {
    std::minstd_rand random(5);
    const auto below = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
    for (int trial = 0; trial < 3000; ++trial) {
        cv::Mat1b mask(1 + below(20), 1 + below(20), std::uint8_t{0});
        for (int pixels = below(trial % 3 == 0 ? 5 : 80); pixels > 0; --pixels) {
            mask(below(mask.rows), below(mask.cols)) = 255;
        }
        const int connectivity = trial % 2 == 0 ? 4 : 8;
        const ConnectedComponents components(mask, connectivity);
        cv::Mat1i labels, found(mask.size(), 0);
        cv::Mat stats, centroids;
        ASSERT_EQ(components.count(), cv::connectedComponentsWithStats(mask, labels, stats, centroids, connectivity));
        components.for_each_pixel([&](int x, int y, int label) { found(y, x) = label; });
        ASSERT_EQ(cv::countNonZero(found != labels), 0) << mask;
        for (int y = 0; y < mask.rows; ++y) {
            for (int x = 0; x < mask.cols; ++x) ASSERT_EQ(components.label(x, y), labels(y, x)) << mask;
        }
        components.for_each_border_pixel([&](int x, int y, int label) { ASSERT_EQ(label, labels(y, x)) << mask; });
        for (int label = 1; label < components.count(); ++label) {
            const int left = stats.at<int>(label, cv::CC_STAT_LEFT), top = stats.at<int>(label, cv::CC_STAT_TOP);
            const bool right = left + stats.at<int>(label, cv::CC_STAT_WIDTH) == mask.cols;
            const bool bottom = top + stats.at<int>(label, cv::CC_STAT_HEIGHT) == mask.rows;
            ASSERT_EQ(components.area(label), stats.at<int>(label, cv::CC_STAT_AREA));
            ASSERT_EQ(components.touches_border(label), left == 0 || top == 0 || right || bottom) << mask;
        }
    }
}

// Enclosed components equal those of the inverted mask; all others touch the border in both.
TEST(ConnectedComponents, OfComplementEqualsComponentsOfTheInvertedMask) {
    std::minstd_rand random(9);
    const auto below = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
    int enclosed = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        cv::Mat1b mask(1 + below(20), 1 + below(20), std::uint8_t{0});
        for (int pixels = below(120); pixels > 0; --pixels) mask(below(mask.rows), below(mask.cols)) = 255;
        cv::Mat1b inverted;
        cv::bitwise_not(mask, inverted);
        const ConnectedComponents complement = ConnectedComponents::of_complement(mask), whole(inverted, 4);
        for (int y = 0; y < mask.rows; ++y) {
            for (int x = 0; x < mask.cols; ++x) {
                const int label = complement.label(x, y), of_whole = whole.label(x, y);
                const bool is_enclosed = of_whole != 0 && !whole.touches_border(of_whole);
                ASSERT_EQ(label != 0 && !complement.touches_border(label), is_enclosed) << mask;
                if (!is_enclosed) continue;
                ASSERT_EQ(complement.area(label), whole.area(of_whole)) << mask;
                ++enclosed;
            }
        }
    }
    EXPECT_GT(enclosed, 1000);
}

TEST(BoxOf, IsTheBoundingBoxOfTheNonZeroPixels) {
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
        ASSERT_EQ(bounding_box(mask), around) << mask;
    }
}

TEST(ConnectedComponents, AccumulateAddsUpPerComponent) {
    const ConnectedComponents components(four_components_mask(), 4);
    const auto even_columns = components.accumulate<int>([](int x, int, int& count) { count += x % 2 == 0 ? 1 : 0; });
    EXPECT_EQ(even_columns[components.label(2, 0)], 8);
    EXPECT_EQ(even_columns[components.label(4, 5)], 6);
    EXPECT_EQ(even_columns[components.label(7, 8)], 0);
    EXPECT_EQ(even_columns[0], 0) << "background pixels are not visited";
    EXPECT_EQ(std::accumulate(even_columns.begin(), even_columns.end(), 0), 14);
    EXPECT_EQ(std::distance(even_columns.begin(), even_columns.end()), 4) << "label 0 is not iterated";
}

TEST(ConnectedComponents, ForEachBorderPixelVisitsEachOnce) {
    const auto at_border = [](const cv::Mat1b& mask) {
        const ConnectedComponents components(mask, 4);
        PerComponent<int> count(components.count());
        components.for_each_border_pixel([&](int, int, int label) { ++count[label]; });
        return std::vector<int>(count.begin(), count.end());
    };
    EXPECT_EQ(at_border(four_components_mask()), (std::vector<int>{8, 0, 1, 0})) << "the bar, the square, two pixels";
    EXPECT_EQ(at_border(cv::Mat1b(5, 4, std::uint8_t{255})), std::vector<int>{14});
    EXPECT_EQ(at_border(cv::Mat1b(3, 2, std::uint8_t{255})), std::vector<int>{6});
    EXPECT_EQ(at_border(cv::Mat1b(4, 1, std::uint8_t{255})), std::vector<int>{4});
    EXPECT_EQ(at_border(cv::Mat1b(1, 7, std::uint8_t{255})), std::vector<int>{7});
}

TEST(ConnectedComponents, EmptyMaskHasNoComponents) {
    const ConnectedComponents components(cv::Mat1b(4, 4, std::uint8_t{0}), 8);
    EXPECT_EQ(components.count(), 1);
    const PerComponent<int> none(components.count());
    EXPECT_EQ(none.begin(), none.end());
    const ConnectedComponents empty(cv::Mat1b(), 8);
    EXPECT_EQ(empty.count(), 1);
    empty.for_each_pixel([](int, int, int) { ADD_FAILURE(); });
    empty.for_each_border_pixel([](int, int, int) { ADD_FAILURE(); });
}

}  // namespace
}  // namespace rs::capture
