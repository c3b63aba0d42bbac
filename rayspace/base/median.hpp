#pragma once
// Median of a list.

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace rs {

/// The upper median: of an even count the greater of the two middle values; 0 for an empty list. Reorders the values.
template <class T>
T median_of(std::span<T> values) {
    if (values.empty()) return T{};
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The upper median, without reordering.
template <class T>
T median(std::vector<T> values) {
    return median_of(std::span<T>(values));
}

}  // namespace rs
