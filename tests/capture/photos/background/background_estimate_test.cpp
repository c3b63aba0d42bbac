#include "capture/photos/background/background_estimate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

namespace rs::capture {
namespace {

struct Group {
    Rgba8 mean;
    std::size_t size = 0;
};

constexpr BackgroundParameters::Estimate kEstimateParameters{};

// Direct implementation: the largest group of values that agree with one of them, the first of equally large ones.
Group largest_group(const std::vector<Rgba8>& values) {
    std::vector<Rgba8> largest;
    for (const Rgba8& value : values) {
        std::vector<Rgba8> group;
        std::copy_if(values.begin(), values.end(), std::back_inserter(group), [&](const Rgba8& other) {
            return within_codes(value, other, kEstimateParameters.tolerance_codes);
        });
        if (group.size() > largest.size()) largest = group;
    }
    std::array<std::size_t, 3> sum{};
    for (const Rgba8& each : largest) {
        sum[0] += each.r;
        sum[1] += each.g;
        sum[2] += each.b;
    }
    const std::size_t n = largest.size();
    const auto mean = [&](std::size_t s) { return static_cast<std::uint8_t>((s + n / 2) / n); };
    return {{mean(sum[0]), mean(sum[1]), mean(sum[2]), 255}, n};
}

TEST(TemporalConsensus, EqualsDirectImplementation) {
    std::mt19937 random(11);
    for (const std::size_t count : {1U, 2U, 7U, 16U, 33U}) {
        std::vector<Image<Rgba8>> images;
        for (std::size_t i = 0; i < count; ++i) {
            Image<Rgba8> image(9, 5);
            for (Rgba8& p : image.pixels()) {
                const auto code = [&] { return static_cast<std::uint8_t>(random() % 2 * 120 + random() % 40); };
                p = {code(), code(), code(), 255};
            }
            images.push_back(std::move(image));
        }
        const ExposureNormalizedFrames frames(images);
        const BackgroundEstimate background = temporal_consensus(frames, kEstimateParameters);
        for (int y = 0; y < 5; ++y) {
            for (int x = 0; x < 9; ++x) {
                std::vector<Rgba8> values;
                for (std::size_t i = 0; i < count; ++i) values.push_back(frames.smooth(i, x, y));
                const Group expected = largest_group(values);
                EXPECT_EQ(background.colour(x, y), expected.mean);
                EXPECT_EQ(background.agreement(x, y), static_cast<float>(expected.size) / static_cast<float>(count));
            }
        }
    }
}

}  // namespace
}  // namespace rs::capture
