#include "capture/calibration/points/descriptor_products.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <span>

namespace rs::capture {
namespace {

// Descriptors of length kDescriptorUnit, one of them with a single nonzero element.
Descriptors random_descriptors(std::size_t count, unsigned seed) {
    std::minstd_rand random(seed);
    std::exponential_distribution<double> number(1);
    Descriptors all;
    for (std::size_t i = 0; i < count; ++i) {
        std::vector<double> values(kDescriptorNumbers);
        double square = 0;
        for (double& value : values) {
            value = i == 0 ? 0 : number(random);
            square += value * value;
        }
        if (i == 0) values[5] = square = 1;
        for (const double value : values) {
            all.push_back(static_cast<std::int16_t>(std::lround(kDescriptorUnit * value / std::sqrt(square))));
        }
    }
    return all;
}

TEST(DescriptorProducts, AreThoseOfPlainLoops) {
    for (const std::size_t columns : {std::size_t{1}, std::size_t{15}, std::size_t{32}, std::size_t{33}}) {
        const Descriptors rows = random_descriptors(4, 1), with = random_descriptors(columns, 2);
        const PackedDescriptors packed(with);
        ASSERT_EQ(packed.count(), columns);
        std::vector<std::int32_t> four(4 * packed.stride(), -1), one(packed.stride(), -1);
        four_descriptor_products(rows, packed, four);
        for (std::size_t r = 0; r < 4; ++r) {
            const auto row = std::span(rows).subspan(r * kDescriptorNumbers, kDescriptorNumbers);
            descriptor_products(row, packed, one);
            for (std::size_t c = 0; c < packed.stride(); ++c) {
                std::int32_t product = 0;
                for (std::size_t k = 0; c < columns && k < kDescriptorNumbers; ++k) {
                    product += std::int32_t{row[k]} * std::int32_t{with[c * kDescriptorNumbers + k]};
                }
                EXPECT_EQ(four[r * packed.stride() + c], product);
                EXPECT_EQ(one[c], product);
                if (c >= columns) continue;
                const auto column = std::span(with).subspan(c * kDescriptorNumbers, kDescriptorNumbers);
                EXPECT_EQ(descriptor_product(row, column), product);
            }
        }
    }
}

TEST(DescriptorProducts, TheSameIsOne) {
    const Descriptors all = random_descriptors(3, 4);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto one = std::span(all).subspan(i * kDescriptorNumbers, kDescriptorNumbers);
        EXPECT_NEAR(descriptor_product(one, one), kDescriptorUnit * kDescriptorUnit,
                    0.001 * kDescriptorUnit * kDescriptorUnit);
    }
}

}  // namespace
}  // namespace rs::capture
