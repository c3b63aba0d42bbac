#include "capture/photos/soft_edge.hpp"

#include "capture/photos/opencv_image.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace rs::capture {
namespace {

// F and B are as good as equal below this distance in linear light: the projection then says nothing.
constexpr float kIndistinct = 0.02F;

// Mean of `colour` with `weight`, over a Gaussian neighbourhood; 0 where nothing weighs.
cv::Mat3f local_mean(const cv::Mat3f& colour, const cv::Mat1f& weight, double sigma_px) {
    cv::Mat3f sums(colour.size());
    for (int y = 0; y < colour.rows; ++y) {
        for (int x = 0; x < colour.cols; ++x) sums(y, x) = colour(y, x) * weight(y, x);
    }
    cv::Mat1f weights;
    cv::GaussianBlur(weight, weights, {0, 0}, sigma_px);
    cv::GaussianBlur(sums, sums, {0, 0}, sigma_px);
    for (int y = 0; y < colour.rows; ++y) {
        for (int x = 0; x < colour.cols; ++x) {
            const float w = weights(y, x);
            sums(y, x) = w > 1e-6F ? cv::Vec3f(sums(y, x) * (1 / w)) : cv::Vec3f();
        }
    }
    return sums;
}

// Distance in px to the nearest pixel of the other side; 0 on the other side itself.
cv::Mat1f depth_within(const cv::Mat1b& side) {
    cv::Mat1f depth;
    cv::distanceTransform(side, depth, cv::DIST_L2, cv::DIST_MASK_5);
    return depth;
}

// How much a pixel's colour is its own side's: little at the border, where both sides mix, growing to band_px + 1. Not
// nothing at the border either, for of a thin claw there may be no more than that.
cv::Mat1f trust(const cv::Mat1f& depth, int band_px) {
    constexpr float kMixed = 0.02F;
    cv::Mat1f weight(depth.size(), 0.0F);
    for (int y = 0; y < depth.rows; ++y) {
        for (int x = 0; x < depth.cols; ++x) {
            if (depth(y, x) <= 0) continue;
            const float own = std::min(depth(y, x), static_cast<float>(band_px + 1)) - 1;
            weight(y, x) = kMixed + own * own;
        }
    }
    return weight;
}

LinearRgb rgb(const cv::Vec3f& v) {
    return {v[0], v[1], v[2]};
}

}  // namespace

int expected_band_px(int width, int height) {
    return std::clamp((std::max(width, height) + 225) / 450, 2, 8);
}

SoftEdge soften_edge(ConstImageView<Rgba8> photo, ConstImageView<std::uint8_t> mask, int band_px) {
    RS_CHECK(photo.width() == mask.width() && photo.height() == mask.height() && band_px >= 1 && band_px <= 16);
    const int width = photo.width();
    const int height = photo.height();
    SoftEdge edge{Image<float>(width, height), Image<LinearRgb>(width, height), Image<LinearRgb>(width, height)};
    if (edge.alpha.empty()) return edge;

    cv::Mat1b inside(height, width);
    for (int y = 0; y < height; ++y) std::copy_n(mask.row(y), width, inside[y]);
    cv::Mat1b outside;
    cv::bitwise_not(inside, outside);
    const cv::Mat1f depth_inside = depth_within(inside);
    const cv::Mat1f depth_outside = depth_within(outside);
    const cv::Mat3f light = linear_mat(photo);
    const double sigma_px = band_px + 1.0;
    const cv::Mat3f object = local_mean(light, trust(depth_inside, band_px), sigma_px);
    const cv::Mat3f backdrop = local_mean(light, trust(depth_outside, band_px), sigma_px);

    const auto band = static_cast<float>(band_px);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            // From the border, which runs half a pixel before the first pixel of either side; positive inside.
            const float distance = inside(y, x) != 0 ? std::max(0.5F, depth_inside(y, x) - 0.5F)
                                                     : -std::max(0.5F, depth_outside(y, x) - 0.5F);
            if (std::abs(distance) >= band) {
                edge.alpha(x, y) = distance > 0 ? 1.0F : 0.0F;
                continue;
            }
            const cv::Vec3f& f = object(y, x);
            const cv::Vec3f& b = backdrop(y, x);
            const cv::Vec3f span = f - b;
            const float span_sq = span.dot(span);
            const float by_distance = 0.5F + 0.5F * distance;
            const float by_colour = (light(y, x) - b).dot(span) / std::max(span_sq, 1e-9F);
            const float confidence = span_sq / (span_sq + kIndistinct * kIndistinct);
            const float mixed = by_distance + confidence * (by_colour - by_distance);
            // The mask is right to a pixel or so: alpha nears its value towards the band's ends.
            const float low = std::max(0.0F, (distance - 0.5F) / (band - 0.5F));
            const float high = std::min(1.0F, 1 + (distance + 0.5F) / (band - 0.5F));
            edge.alpha(x, y) = std::clamp(std::clamp(mixed, 0.0F, 1.0F), low, high);
            edge.object(x, y) = rgb(f);
            edge.backdrop(x, y) = rgb(b);
        }
    }
    return edge;
}

}  // namespace rs::capture
