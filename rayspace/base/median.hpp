#pragma once
// The middle of some numbers.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace rs {

// The upper median: of an even count the greater of the two in the middle; 0 of none. Thread-safe.
template <class T>
T median(std::vector<T> values) {
    if (values.empty()) return T{};
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace rs
