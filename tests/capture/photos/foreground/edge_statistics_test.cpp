#include "capture/photos/foreground/edge_statistics.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <random>

namespace rs::capture {
namespace {

constexpr float kMixedWeight = 0.02F;

// Reference: the Gaussian window over the whole image, by OpenCV.
struct ReferenceStatistics {
    cv::Mat_<cv::Vec<float, 10>> moments;

    ReferenceStatistics(const cv::Mat3f& light, const cv::Mat1f& distance, int band_px, bool foreground)
        : moments(light.size()) {
        for (int y = 0; y < light.rows; ++y) {
            for (int x = 0; x < light.cols; ++x) {
                const auto [r, g, b] = light(y, x).val;
                const bool of_this_side = (distance(y, x) > 0) == foreground;
                moments(y, x) = cv::Vec<float, 10>(1, r, g, b, r * r, r * g, r * b, g * g, g * b, b * b) *
                                (of_this_side ? purity_weight(distance(y, x), band_px, kMixedWeight) : 0.0F);
            }
        }
        cv::GaussianBlur(moments, moments, {0, 0}, band_px + 1.0);
    }
    [[nodiscard]] ColourStatistics at(int x, int y) const {
        if (!(moments(y, x)[0] > 1e-6F)) return {};
        const cv::Vec<float, 10> m = moments(y, x) * (1 / moments(y, x)[0]);
        return {{m[1], m[2], m[3]},
                {m[4] - m[1] * m[1], m[5] - m[1] * m[2], m[6] - m[1] * m[3], m[7] - m[2] * m[2], m[8] - m[2] * m[3],
                 m[9] - m[3] * m[3]}};
    }
};

class EdgeStatistics : public testing::TestWithParam<cv::Size> {};

TEST_P(EdgeStatistics, EqualTheGaussianFilteredImage) {
    constexpr int kBand_px = 3;
    const cv::Size size = GetParam();
    std::minstd_rand random(2);
    std::uniform_real_distribution<float> value(0, 1);
    cv::Mat3f light(size);
    cv::Mat1f distance(size);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            light(y, x) = {value(random), value(random), 0.3F * value(random)};
            // The contour also touches the image border.
            const auto inside = static_cast<float>(0.35 * size.width - std::hypot(x - 0.3 * size.width, y - 4.0));
            distance(y, x) = inside > 0 ? std::max(0.5F, inside) : std::min(-0.5F, inside);
        }
    }
    const ReferenceStatistics foreground_reference(light, distance, kBand_px, true),
        background_reference(light, distance, kBand_px, false);
    int visited = 0, last = -1;
    const auto compare = [&](int x, int y, const ColourStatistics& foreground, const ColourStatistics& background) {
        EXPECT_LT(std::abs(distance(y, x)), kBand_px);
        EXPECT_GT(y * size.width + x, last);
        last = y * size.width + x;
        ++visited;
        const ColourStatistics expected[2]{foreground_reference.at(x, y), background_reference.at(x, y)};
        const ColourStatistics* const found[2]{&foreground, &background};
        for (int side = 0; side < 2; ++side) {
            EXPECT_LT(cv::norm(found[side]->mean - expected[side].mean), 1e-4) << x << ", " << y;
            EXPECT_LT(cv::norm(found[side]->covariance - expected[side].covariance), 1e-4) << x << ", " << y;
        }
    };
    for_each_band_pixel(light, distance, kBand_px, kMixedWeight, compare);
    int in_band = 0;
    for (const float d : distance) in_band += std::abs(d) < kBand_px ? 1 : 0;
    EXPECT_EQ(visited, in_band);
    EXPECT_GT(visited, 30);
}

// Smaller and larger than the window.
INSTANTIATE_TEST_SUITE_P(Sizes, EdgeStatistics, testing::Values(cv::Size(40, 12), cv::Size(90, 70)));

}  // namespace
}  // namespace rs::capture
