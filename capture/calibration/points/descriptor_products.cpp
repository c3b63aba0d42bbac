#include "capture/calibration/points/descriptor_products.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "capture/calibration/points/descriptor_products.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "rayspace/api/types/check.hpp"

#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace rs::capture::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
// Scalar version: one lane cannot hold a pair.
template <int kRows>
void products_of_rows(const std::int16_t* rows, const std::int32_t* pairs, std::size_t stride, std::int32_t* products) {
    for (std::size_t r = 0; r < std::size_t{kRows}; ++r) {
        for (std::size_t c = 0; c < stride; ++c) {
            std::int32_t sum = 0;
            for (std::size_t k = 0; k < 64; ++k) {
                std::int16_t with[2];
                std::memcpy(with, pairs + k * stride + c, sizeof with);
                const std::int16_t* const own = rows + r * kDescriptorNumbers + 2 * k;
                sum += std::int32_t{own[0]} * std::int32_t{with[0]} + std::int32_t{own[1]} * std::int32_t{with[1]};
            }
            products[r * stride + c] = sum;
        }
    }
}
#else
template <int kRows>
void products_of_rows(const std::int16_t* rows, const std::int32_t* pairs, std::size_t stride, std::int32_t* products) {
    const hn::CappedTag<std::int32_t, 16> d;
    const hn::Repartition<std::int16_t, decltype(d)> d16;
    const std::size_t lanes = hn::Lanes(d);
    constexpr std::size_t kPairs = 64;
    std::int32_t own[kRows][kPairs];
    std::memcpy(own, rows, sizeof own);
    for (std::size_t c = 0; c < stride; c += 2 * lanes) {
        // Two sums each, because Highway may keep odd and even elements apart.
        decltype(hn::Zero(d)) sum[kRows][2], rest[kRows][2];
        for (int r = 0; r < kRows; ++r) {
            for (int half = 0; half < 2; ++half) sum[r][half] = rest[r][half] = hn::Zero(d);
        }
        const std::int32_t* with = pairs + c;
        for (std::size_t k = 0; k < kPairs; ++k, with += stride) {
            const auto first = hn::BitCast(d16, hn::LoadU(d, with));
            const auto second = hn::BitCast(d16, hn::LoadU(d, with + lanes));
            for (int r = 0; r < kRows; ++r) {
                const auto pair = hn::BitCast(d16, hn::Set(d, own[r][k]));
                sum[r][0] = hn::ReorderWidenMulAccumulate(d, pair, first, sum[r][0], rest[r][0]);
                sum[r][1] = hn::ReorderWidenMulAccumulate(d, pair, second, sum[r][1], rest[r][1]);
            }
        }
        for (int r = 0; r < kRows; ++r) {
            std::int32_t* const to = products + static_cast<std::size_t>(r) * stride + c;
            hn::StoreU(hn::RearrangeToOddPlusEven(sum[r][0], rest[r][0]), d, to);
            hn::StoreU(hn::RearrangeToOddPlusEven(sum[r][1], rest[r][1]), d, to + lanes);
        }
    }
}

#endif

void products_of_one(const std::int16_t* rows, const std::int32_t* pairs, std::size_t stride, std::int32_t* products) {
    products_of_rows<1>(rows, pairs, stride, products);
}

void products_of_four(const std::int16_t* rows, const std::int32_t* pairs, std::size_t stride, std::int32_t* products) {
    products_of_rows<4>(rows, pairs, stride, products);
}

}  // namespace rs::capture::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rs::capture {

HWY_EXPORT(products_of_one);
HWY_EXPORT(products_of_four);

PackedDescriptors::PackedDescriptors(std::span<const std::int16_t> descriptors)
    : count_(descriptors.size() / kDescriptorNumbers), stride_((count_ + 31) / 32 * 32) {
    constexpr std::size_t kPairs = kDescriptorNumbers / 2;
    pairs_.resize(kPairs * stride_);
    for (std::size_t c = 0; c < count_; ++c) {
        for (std::size_t k = 0; k < kPairs; ++k) {
            std::memcpy(&pairs_[k * stride_ + c], &descriptors[c * kDescriptorNumbers + 2 * k], sizeof(std::int32_t));
        }
    }
}

void descriptor_products(std::span<const std::int16_t> descriptor, const PackedDescriptors& with,
                         std::span<std::int32_t> products) {
    RS_CHECK(descriptor.size() == kDescriptorNumbers && products.size() >= with.stride());
    HWY_DYNAMIC_DISPATCH(products_of_one)(descriptor.data(), with.pair(0), with.stride(), products.data());
}

void four_descriptor_products(std::span<const std::int16_t> four, const PackedDescriptors& with,
                              std::span<std::int32_t> products) {
    RS_CHECK(four.size() == 4 * kDescriptorNumbers && products.size() >= 4 * with.stride());
    HWY_DYNAMIC_DISPATCH(products_of_four)(four.data(), with.pair(0), with.stride(), products.data());
}

std::int32_t descriptor_product(std::span<const std::int16_t> a, std::span<const std::int16_t> b) {
    RS_CHECK(a.size() == kDescriptorNumbers && b.size() == kDescriptorNumbers);
    std::int32_t product = 0;
    for (std::size_t k = 0; k < kDescriptorNumbers; ++k) product += std::int32_t{a[k]} * std::int32_t{b[k]};
    return product;
}

}  // namespace rs::capture
#endif  // HWY_ONCE
