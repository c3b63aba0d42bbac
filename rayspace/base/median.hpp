#pragma once
// The middle of some numbers.

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace rs {

// The upper median: of an even count the greater of the two in the middle; 0 of none. The values change places.
template <class T>
T median_of(std::span<T> values) {
    if (values.empty()) return T{};
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// The same of values that stay as they are.
template <class T>
T median(std::vector<T> values) {
    return median_of(std::span<T>(values));
}

}  // namespace rs
