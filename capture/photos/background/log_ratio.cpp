#include "capture/photos/background/log_ratio.hpp"

#include "rayspace/api/types/check.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace rs::capture {
namespace {

float mean_channel(const cv::Vec3f& light) {
    constexpr float kMinLight = 1e-3F;  // keeps the logarithm finite
    return std::max(kMinLight, (light[0] + light[1] + light[2]) / 3);
}

}  // namespace

cv::Mat3f light_mat(const Image<LinearRgb>& light) {
    cv::Mat3f result(light.height(), light.width());
    for (int y = 0; y < result.rows; ++y) {
        for (int x = 0; x < result.cols; ++x) result(y, x) = {light(x, y).r, light(x, y).g, light(x, y).b};
    }
    return result;
}

cv::Mat3f smoothed_light(cv::Mat3f light) {
    constexpr double kSigma_px = 1;
    cv::GaussianBlur(light, light, {0, 0}, kSigma_px);
    return light;
}

cv::Mat1f log_ratio(const cv::Mat3f& photo, const cv::Mat3f& background) {
    RS_CHECK(photo.size() == background.size());
    cv::Mat1f ratio(photo.size());
    for (int y = 0; y < ratio.rows; ++y) {
        for (int x = 0; x < ratio.cols; ++x) ratio(y, x) = mean_channel(photo(y, x)) / mean_channel(background(y, x));
    }
    cv::log(ratio, ratio);
    return ratio;
}

cv::Mat1b edges_of_log_ratio(const cv::Mat1f& ratio, float min_gradient_per_px) {
    constexpr double kSobelScale = 1.0 / 8;  // to a derivative per px
    const float min_squared = min_gradient_per_px * min_gradient_per_px;
    cv::Mat1f dx, dy;
    cv::Sobel(ratio, dx, CV_32F, 1, 0, 3, kSobelScale);
    cv::Sobel(ratio, dy, CV_32F, 0, 1, 3, kSobelScale);
    cv::Mat1b edges(ratio.size());
    for (int y = 0; y < edges.rows; ++y) {
        for (int x = 0; x < edges.cols; ++x) {
            const float squared = dx(y, x) * dx(y, x) + dy(y, x) * dy(y, x);
            edges(y, x) = squared > min_squared ? 255 : 0;
        }
    }
    return edges;
}

}  // namespace rs::capture
