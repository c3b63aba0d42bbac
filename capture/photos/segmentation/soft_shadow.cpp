#include "capture/photos/segmentation/soft_shadow.hpp"

#include "capture/opencv/connected_components.hpp"
#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/foreground/alpha_estimation.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/image/linear_light.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::capture {
namespace {

constexpr float kLeastOpacity = 0.03F;  // below it is noise
constexpr float kDarkest = 1e-3F;       // linear light; the share of less is not measured
constexpr double kSmoothing_px = 3;

float brightness(const LinearRgb& light) {
    return (light.r + light.g + light.b) / 3;
}

}  // namespace

Image<std::uint8_t> estimate_shadow(ConstImageView<Rgba8> photo, ConstImageView<LinearRgb> background,
                                    ConstImageView<std::uint8_t> mask) {
    RS_CHECK(photo.width() == background.width() && photo.height() == background.height());
    RS_CHECK(photo.width() == mask.width() && photo.height() == mask.height());
    Image<std::uint8_t> shadow(photo.width(), photo.height());
    if (shadow.empty()) return shadow;
    const int edge_px = expected_edge_width_px(photo.width(), photo.height());
    cv::Mat1b near_object;
    cv::dilate(mat_view(mask), near_object,
               cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * edge_px + 1, 2 * edge_px + 1}));
    // Smoothed over pixels that show the floor alone, so that it continues below the object's edge.
    cv::Mat1f missing(shadow.height(), shadow.width(), 0.0F), weight(missing.size(), 0.0F);
    for (int y = 0; y < missing.rows; ++y) {
        for (int x = 0; x < missing.cols; ++x) {
            const float behind = brightness(background(x, y));
            if (near_object(y, x) != 0 || behind < kDarkest) continue;
            missing(y, x) = std::clamp(1 - brightness(linear_rgb(photo(x, y))) / behind, 0.0F, 1.0F);
            weight(y, x) = 1;
        }
    }
    cv::GaussianBlur(missing, missing, {0, 0}, kSmoothing_px);
    cv::GaussianBlur(weight, weight, {0, 0}, kSmoothing_px);
    cv::Mat1b connected(missing.size());
    for (int y = 0; y < missing.rows; ++y) {
        for (int x = 0; x < missing.cols; ++x) {
            missing(y, x) = weight(y, x) > 1e-4F ? missing(y, x) / weight(y, x) : 0.0F;
            connected(y, x) = near_object(y, x) != 0 || missing(y, x) > kLeastOpacity ? 255 : 0;
        }
    }
    const ConnectedComponents parts(connected, 8);
    const auto touches_object =
        parts.accumulate<int>([&](int x, int y, int& touches) { touches |= mask(x, y) != 0 ? 1 : 0; });
    parts.for_each_pixel([&](int x, int y, int label) {
        if (touches_object[label] == 0) return;
        const float opacity = (missing(y, x) - kLeastOpacity) / (1 - kLeastOpacity);
        shadow(x, y) = static_cast<std::uint8_t>(std::lround(255 * std::clamp(opacity, 0.0F, 1.0F)));
    });
    return shadow;
}

ShadowKeepingSegmenter::ShadowKeepingSegmenter(std::shared_ptr<const Segmenter> segmenter,
                                               std::shared_ptr<const BackgroundModelSegmenter> background)
    : segmenter_(std::move(segmenter)), background_(std::move(background)) {
    RS_CHECK(segmenter_ != nullptr && background_ != nullptr);
}

Result<Segmentation> ShadowKeepingSegmenter::segment(const TurnPhoto& photo) const {
    Result<Segmentation> found = segmenter_->segment(photo);
    if (!found) return found;
    const Image<LinearRgb> background = background_->background_of(photo.image);
    found->shadow = estimate_shadow(photo.image, background, found->mask);
    return found;
}

}  // namespace rs::capture
