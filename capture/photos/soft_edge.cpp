#include "capture/photos/soft_edge.hpp"

#include "capture/photos/opencv_image.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace rs::capture {
namespace {

// F and B are as good as equal below this distance in linear light: the projection then says nothing.
constexpr float kIndistinct = 0.02F;

// Neither side is of one colour: what lies within so many of its standard deviations is that side's, up to this share
// of the way from B to F.
constexpr float kScatter = 0.5F;
constexpr float kMostScatter = 0.35F;

// By distance alone: of an edge without blur, a pixel's own width mixes.
constexpr float kAlphaPerPx = 0.75F;

// The mask's border lies up to a pixel outside the object: a pixel with little of the object does not look like the
// backdrop any more. The second pass begins from where alpha was half.
constexpr int kPasses = 2;

// What one side of the border looks like near by.
struct Side {
    cv::Mat3f mean;        // linear light; 0 where nothing weighs
    cv::Mat1f scatter_sq;  // variance, all channels together
};

// Of `colour` with `weight`, over a Gaussian neighbourhood.
Side side_of(const cv::Mat3f& colour, const cv::Mat1f& weight, double sigma_px) {
    cv::Mat4f sums(colour.size());
    for (int y = 0; y < colour.rows; ++y) {
        for (int x = 0; x < colour.cols; ++x) {
            const cv::Vec3f& c = colour(y, x);
            sums(y, x) = cv::Vec4f(c[0], c[1], c[2], c.dot(c)) * weight(y, x);
        }
    }
    cv::Mat1f weights;
    cv::GaussianBlur(weight, weights, {0, 0}, sigma_px);
    cv::GaussianBlur(sums, sums, {0, 0}, sigma_px);
    Side side{cv::Mat3f(colour.size()), cv::Mat1f(colour.size())};
    for (int y = 0; y < colour.rows; ++y) {
        for (int x = 0; x < colour.cols; ++x) {
            const float w = weights(y, x);
            const cv::Vec4f mean = w > 1e-6F ? cv::Vec4f(sums(y, x) * (1 / w)) : cv::Vec4f();
            side.mean(y, x) = {mean[0], mean[1], mean[2]};
            side.scatter_sq(y, x) = std::max(0.0F, mean[3] - side.mean(y, x).dot(side.mean(y, x)));
        }
    }
    return side;
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

SoftEdge softened(const cv::Mat3f& light, const cv::Mat1b& inside, int band_px) {
    const int width = light.cols;
    const int height = light.rows;
    SoftEdge edge{Image<float>(width, height), Image<LinearRgb>(width, height), Image<LinearRgb>(width, height)};
    cv::Mat1b outside;
    cv::bitwise_not(inside, outside);
    const cv::Mat1f depth_inside = depth_within(inside);
    const cv::Mat1f depth_outside = depth_within(outside);
    const double sigma_px = band_px + 1.0;
    const Side object = side_of(light, trust(depth_inside, band_px), sigma_px);
    const Side backdrop = side_of(light, trust(depth_outside, band_px), sigma_px);

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
            const cv::Vec3f& f = object.mean(y, x);
            const cv::Vec3f& b = backdrop.mean(y, x);
            const cv::Vec3f span = f - b;
            const float span_sq = std::max(span.dot(span), 1e-9F);
            // What lies within a side's scatter is that side's.
            const float object_scatter =
                std::min(kMostScatter, kScatter * std::sqrt(object.scatter_sq(y, x) / span_sq));
            const float backdrop_scatter =
                std::min(kMostScatter, kScatter * std::sqrt(backdrop.scatter_sq(y, x) / span_sq));
            const float along = (light(y, x) - b).dot(span) / span_sq;
            const float by_colour =
                std::clamp((along - backdrop_scatter) / (1 - backdrop_scatter - object_scatter), 0.0F, 1.0F);
            const float by_distance = std::clamp(0.5F + kAlphaPerPx * distance, 0.0F, 1.0F);
            const float confidence =
                span_sq / (span_sq + kIndistinct * kIndistinct + object.scatter_sq(y, x) + backdrop.scatter_sq(y, x));
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

}  // namespace

int expected_band_px(int width, int height) {
    return std::clamp((std::max(width, height) + 225) / 450, 2, 8);
}

SoftEdge soften_edge(ConstImageView<Rgba8> photo, ConstImageView<std::uint8_t> mask, int band_px) {
    RS_CHECK(photo.width() == mask.width() && photo.height() == mask.height() && band_px >= 1 && band_px <= 16);
    const int width = photo.width();
    const int height = photo.height();
    if (width == 0 || height == 0)
        return {Image<float>(width, height), Image<LinearRgb>(width, height), Image<LinearRgb>(width, height)};
    const cv::Mat3f light = linear_mat(photo);
    cv::Mat1b inside(height, width);
    for (int y = 0; y < height; ++y) std::copy_n(mask.row(y), width, inside[y]);
    SoftEdge edge = softened(light, inside, band_px);
    for (int pass = 1; pass < kPasses; ++pass) {
        for (int y = 0; y < inside.rows; ++y) {
            for (int x = 0; x < inside.cols; ++x) inside(y, x) = edge.alpha(x, y) >= 0.5F ? 255 : 0;
        }
        edge = softened(light, inside, band_px);
    }
    return edge;
}

}  // namespace rs::capture
