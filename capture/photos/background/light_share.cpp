#include "capture/photos/background/light_share.hpp"

#include "rayspace/base/check.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace rs::capture {
namespace {

constexpr float kEdge_per_px = 0.02F;

float brightness(const cv::Vec3f& light) {
    constexpr float kDark = 1e-3F;
    return std::max(kDark, (light[0] + light[1] + light[2]) / 3);
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
    constexpr double kSmoothing_px = 1;
    cv::GaussianBlur(light, light, {0, 0}, kSmoothing_px);
    return light;
}

cv::Mat1f log_light_share(const cv::Mat3f& photo, const cv::Mat3f& plate) {
    RS_CHECK(photo.size() == plate.size());
    cv::Mat1f share(photo.size());
    for (int y = 0; y < share.rows; ++y) {
        for (int x = 0; x < share.cols; ++x) share(y, x) = brightness(photo(y, x)) / brightness(plate(y, x));
    }
    cv::log(share, share);
    return share;
}

cv::Mat1b edges_of_share(const cv::Mat1f& log_share) {
    constexpr double kPerPixel = 1.0 / 8;
    cv::Mat1f across, down;
    cv::Sobel(log_share, across, CV_32F, 1, 0, 3, kPerPixel);
    cv::Sobel(log_share, down, CV_32F, 0, 1, 3, kPerPixel);
    cv::Mat1b edges(log_share.size());
    for (int y = 0; y < edges.rows; ++y) {
        for (int x = 0; x < edges.cols; ++x) {
            const float squared = across(y, x) * across(y, x) + down(y, x) * down(y, x);
            edges(y, x) = squared > kEdge_per_px * kEdge_per_px ? 255 : 0;
        }
    }
    return edges;
}

}  // namespace rs::capture
