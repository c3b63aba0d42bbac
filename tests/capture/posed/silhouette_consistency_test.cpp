#include "capture/posed/silhouette_consistency.hpp"

#include "tests/capture/posed/posed_scene.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace rs::capture {
namespace {

// Photos of the object before a backdrop, with its true masks.
std::vector<SilhouetteView> views_before(const Rgba8& backdrop, int count = 24) {
    std::vector<SilhouetteView> views;
    for (const PosedCamera& posed : test::posed_cameras(count, 160, 120)) {
        Image<Rgba8> photo = test::posed_photo(posed);
        SilhouetteView view{{posed.camera, cv::Mat1b(photo.height(), photo.width(), std::uint8_t{0})}, {}};
        for (int y = 0; y < photo.height(); ++y) {
            for (int x = 0; x < photo.width(); ++x) {
                view.hull.mask(y, x) = photo(x, y).a >= 128 ? 255 : 0;
                photo(x, y) = over(photo(x, y), backdrop);
            }
        }
        view.photo = std::move(photo);
        views.push_back(std::move(view));
    }
    return views;
}

std::vector<cv::Mat1b> masks_of(const std::vector<SilhouetteView>& views) {
    std::vector<cv::Mat1b> masks;
    for (const SilhouetteView& view : views) masks.push_back(view.hull.mask.clone());
    return masks;
}

double least_overlap(const std::vector<cv::Mat1b>& masks, const std::vector<cv::Mat1b>& truth) {
    double least = 1;
    for (std::size_t i = 0; i < masks.size(); ++i) {
        const double both = cv::countNonZero(masks[i] & truth[i]), either = cv::countNonZero(masks[i] | truth[i]);
        least = std::min(least, both / either);
    }
    return least;
}

constexpr Rgba8 kBlack{8, 8, 8, 255};

TEST(SilhouetteConsistency, BackgroundInManyMasksIsRemoved) {
    std::vector<SilhouetteView> views = views_before(kBlack);
    const std::vector<cv::Mat1b> truth = masks_of(views);
    for (std::size_t i = 0; i < views.size(); i += 2) {  // a grey cloth beside the object, in the mask
        for (int y = 0; y < 120; ++y) {
            for (int x = 0; x < 60; ++x) {
                if (truth[i](y, x) == 0) views[i].photo(x, y) = {40, 40, 40, 255};
            }
        }
        cv::rectangle(views[i].hull.mask, cv::Rect(20, 0, 40, 120), 255, cv::FILLED);
    }
    ASSERT_LT(least_overlap(masks_of(views), truth), 0.7);
    const auto found = make_consistent(views, {0, 0, 0}, nullptr);
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_GT(least_overlap(found->masks, truth), 0.95);
    EXPECT_GT(found->overlap, 0.9);
}

TEST(SilhouetteConsistency, PartThatHalfOfTheMasksLackIsRestored) {
    std::vector<SilhouetteView> views = views_before(kBlack);
    const std::vector<cv::Mat1b> truth = masks_of(views);
    for (std::size_t i = 0; i < views.size(); i += 2) views[i].hull.mask.rowRange(0, 55) = 0;
    ASSERT_LT(least_overlap(masks_of(views), truth), 0.7);
    const auto found = make_consistent(views, {0, 0, 0}, nullptr);
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_GT(least_overlap(found->masks, truth), 0.95);
}

TEST(SilhouetteConsistency, NoMasksAreNeededWhereTheBackgroundDiffers) {
    std::vector<SilhouetteView> views = views_before({230, 225, 215, 255});
    const std::vector<cv::Mat1b> truth = masks_of(views);
    for (SilhouetteView& view : views) view.hull.mask.release();
    const auto found = make_consistent(views, {0, 0, 0}, nullptr);
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_GT(least_overlap(found->masks, truth), 0.95);
}

TEST(SilhouetteConsistency, SpotsInTheBackgroundsColourAreFilled) {
    std::vector<SilhouetteView> views = views_before(kBlack);
    const std::vector<cv::Mat1b> truth = masks_of(views);
    for (std::size_t i = 0; i < views.size(); ++i) {  // a black label, elsewhere in each photo as reflections are
        const glm::dvec3 at = views[i].hull.camera.project({0.3 * std::sin(double(i)), 0.4 * std::cos(double(i)), 0});
        const cv::Rect label(static_cast<int>(at.x) - 4, static_cast<int>(at.y) - 4, 9, 9);
        for (int y = label.y; y < label.br().y; ++y) {
            for (int x = label.x; x < label.br().x; ++x) views[i].photo(x, y) = kBlack;
        }
        views[i].hull.mask(label) = 0;
    }
    const auto found = make_consistent(views, {0, 0, 0}, nullptr);
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_GT(least_overlap(found->masks, truth), 0.95);
}

TEST(SilhouetteConsistency, RefinesTheContourInFullSize) {
    const std::vector<SilhouetteView> views = views_before(kBlack, 3);
    const cv::Mat1b truth = views[0].hull.mask;
    ColourHistogram object;
    for (int y = 0; y < truth.rows; ++y) {
        for (int x = 0; x < truth.cols; ++x) {
            if (truth(y, x) != 0) object.add(views[0].photo(x, y));
        }
    }
    object.normalize();
    cv::Mat1b coarse;
    cv::dilate(truth, coarse, cv::Mat(), {-1, -1}, 3);
    const Image<std::uint8_t> refined = refine_silhouette(views[0].photo, coarse, object, 5);
    const cv::Mat1b mask(refined.height(), refined.width(), const_cast<std::uint8_t*>(refined.data()));
    EXPECT_LT(least_overlap({coarse}, {truth}), 0.9);
    EXPECT_GT(least_overlap({mask}, {truth}), 0.97);
}

}  // namespace
}  // namespace rs::capture
