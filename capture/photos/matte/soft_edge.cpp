#include "capture/photos/matte/soft_edge.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/matte/band_sides.hpp"

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

// Photographs keep colours at half the resolution of their brightness: colour alone shows alpha to within this.
constexpr float kChromaDoubt = 0.2F;

// By distance alone: of an edge without blur, a pixel's own width mixes.
constexpr float kAlphaPerPx = 0.75F;

// The mask's border lies up to a pixel outside the object: a pixel with little of the object does not look like the
// backdrop any more. So colours show where it is first and count more then: standard deviations of what the
// distance says are taken for so many times what they are where edges are clear.
constexpr std::array<float, 2> kLeeway{3.0F, 1.5F};

// In px from the border, which runs half a pixel before the first pixel of either side; positive inside. Exact to
// `farthest_px`, beyond that any number beyond.
cv::Mat1f signed_distance(const cv::Mat1b& inside, int farthest_px) {
    cv::Mat1f distance(inside.size(), -static_cast<float>(farthest_px + 1));
    const cv::Rect near = box_around(inside, farthest_px + 2);
    if (near.empty()) return distance;
    const cv::Mat1b part = inside(near);
    cv::Mat1b outside;
    cv::bitwise_not(part, outside);
    cv::Mat1f within, beyond;  // to the nearest pixel of the other side
    cv::distanceTransform(part, within, cv::DIST_L2, cv::DIST_MASK_5);
    cv::distanceTransform(outside, beyond, cv::DIST_L2, cv::DIST_MASK_5);
    for (int y = 0; y < near.height; ++y) {
        for (int x = 0; x < near.width; ++x) {
            distance(near.y + y, near.x + x) =
                part(y, x) != 0 ? std::max(0.5F, within(y, x) - 0.5F) : -std::max(0.5F, beyond(y, x) - 0.5F);
        }
    }
    return distance;
}

LinearRgb rgb(const cv::Vec3f& v) {
    return {v[0], v[1], v[2]};
}

// What a pixel's colour shows of its alpha.
struct AlphaReading {
    float alpha = 0;
    float variance = 0;
};

// The projection of `colour` between `backdrop` and `object` that is least led astray by how both scatter (Fisher's
// linear discriminant), where a pixel is expected to show `expected` of the object.
AlphaReading read_alpha(const cv::Vec3f& colour, const cv::Vec3f& object, const cv::Vec3f& backdrop,
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

    void learn(float distance_px, const AlphaReading& reading) {
        constexpr double kClearVariance = 0.05 * 0.05;
        const double weight = std::pow(1 + reading.variance / kClearVariance, -2);
        Bin& bin = bins_[bin_of(distance_px)];
        bin.weight += weight;
        bin.sum += weight * reading.alpha;
        bin.squares += weight * reading.alpha * reading.alpha;
        bin.noise += weight * reading.variance;
    }

    [[nodiscard]] AlphaReading at(float distance_px) const {
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

struct InBand {
    int x, y;
    float distance_px;
    AlphaReading reading;
};

SoftEdge softened(const cv::Mat3f& light, const cv::Mat1b& inside, int band_px, float leeway) {
    SoftEdge edge{Image<float>(light.cols, light.rows), Image<LinearRgb>(light.cols, light.rows),
                  Image<LinearRgb>(light.cols, light.rows)};
    const cv::Mat1f distance = signed_distance(inside, band_px + 1);
    for (int y = 0; y < light.rows; ++y) {
        for (int x = 0; x < light.cols; ++x) edge.alpha(x, y) = distance(y, x) > 0 ? 1.0F : 0.0F;
    }
    std::vector<InBand> in_band;
    for_each_in_band(light, distance, band_px, [&](int x, int y, const Side& object, const Side& backdrop) {
        const AlphaReading reading = read_alpha(light(y, x), object.mean, backdrop.mean, object.covariance,
                                                backdrop.covariance, EdgeProfile::by_distance(distance(y, x)));
        edge.object(x, y) = rgb(object.mean);
        edge.backdrop(x, y) = rgb(backdrop.mean);
        in_band.push_back({x, y, distance(y, x), reading});
    });
    EdgeProfile profile(band_px);
    for (const InBand& p : in_band) profile.learn(p.distance_px, p.reading);
    for (const InBand& p : in_band) {
        const AlphaReading expected = profile.at(p.distance_px);
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
    cv::Mat1b inside = mat_over(mask).clone();
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
