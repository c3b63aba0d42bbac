#include "encode/raymap/floating_cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace rs::encode {
namespace {

constexpr double kSmallestPart = 0.0005;  // of an object, of its largest; below that depths are noise

// The islands of a grid, [across * height + down]: which of them each place belongs to, and their sizes.
class Islands {
public:
    template <class IsLand>
    Islands(int width, int height, const IsLand& is_land)
        : width_(width),
          height_(height),
          island_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), kSea) {
        for (std::size_t i = 0; i < island_.size(); ++i) island_[i] = is_land(i) ? kUnknown : kSea;
        for (std::size_t i = 0; i < island_.size(); ++i) {
            if (island_[i] == kUnknown) explore(i);
        }
    }

    [[nodiscard]] int largest() const {
        const auto found = std::max_element(sizes_.begin(), sizes_.end());
        return found == sizes_.end() ? 0 : *found;
    }
    // Of those that are not smaller than `least`.
    [[nodiscard]] int smallest(double least) const {
        int found = largest();
        for (const int size : sizes_) {
            if (size >= least) found = std::min(found, size);
        }
        return found;
    }
    // Of the island that a place belongs to; 0 where there is none.
    [[nodiscard]] int size_at(std::size_t place) const {
        return island_[place] == kSea ? 0 : sizes_[static_cast<std::size_t>(island_[place])];
    }

private:
    static constexpr int kSea = -1, kUnknown = -2;

    void explore(std::size_t begin) {
        const auto island = static_cast<int>(sizes_.size());
        int size = 0;
        const auto reach = [&](std::size_t place) {
            if (island_[place] != kUnknown) return;
            island_[place] = island;
            ++size;
            shore_.push_back(place);
        };
        const auto height = static_cast<std::size_t>(height_);
        reach(begin);
        while (!shore_.empty()) {
            const std::size_t place = shore_.back();
            shore_.pop_back();
            const std::size_t across = place / height, down = place % height;
            if (across > 0) reach(place - height);
            if (across + 1 < static_cast<std::size_t>(width_)) reach(place + height);
            if (down > 0) reach(place - 1);
            if (down + 1 < height) reach(place + 1);
        }
        sizes_.push_back(size);
    }

    int width_, height_;
    std::vector<int> island_;
    std::vector<int> sizes_;
    std::vector<std::size_t> shore_;
};

}  // namespace

void drop_beside_hull(const LineGrid& grid, const std::vector<std::uint8_t>& meets_hull, ShapeCell* cells) {
    const auto meets_nearby = [&](int p, int h) {
        for (int x = std::max(p - 1, 0); x <= std::min(p + 1, grid.p_cells - 1); ++x) {
            for (int y = std::max(h - 1, 0); y <= std::min(h + 1, grid.bands - 1); ++y) {
                if (meets_hull[static_cast<std::size_t>(x * grid.bands + y)] != 0) return true;
            }
        }
        return false;
    };
    for (int p = 0; p < grid.p_cells; ++p) {
        for (int h = 0; h < grid.bands; ++h) {
            ShapeCell& cell = cells[p * grid.bands + h];
            if (cell.has_surface() && !meets_nearby(p, h)) cell = {};
        }
    }
}

double floating_share(const Image<float>& depth) {
    const std::span<const float> depths = depth.pixels();
    const Islands islands(depth.height(), depth.width(), [&](std::size_t i) { return !std::isnan(depths[i]); });
    if (islands.largest() == 0) return kLargestFloating;
    const double largest = islands.largest();
    return std::min(kLargestFloating, islands.smallest(kSmallestPart * largest) / (2 * largest));
}

void drop_islands(const LineGrid& grid, double share, ShapeCell* cells) {
    const Islands islands(grid.p_cells, grid.bands, [&](std::size_t i) { return cells[i].has_surface(); });
    const double least = share * islands.largest();
    const std::size_t count = static_cast<std::size_t>(grid.p_cells) * static_cast<std::size_t>(grid.bands);
    for (std::size_t i = 0; i < count; ++i) {
        if (cells[i].has_surface() && islands.size_at(i) < least) cells[i] = {};
    }
}

}  // namespace rs::encode
