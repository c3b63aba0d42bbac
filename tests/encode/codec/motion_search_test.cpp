// Compares the motion search with an exhaustive search.

#include "encode/codec/motion_search.hpp"

#include "encode/codec/encoder_images.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <vector>

namespace rs::encode {
namespace {

using codec::MotionVector;

// Smooth waves with noise; partly transparent.
Image<Rgba8> waves(double phase, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    Image<Rgba8> image(64, 48);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const double light = 120 + 50 * std::sin(0.3 * x + phase) + 40 * std::cos(0.21 * y - 0.1 * x);
            const auto code = static_cast<std::uint8_t>(light + static_cast<double>(random() % 9));
            image(x, y) = {code, code, code, static_cast<std::uint8_t>(x + y < 40 ? 0 : 255)};
        }
    }
    return image;
}

float bits_of(MotionVector vector, MotionVector from) {
    float bits = 0;
    for (const int off : {vector.x - from.x, vector.y - from.y}) {
        bits +=
            off == 0 ? 1.0F : 2.0F * static_cast<float>(std::bit_width(static_cast<unsigned>(std::abs(off)))) + 1.0F;
    }
    return bits;
}

// Cost of one vector: prediction by the codec over valid samples, averaged with `other` if given.
float cost_of(const MotionSearch& search, MotionVector vector, MotionVector from, const std::uint8_t* other) {
    std::vector<std::uint8_t> samples(static_cast<std::size_t>(search.size) * static_cast<std::size_t>(search.size));
    codec::predict_from_image(search.reference, search.x, search.y, vector, search.size, samples.data(), search.size);
    int sum = 0;
    for (int y = 0; y < search.size; ++y) {
        for (int x = 0; x < search.size; ++x) {
            if (search.source->valid(search.x + x, search.y + y) == 0) continue;
            const auto i = static_cast<std::size_t>(y * search.size + x);
            const int predicted = other == nullptr ? samples[i] : (samples[i] + other[i] + 1) / 2;
            sum += std::abs(search.source->planes[0](search.x + x, search.y + y) - predicted);
        }
    }
    return static_cast<float>(sum) + search.bit_cost * bits_of(vector, from);
}

class MotionSearchTest : public ::testing::TestWithParam<int> {
protected:
    MotionSearchTest() : source_(source_image(waves(0.4, 1), 8)), reference_(source_image(waves(0, 2), 8)) {
        search_ = {.source = &source_,
                   .reference = reference_.planes[0],
                   .x = 16,
                   .y = 16,
                   .size = GetParam(),
                   .reach_x = 6,
                   .reach_y = 3,
                   .fractions = false,
                   .bit_cost = 3};
    }
    SourceImage source_;
    SourceImage reference_;
    MotionSearch search_;
};

TEST_P(MotionSearchTest, NoWholeVectorInReachIsBetter) {
    const std::vector<std::uint8_t> other(256, 128);
    const MotionVector from{5, -3};
    for (const std::uint8_t* mixed : {static_cast<const std::uint8_t*>(nullptr), other.data()}) {
        for (const MotionVector start : {MotionVector{0, 0}, MotionVector{9, -6}, MotionVector{-64, 0}}) {
            const MotionMatch found = search_motion(search_, std::vector{start}, from, mixed);
            float least = std::numeric_limits<float>::infinity();
            const int x0 = (start.x + 2) >> 2;
            const int y0 = (start.y + 2) >> 2;
            for (int y = y0 - search_.reach_y; y <= y0 + search_.reach_y; ++y) {
                for (int x = x0 - search_.reach_x; x <= x0 + search_.reach_x; ++x) {
                    // Only positions inside of the image.
                    if (search_.x + x < 0 || search_.y + y < 0 ||
                        search_.x + x + search_.size > search_.reference.width() ||
                        search_.y + y + search_.size > search_.reference.height()) {
                        continue;
                    }
                    const MotionVector vector{static_cast<std::int16_t>(4 * x), static_cast<std::int16_t>(4 * y)};
                    least = std::min(least, cost_of(search_, vector, from, mixed));
                }
            }
            EXPECT_EQ(found.cost, least);
            EXPECT_EQ(cost_of(search_, found.vector, from, mixed), least);
        }
    }
}

TEST_P(MotionSearchTest, AQuarterOfASampleIsFound) {
    search_.fractions = true;
    search_.bit_cost = 0;
    for (const MotionVector truth : {MotionVector{7, -5}, MotionVector{-9, 2}, MotionVector{4, 8}}) {
        SourceImage moved = source_;
        search_.source = &moved;
        Image<std::uint8_t>& y_plane = moved.planes[0];
        codec::predict_from_image(search_.reference, search_.x, search_.y, truth, search_.size,
                                  y_plane.row(search_.y) + search_.x, y_plane.view().stride());
        const MotionMatch found = search_motion(search_, std::vector{MotionVector{0, 0}}, {0, 0});
        EXPECT_EQ(found.vector, truth);
        EXPECT_EQ(found.cost, 0);
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, MotionSearchTest, ::testing::Values(8, 16),
                         [](const auto& size) { return "Of" + std::to_string(size.param); });

}  // namespace
}  // namespace rs::encode
