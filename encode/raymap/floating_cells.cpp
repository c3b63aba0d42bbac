#include "encode/raymap/shape_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace rs::encode {
namespace {

constexpr double kSmallestPart = 0.0005;  // relative to the largest component; smaller ones are noise

// The 4-connected components of a grid, [across * height + down], and their sizes.
class ConnectedComponents {
public:
    template <class IsForeground>
    ConnectedComponents(int width, int height, const IsForeground& is_foreground)
        : width_(width),
          height_(height),
          component_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), kBackground) {
        for (std::size_t i = 0; i < component_.size(); ++i) component_[i] = is_foreground(i) ? kUnknown : kBackground;
        for (std::size_t i = 0; i < component_.size(); ++i) {
            if (component_[i] == kUnknown) flood_fill(i);
        }
    }

    [[nodiscard]] int largest() const {
        const auto found = std::max_element(sizes_.begin(), sizes_.end());
        return found == sizes_.end() ? 0 : *found;
    }
    // The size of the smallest component that is not smaller than `least`.
    [[nodiscard]] int smallest(double least) const {
        int found = largest();
        for (const int size : sizes_) {
            if (size >= least) found = std::min(found, size);
        }
        return found;
    }
    // The size of the component at a place; 0 where there is none.
    [[nodiscard]] int size_at(std::size_t place) const {
        return component_[place] == kBackground ? 0 : sizes_[static_cast<std::size_t>(component_[place])];
    }

private:
    static constexpr int kBackground = -1, kUnknown = -2;

    void flood_fill(std::size_t begin) {
        const auto component = static_cast<int>(sizes_.size());
        int size = 0;
        const auto visit = [&](std::size_t place) {
            if (component_[place] != kUnknown) return;
            component_[place] = component;
            ++size;
            frontier_.push_back(place);
        };
        const auto height = static_cast<std::size_t>(height_);
        visit(begin);
        while (!frontier_.empty()) {
            const std::size_t place = frontier_.back();
            frontier_.pop_back();
            const std::size_t across = place / height, down = place % height;
            if (across > 0) visit(place - height);
            if (across + 1 < static_cast<std::size_t>(width_)) visit(place + height);
            if (down > 0) visit(place - 1);
            if (down + 1 < height) visit(place + 1);
        }
        sizes_.push_back(size);
    }

    int width_, height_;
    std::vector<int> component_;
    std::vector<int> sizes_;
    std::vector<std::size_t> frontier_;
};

}  // namespace

void remove_cells_outside_hull(const LineGrid& grid, const std::vector<std::uint8_t>& meets_hull, ShapeCell* cells) {
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
    const ConnectedComponents components(depth.height(), depth.width(),
                                         [&](std::size_t i) { return !std::isnan(depths[i]); });
    if (components.largest() == 0) return kMaxFloatingShare;
    const double largest = components.largest();
    return std::min(kMaxFloatingShare, components.smallest(kSmallestPart * largest) / (2 * largest));
}

void remove_small_components(const LineGrid& grid, double share, ShapeCell* cells) {
    const ConnectedComponents components(grid.p_cells, grid.bands,
                                         [&](std::size_t i) { return cells[i].has_surface(); });
    const double least = share * components.largest();
    const std::size_t count = static_cast<std::size_t>(grid.p_cells) * static_cast<std::size_t>(grid.bands);
    for (std::size_t i = 0; i < count; ++i) {
        if (cells[i].has_surface() && components.size_at(i) < least) cells[i] = {};
    }
}

}  // namespace rs::encode
