#include "capture/turns/hull_search.hpp"

#include "tests/capture/turns/turn_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <vector>

namespace rs::capture {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(HullSearch, NamesMasksThatLackOrAddAPart) {
    std::vector<HullView> views;
    for (const PlacedTurn& turn : test::two_turns()) {
        for (HullView& view : hull_views(turn, turn_masks(test::turn_images(turn), 240))) {
            views.push_back(std::move(view));
        }
    }
    const DoubtfulMasks none = find_doubtful_masks(views);
    EXPECT_THAT(none.small, IsEmpty());
    EXPECT_THAT(none.large, IsEmpty());
    cv::Mat1b& cut = views[3].mask;
    cut.colRange(0, cut.cols / 2) = 0;
    views[17].mask.rowRange(110, 150) = 255;
    const DoubtfulMasks found = find_doubtful_masks(views);
    EXPECT_THAT(found.small, ElementsAre(3));
    EXPECT_THAT(found.large, ElementsAre(17));
}

}  // namespace
}  // namespace rs::capture
