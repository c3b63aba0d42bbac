#include "capture/photos/soft_edge.hpp"

#include "capture/photos/opencv_image.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace rs::capture {
namespace {

// What a colour is off by for reasons of its own, in linear light, whatever side it is of.
constexpr float kIndistinct = 0.02F;

// A side's colours scatter along few directions near by; in every direction at least by this share of all of it.
constexpr float kEveryDirection = 0.05F;

// Photographs keep colours at half the resolution of their brightness: colour alone says alpha to within this.
constexpr float kChromaDoubt = 0.2F;

// By distance alone: of an edge without blur, a pixel's own width mixes.
constexpr float kAlphaPerPx = 0.75F;

// The mask's border lies up to a pixel outside the object: a pixel with little of the object does not look like the
// backdrop any more. So colours say where it is first and are heeded more then: standard deviations of what the
// distance says are taken for so many times what they are where edges are clear.
constexpr std::array<float, 2> kLeeway{3.0F, 1.5F};

// What one side of the border looks like near by.
struct Side {
    using Covariance = cv::Vec<float, 6>;  // of red and red, red and green, red and blue, green and green, ...
    cv::Mat3f mean;                        // linear light; 0 where nothing weighs
    cv::Mat_<Covariance> covariance;
};

// Of `colour` with `weight`, over a Gaussian neighbourhood.
Side side_of(const cv::Mat3f& colour, const cv::Mat1f& weight, double sigma_px) {
    using Moments = cv::Vec<float, 10>;
    cv::Mat_<Moments> moments(colour.size());
    for (int y = 0; y < colour.rows; ++y) {
        for (int x = 0; x < colour.cols; ++x) {
            const auto [r, g, b] = colour(y, x).val;
            moments(y, x) = Moments(1, r, g, b, r * r, r * g, r * b, g * g, g * b, b * b) * weight(y, x);
        }
    }
    cv::GaussianBlur(moments, moments, {0, 0}, sigma_px);
    Side side{cv::Mat3f(colour.size()), cv::Mat_<Side::Covariance>(colour.size())};
    for (int y = 0; y < colour.rows; ++y) {
        for (int x = 0; x < colour.cols; ++x) {
            const float sum = moments(y, x)[0];
            const Moments m = sum > 1e-6F ? moments(y, x) * (1 / sum) : Moments();
            side.mean(y, x) = {m[1], m[2], m[3]};
            side.covariance(y, x) = {m[4] - m[1] * m[1], m[5] - m[1] * m[2], m[6] - m[1] * m[3],
                                     m[7] - m[2] * m[2], m[8] - m[2] * m[3], m[9] - m[3] * m[3]};
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

// What a pixel's colour says of its alpha.
struct Reading {
    float alpha = 0;
    float variance = 0;
};

// The projection of `colour` between `backdrop` and `object` that is least led astray by how both scatter (Fisher's
// linear discriminant), where a pixel is expected to show `expected` of the object.
Reading read_alpha(const cv::Vec3f& colour, const cv::Vec3f& object, const cv::Vec3f& backdrop,
                   const Side::Covariance& of_object, const Side::Covariance& of_backdrop, float expected) {
    const cv::Vec3f span = object - backdrop;
    const Side::Covariance c = of_object * (expected * expected) + of_backdrop * ((1 - expected) * (1 - expected));
    cv::Matx33f scatter(c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5]);
    const float brightness = span.dot(cv::Vec3f(0.2126F, 0.7152F, 0.0722F));
    const cv::Vec3f chroma = kChromaDoubt * (span - cv::Vec3f::all(brightness));
    scatter += chroma * chroma.t();
    scatter += (kIndistinct * kIndistinct + kEveryDirection * (c[0] + c[3] + c[5])) * cv::Matx33f::eye();
    const cv::Vec3f direction = scatter.solve(span, cv::DECOMP_CHOLESKY);
    const float information = std::max(1e-6F, direction.dot(span));
    return {std::clamp(direction.dot(colour - backdrop) / information, 0.0F, 1.0F), 1 / information};
}

// What the distance to the border says of alpha: mean and variance, learnt where the colours of the same picture say it
// clearly. That is how much the picture blurs and how well the mask fits.
class EdgeProfile {
public:
    explicit EdgeProfile(int band_px) : bins_(static_cast<std::size_t>(4 * band_px + 1)), band_px_(band_px) {
        for (std::size_t i = 0; i < bins_.size(); ++i) {
            constexpr double kBegin = 50;  // readings
            const float distance_px = 0.5F * static_cast<float>(i) - static_cast<float>(band_px);
            const double mean = by_distance(distance_px);
            const double deviation = std::abs(distance_px) < 1 ? 0.25 : 0.1;
            bins_[i] = {kBegin, kBegin * mean, kBegin * (mean * mean + deviation * deviation), 0};
        }
    }

    static float by_distance(float distance_px) { return std::clamp(0.5F + kAlphaPerPx * distance_px, 0.0F, 1.0F); }

    void learn(float distance_px, const Reading& reading) {
        constexpr double kClearVariance = 0.05 * 0.05;
        const double weight = std::pow(1 + reading.variance / kClearVariance, -2);
        Bin& bin = bins_[bin_of(distance_px)];
        bin.weight += weight;
        bin.sum += weight * reading.alpha;
        bin.squares += weight * reading.alpha * reading.alpha;
        bin.noise += weight * reading.variance;
    }

    [[nodiscard]] Reading at(float distance_px) const {
        constexpr double kLeastVariance = 0.03 * 0.03;
        const Bin& bin = bins_[bin_of(distance_px)];
        const double mean = bin.sum / bin.weight;
        const double variance = (bin.squares - bin.noise) / bin.weight - mean * mean;
        return {static_cast<float>(mean), static_cast<float>(std::max(kLeastVariance, variance))};
    }

private:
    struct Bin {
        double weight = 0, sum = 0, squares = 0, noise = 0;
    };
    [[nodiscard]] std::size_t bin_of(float distance_px) const {
        return static_cast<std::size_t>(std::lround(2 * distance_px) + 2 * band_px_);
    }
    std::vector<Bin> bins_;  // half pixels from -band_px to band_px
    int band_px_;
};

// Below and above this alpha is taken for none and all: what remains is noise.
float snapped(float alpha) {
    constexpr float kSnap = 0.03F;
    return std::clamp((alpha - kSnap) / (1 - 2 * kSnap), 0.0F, 1.0F);
}

SoftEdge softened(const cv::Mat3f& light, const cv::Mat1b& inside, int band_px, float leeway) {
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

    struct InBand {
        int x, y;
        float distance_px;
        Reading reading;
    };
    std::vector<InBand> in_band;
    EdgeProfile profile(band_px);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            // From the border, which runs half a pixel before the first pixel of either side; positive inside.
            const float distance = inside(y, x) != 0 ? std::max(0.5F, depth_inside(y, x) - 0.5F)
                                                     : -std::max(0.5F, depth_outside(y, x) - 0.5F);
            if (std::abs(distance) >= static_cast<float>(band_px)) {
                edge.alpha(x, y) = distance > 0 ? 1.0F : 0.0F;
                continue;
            }
            const Reading reading =
                read_alpha(light(y, x), object.mean(y, x), backdrop.mean(y, x), object.covariance(y, x),
                           backdrop.covariance(y, x), EdgeProfile::by_distance(distance));
            edge.object(x, y) = rgb(object.mean(y, x));
            edge.backdrop(x, y) = rgb(backdrop.mean(y, x));
            profile.learn(distance, reading);
            in_band.push_back({x, y, distance, reading});
        }
    }
    for (const InBand& p : in_band) {
        const Reading expected = profile.at(p.distance_px);
        const float variance = leeway * leeway * expected.variance;
        const float trusted = variance / (variance + p.reading.variance);
        edge.alpha(p.x, p.y) = snapped(expected.alpha + trusted * (p.reading.alpha - expected.alpha));
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
    SoftEdge edge = softened(light, inside, band_px, kLeeway.front());
    for (std::size_t pass = 1; pass < kLeeway.size(); ++pass) {
        for (int y = 0; y < inside.rows; ++y) {
            for (int x = 0; x < inside.cols; ++x) inside(y, x) = edge.alpha(x, y) >= 0.5F ? 255 : 0;
        }
        edge = softened(light, inside, band_px, kLeeway[pass]);
    }
    return edge;
}

}  // namespace rs::capture
