#include "rayspace/base/nearest_name.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace rs {
namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before, above(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) above[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, replaced});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
        }
        before = above;
        std::swap(above, row);
    }
    return above[b.size()];
}

}  // namespace

std::string nearest_name(std::string_view written, std::span<const std::string> known) {
    constexpr std::size_t kMaxLength = 64;
    if (written.size() > kMaxLength) return "";
    std::string nearest;
    std::size_t least = written.size() / 3 + 1;
    for (const std::string& name : known) {
        if (name.size() > kMaxLength) continue;
        const std::size_t distance = edit_distance(written, name);
        if (distance >= least) continue;
        least = distance;
        nearest = name;
    }
    return nearest;
}

std::string suggestion(std::string_view written, std::span<const std::string> known) {
    const std::string nearest = nearest_name(written, known);
    return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

}  // namespace rs
