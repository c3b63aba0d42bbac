#include "rayspace/format/shape_coding.hpp"

#include "rayspace/base/check.hpp"

#include <algorithm>
#include <array>

namespace rs::shape_coding {
namespace {

constexpr int kNone = -1;

template <class Cell>  // ShapeCell, const or not
auto& depth_in(Cell& cell, Depth depth) {
    return depth == Depth::kBack ? cell.back : cell.depth;
}

// The depths around one cell of the map, by their distance from it in lines, in p and in bands; kNone: no such cell, or
// it lacks the depth.
class Neighbourhood {
public:
    Neighbourhood(const ShapeMap& shape, Depth depth)
        : shape_(shape),
          depth_(depth),
          p_cells_(shape.p_cells),
          bands_(shape.bands),
          line_stride_(std::ptrdiff_t{shape.p_cells} * shape.bands) {}

    // Call for every cell of the map in its order.
    void go_to_next() {
        ++index_;
        if (++band_ < bands_) return;
        band_ = 0;
        if (++p_ < p_cells_) return;
        p_ = 0;
        ++line_;
    }
    [[nodiscard]] std::size_t index() const { return static_cast<std::size_t>(index_); }

    [[nodiscard]] int at(int line_step, int p_step, int band_step) const {
        const int p = p_ + p_step;
        const int band = band_ + band_step;
        if (line_ + line_step < 0 || p < 0 || p >= p_cells_ || band < 0 || band >= bands_) return kNone;
        const std::ptrdiff_t index = index_ + line_step * line_stride_ + std::ptrdiff_t{p_step} * bands_ + band_step;
        const ShapeCell& cell = shape_.cells[static_cast<std::size_t>(index)];
        return cell.has_surface() ? depth_in(cell, depth_) : kNone;
    }

private:
    const ShapeMap& shape_;
    Depth depth_;
    int p_cells_;
    int bands_;
    std::ptrdiff_t line_stride_;
    std::ptrdiff_t index_ = 0;
    int line_ = 0;
    int p_ = 0;
    int band_ = 0;
};

// The median of what the neighbours suggest, each by itself or by the slope of a surface through three of them. Looks
// only at cells that stand before this one.
std::uint8_t predict(const Neighbourhood& around) {
    constexpr int kWithoutNeighbours = 128;
    std::array<int, 9> candidates{};
    std::size_t count = 0;
    const auto suggest = [&](int value) {
        if (value != kNone) candidates[count++] = value;
    };
    // From `a`, as much as `to` differs from `from`.
    const auto suggest_slope = [&](int a, int to, int from) {
        if (a != kNone && to != kNone && from != kNone) candidates[count++] = std::clamp(a + to - from, 0, 255);
    };
    const int below = around.at(0, 0, -1);
    const int beside = around.at(0, -1, 0);
    const int beside_below = around.at(0, -1, -1);
    const int beside_above = around.at(0, -1, 1);
    const int before = around.at(-1, 0, 0);
    const int before_below = around.at(-1, 0, -1);
    const int before_beside = around.at(-1, -1, 0);
    const int before_beside_above = around.at(-1, -1, 1);
    const int before_far = around.at(-1, 1, 0);
    const int before_far_below = around.at(-1, 1, -1);
    suggest(below);
    suggest(beside);
    suggest(before);
    suggest_slope(below, beside, beside_below);
    suggest_slope(below, beside_above, beside);
    suggest_slope(before, below, before_below);
    suggest_slope(before, beside, before_beside);
    suggest_slope(before, beside_above, before_beside_above);
    suggest_slope(below, before_far, before_far_below);
    if (count == 0) return kWithoutNeighbours;
    std::sort(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(count));
    return static_cast<std::uint8_t>((candidates[(count - 1) / 2] + candidates[count / 2]) / 2);
}

}  // namespace

std::size_t surfaces_of(const ShapeMap& shape) {
    return static_cast<std::size_t>(std::count_if(shape.cells.begin(), shape.cells.end(),
                                                  [](const ShapeCell& cell) { return cell.has_surface(); }));
}

std::vector<std::uint8_t> surface_plane(const ShapeMap& shape) {
    std::vector<std::uint8_t> plane(surface_plane_bytes(shape.cells.size()));
    for (std::size_t i = 0; i < shape.cells.size(); ++i) {
        const unsigned bit = shape.cells[i].has_surface() ? 1 : 0;
        plane[i / 8] = static_cast<std::uint8_t>(plane[i / 8] | bit << (i % 8));
    }
    return plane;
}

std::vector<std::uint8_t> residual_plane(const ShapeMap& shape, Depth depth) {
    std::vector<std::uint8_t> plane;
    plane.reserve(surfaces_of(shape));
    Neighbourhood around(shape, depth);
    for (; around.index() < shape.cells.size(); around.go_to_next()) {
        const ShapeCell& cell = shape.cells[around.index()];
        if (cell.has_surface()) plane.push_back(static_cast<std::uint8_t>(depth_in(cell, depth) - predict(around)));
    }
    return plane;
}

Status put_surfaces(std::span<const std::uint8_t> plane, ShapeMap& shape) {
    RS_CHECK(plane.size() == surface_plane_bytes(shape.cells.size()));
    for (std::size_t i = 0; i < shape.cells.size(); ++i) {
        shape.cells[i].back = static_cast<std::uint8_t>(plane[i / 8] >> (i % 8) & 1);
    }
    if (shape.cells.size() % 8 != 0 && plane.back() >> (shape.cells.size() % 8) != 0) {
        return Error{"has bits behind its last cell"};
    }
    return {};
}

void put_residuals(std::span<const std::uint8_t> plane, Depth depth, ShapeMap& shape) {
    std::size_t taken = 0;
    Neighbourhood around(shape, depth);
    for (; around.index() < shape.cells.size(); around.go_to_next()) {
        ShapeCell& cell = shape.cells[around.index()];
        if (!cell.has_surface()) continue;
        RS_CHECK(taken < plane.size());
        depth_in(cell, depth) = static_cast<std::uint8_t>(predict(around) + plane[taken++]);
    }
    RS_CHECK(taken == plane.size());
}

}  // namespace rs::shape_coding
