#pragma once
// How alike features are: the products of all descriptors of one view with all of another, in whole numbers, so that
// they are the same on every machine.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::capture {

inline constexpr std::size_t kDescriptorNumbers = 128;
inline constexpr int kDescriptorUnit =
    4096;  // a descriptor's length; the product of two that are the same is its square

// One descriptor after the other.
using Descriptors = std::vector<std::int16_t>;

// Descriptors as the right side of products: numbers 2 k and 2 k + 1 of feature c stand at pair(k)[c].
class PackedDescriptors {
public:
    explicit PackedDescriptors(std::span<const std::int16_t> descriptors);
    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] std::size_t stride() const { return stride_; }  // count() and at most 31 more, which are 0
    [[nodiscard]] const std::int32_t* pair(std::size_t k) const { return pairs_.data() + k * stride_; }

private:
    std::size_t count_ = 0, stride_ = 0;
    std::vector<std::int32_t> pairs_;
};

// products[c], of one descriptor with all; stride() of them.
void descriptor_products(std::span<const std::int16_t> descriptor, const PackedDescriptors& with,
                         std::span<std::int32_t> products);

// Four descriptors, one after the other, at a time: products[r * stride() + c].
void four_descriptor_products(std::span<const std::int16_t> four, const PackedDescriptors& with,
                              std::span<std::int32_t> products);

// Of one with one.
std::int32_t descriptor_product(std::span<const std::int16_t> a, std::span<const std::int16_t> b);

}  // namespace rs::capture
