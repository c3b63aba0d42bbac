#include "capture/photos/foreground/alpha_estimation.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/foreground/edge_statistics.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rs::capture {
namespace {

using Alpha = ForegroundParameters::Alpha;

// Distance in px from the contour, which runs between the pixels of both sides; positive inside. Correct up to
// `max_px`; beyond that the magnitude is only known to be larger.
cv::Mat1f signed_distance(const cv::Mat1b& inside, int max_px) {
    cv::Mat1f distance(inside.size(), -static_cast<float>(max_px + 1));
    const cv::Rect near = padded_bounding_box(inside, max_px + 2);
    if (near.empty()) return distance;
    const cv::Mat1b part = inside(near);
    cv::Mat1b outside;
    cv::bitwise_not(part, outside);
    cv::Mat1f to_outside, to_inside;
    cv::distanceTransform(part, to_outside, cv::DIST_L2, cv::DIST_MASK_5);
    cv::distanceTransform(outside, to_inside, cv::DIST_L2, cv::DIST_MASK_5);
    for (int y = 0; y < near.height; ++y) {
        for (int x = 0; x < near.width; ++x) {
            distance(near.y + y, near.x + x) =
                part(y, x) != 0 ? std::max(0.5F, to_outside(y, x) - 0.5F) : -std::max(0.5F, to_inside(y, x) - 0.5F);
        }
    }
    return distance;
}

LinearRgb rgb(const cv::Vec3f& v) {
    return {v[0], v[1], v[2]};
}

struct AlphaMeasurement {
    float alpha = 0;
    float variance = 0;
};

// Projects `colour` on the axis from background to foreground by Fisher's linear discriminant: direction S^-1 (F - B),
// where S is the colour covariance expected at alpha `expected`. The variance is that of the projection, 1 / (F - B)^T
// S^-1 (F - B).
AlphaMeasurement measure_alpha(const cv::Vec3f& colour, const ColourStatistics& foreground,
                               const ColourStatistics& background, float expected, const Alpha& parameters) {
    const cv::Vec3f span = foreground.mean - background.mean;
    const ColourStatistics::Covariance c =
        foreground.covariance * (expected * expected) + background.covariance * ((1 - expected) * (1 - expected));
    cv::Matx33f scatter(c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5]);
    const float luminance = span.dot(cv::Vec3f(0.2126F, 0.7152F, 0.0722F));
    const cv::Vec3f chroma = parameters.chroma_sigma * (span - cv::Vec3f::all(luminance));
    scatter += chroma * chroma.t();
    scatter += (parameters.colour_sigma * parameters.colour_sigma + parameters.isotropic_share * (c[0] + c[3] + c[5])) *
               cv::Matx33f::eye();
    const cv::Vec3f direction = scatter.solve(span, cv::DECOMP_CHOLESKY);
    const float information = std::max(1e-6F, direction.dot(span));
    return {std::clamp(direction.dot(colour - background.mean) / information, 0.0F, 1.0F), 1 / information};
}

// Alpha of an edge without blur at a signed distance from the contour.
float prior_alpha(float distance_px, const Alpha& parameters) {
    return std::clamp(0.5F + parameters.alpha_per_px * distance_px, 0.0F, 1.0F);
}

// Mean and variance of alpha by signed distance from the contour, in bins of half a pixel. Starts from the prior and is
// learnt from the measurements of small variance of one photo: represents its blur and the mask's accuracy.
class EdgeProfile {
public:
    EdgeProfile(int band_px, const Alpha& parameters)
        : bins_(static_cast<std::size_t>(4 * band_px + 1)), band_px_(band_px), parameters_(parameters) {
        for (std::size_t i = 0; i < bins_.size(); ++i) {
            const float distance_px = 0.5F * static_cast<float>(i) - static_cast<float>(band_px);
            const double mean = prior_alpha(distance_px, parameters);
            const double sigma = std::abs(distance_px) < 1 ? parameters.prior_sigma_at_contour : parameters.prior_sigma;
            const double weight = parameters.prior_weight;
            bins_[i] = {weight, weight * mean, weight * (mean * mean + sigma * sigma), 0};
        }
    }

    void learn(float distance_px, const AlphaMeasurement& measurement) {
        const double clear_variance = parameters_.clear_sigma * parameters_.clear_sigma;
        const double weight = std::pow(1 + measurement.variance / clear_variance, -2);
        Bin& bin = bins_[bin_of(distance_px)];
        bin.weight += weight;
        bin.sum += weight * measurement.alpha;
        bin.squares += weight * measurement.alpha * measurement.alpha;
        bin.noise += weight * measurement.variance;
    }

    [[nodiscard]] AlphaMeasurement at(float distance_px) const {
        const double min_variance = parameters_.min_profile_sigma * parameters_.min_profile_sigma;
        const Bin& bin = bins_[bin_of(distance_px)];
        const double mean = bin.sum / bin.weight;
        const double variance = (bin.squares - bin.noise) / bin.weight - mean * mean;
        return {static_cast<float>(mean), static_cast<float>(std::max(min_variance, variance))};
    }

private:
    struct Bin {
        double weight = 0, sum = 0, squares = 0, noise = 0;
    };
    [[nodiscard]] std::size_t bin_of(float distance_px) const {
        return static_cast<std::size_t>(std::lround(2 * distance_px) + 2 * band_px_);
    }
    std::vector<Bin> bins_;  // distances -band_px to band_px
    int band_px_;
    const Alpha& parameters_;
};

// Maps [noise, 1 - noise] to 0..1 and clamps.
float without_noise(float alpha, float noise) {
    return std::clamp((alpha - noise) / (1 - 2 * noise), 0.0F, 1.0F);
}

struct BandPixel {
    int x, y;
    float distance_px;
    AlphaMeasurement measurement;
};

// One pass. `profile_sigma_factor` scales the standard deviation of the edge profile.
AlphaEstimate estimate_once(const cv::Mat3f& light, const cv::Mat1b& inside, int band_px, float profile_sigma_factor,
                            const Alpha& parameters) {
    AlphaEstimate estimate{Image<float>(light.cols, light.rows), Image<LinearRgb>(light.cols, light.rows),
                           Image<LinearRgb>(light.cols, light.rows)};
    const cv::Mat1f distance = signed_distance(inside, band_px + 1);
    for (int y = 0; y < light.rows; ++y) {
        for (int x = 0; x < light.cols; ++x) estimate.alpha(x, y) = distance(y, x) > 0 ? 1.0F : 0.0F;
    }
    std::vector<BandPixel> band;
    const auto measure = [&](int x, int y, const ColourStatistics& foreground, const ColourStatistics& background) {
        const float expected = prior_alpha(distance(y, x), parameters);
        estimate.foreground(x, y) = rgb(foreground.mean);
        estimate.background(x, y) = rgb(background.mean);
        band.push_back(
            {x, y, distance(y, x), measure_alpha(light(y, x), foreground, background, expected, parameters)});
    };
    for_each_band_pixel(light, distance, band_px, parameters.mixed_weight, measure);
    EdgeProfile profile(band_px, parameters);
    for (const BandPixel& p : band) profile.learn(p.distance_px, p.measurement);
    for (const BandPixel& p : band) {
        const AlphaMeasurement expected = profile.at(p.distance_px);
        const float variance = profile_sigma_factor * profile_sigma_factor * expected.variance;
        const float gain = variance / (variance + p.measurement.variance);
        estimate.alpha(p.x, p.y) =
            without_noise(expected.alpha + gain * (p.measurement.alpha - expected.alpha), parameters.alpha_noise);
    }
    return estimate;
}

}  // namespace

int expected_edge_width_px(int width, int height, const Alpha& parameters) {
    const int rounded = (std::max(width, height) + parameters.side_per_band_px / 2) / parameters.side_per_band_px;
    return std::clamp(rounded, parameters.min_band_px, parameters.max_band_px);
}

AlphaEstimate estimate_alpha(ConstImageView<Rgba8> photo, ConstImageView<std::uint8_t> mask, int band_px,
                             const Alpha& parameters) {
    RS_CHECK(photo.width() == mask.width() && photo.height() == mask.height() && band_px >= 1 && band_px <= 16);
    const int width = photo.width();
    const int height = photo.height();
    if (width == 0 || height == 0)
        return {Image<float>(width, height), Image<LinearRgb>(width, height), Image<LinearRgb>(width, height)};
    const cv::Mat3f light = linear_mat(photo);
    cv::Mat1b inside = mat_view(mask).clone();
    const auto& factors = parameters.profile_sigma_factors;
    AlphaEstimate estimate = estimate_once(light, inside, band_px, factors.front(), parameters);
    for (std::size_t pass = 1; pass < factors.size(); ++pass) {
        for (int y = 0; y < inside.rows; ++y) {
            for (int x = 0; x < inside.cols; ++x) inside(y, x) = estimate.alpha(x, y) >= 0.5F ? 255 : 0;
        }
        estimate = estimate_once(light, inside, band_px, factors[pass], parameters);
    }
    return estimate;
}

}  // namespace rs::capture
