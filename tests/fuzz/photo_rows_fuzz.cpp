#include "capture/photos/intake/photo_rows.hpp"
#include "rayspace/api/types/check.hpp"
#include "tests/fuzz/entries.hpp"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace rs::fuzz {

int fuzz_photo_rows(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t kMaxNames = 500;
    std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
    std::vector<std::string> names;
    for (std::string line; names.size() < kMaxNames && std::getline(lines, line);) names.push_back(line);
    const auto rows = capture::rows_by_name(names);
    if (rows.empty()) return 0;
    // Each photo is in one row.
    RS_CHECK(rows.size() >= 2);
    std::vector<std::size_t> photos;
    for (const capture::PhotoRow& row : rows) {
        RS_CHECK(!row.label.empty() && !row.photos.empty());
        photos.insert(photos.end(), row.photos.begin(), row.photos.end());
    }
    std::ranges::sort(photos);
    RS_CHECK(photos.size() == names.size());
    for (std::size_t i = 0; i < photos.size(); ++i) RS_CHECK(photos[i] == i);
    return 0;
}

}  // namespace rs::fuzz
