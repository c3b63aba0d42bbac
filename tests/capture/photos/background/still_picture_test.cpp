#include "capture/photos/background/still_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

namespace rs::capture {
namespace {

struct Agreed {
    Rgba8 mean;
    std::size_t size = 0;
};

// The largest group of values that agree with one of them, the first such one.
Agreed plainly_agreed(const std::vector<Rgba8>& values) {
    std::vector<Rgba8> largest;
    for (const Rgba8& value : values) {
        std::vector<Rgba8> group;
        std::copy_if(values.begin(), values.end(), std::back_inserter(group),
                     [&](const Rgba8& other) { return samples_agree(value, other); });
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

TEST(AgreeOverTime, FindsTheLargestGroupOfEachPixel) {
    std::mt19937 random(11);
    for (const std::size_t count : {1U, 2U, 7U, 16U, 33U}) {
        std::vector<Image<Rgba8>> pictures;
        for (std::size_t i = 0; i < count; ++i) {
            Image<Rgba8> picture(9, 5);
            for (Rgba8& p : picture.pixels()) {
                const auto code = [&] { return static_cast<std::uint8_t>(random() % 2 * 120 + random() % 40); };
                p = {code(), code(), code(), 255};
            }
            pictures.push_back(std::move(picture));
        }
        const EvenedSamples samples(pictures);
        const StillPicture still = agree_over_time(samples);
        for (int y = 0; y < 5; ++y) {
            for (int x = 0; x < 9; ++x) {
                std::vector<Rgba8> values;
                for (std::size_t i = 0; i < count; ++i) values.push_back(samples.smooth(i, x, y));
                const Agreed plain = plainly_agreed(values);
                EXPECT_EQ(still.colour(x, y), plain.mean);
                EXPECT_EQ(still.agreement(x, y), static_cast<float>(plain.size) / static_cast<float>(count));
            }
        }
    }
}

}  // namespace
}  // namespace rs::capture
