#pragma once
// Similarity of features: inner products of all descriptors of one view with all of another, in integers, so that
// results are the same on every machine.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::capture {

inline constexpr std::size_t kDescriptorNumbers = 128;
inline constexpr int kDescriptorUnit = 4096;  // length of a descriptor; the product of two equal ones is its square

/// Descriptors, kDescriptorNumbers integers each, one after the other.
using Descriptors = std::vector<std::int16_t>;

/// Descriptors in the layout of the right factor: elements 2 k and 2 k + 1 of feature c are packed in pair(k)[c].
class PackedDescriptors {
public:
    explicit PackedDescriptors(std::span<const std::int16_t> descriptors);
    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] std::size_t stride() const { return stride_; }  // count() padded with at most 31 zero columns
    [[nodiscard]] const std::int32_t* pair(std::size_t k) const { return pairs_.data() + k * stride_; }

private:
    std::size_t count_ = 0, stride_ = 0;
    std::vector<std::int32_t> pairs_;
};

/// Inner products of one descriptor with all: products[c], stride() of them.
void descriptor_products(std::span<const std::int16_t> descriptor, const PackedDescriptors& with,
                         std::span<std::int32_t> products);

/// The same for four consecutive descriptors: products[r * stride() + c].
void four_descriptor_products(std::span<const std::int16_t> four, const PackedDescriptors& with,
                              std::span<std::int32_t> products);

/// Inner product of two descriptors.
std::int32_t descriptor_product(std::span<const std::int16_t> a, std::span<const std::int16_t> b);

}  // namespace rs::capture
