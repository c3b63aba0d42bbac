#pragma once
// Valid random shape maps for ring objects (ring_object.hpp) and small ones, to compare renderers.

#include "rayspace/api/types/shape_map.hpp"
#include "tests/support/small_shape.hpp"

#include <algorithm>
#include <cstdint>
#include <random>

namespace rs::test {

/// Lines, correct normal lines and sizes as in small_shape(); then, at random, another band height, other depths,
/// another reference viewpoint, gaps without lines, and a fraction `empty_share` of empty cells. The depths of the
/// others are close to each other (`smooth`) or arbitrary.
inline ShapeMap random_shape(const RaySpaceObject& object, std::size_t ring, std::mt19937_64& random,
                             double empty_share) {
    using small_object_detail::fixed;
    const auto real = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const auto whole = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
    SmallShapeOptions options;
    options.p_cells = whole(1, 40);
    options.bands = whole(1, 60);
    options.lines.clear();
    for (int n = whole(1, 5); n > 0; --n) options.lines.push_back(whole(0, 3) == 0 ? 0 : whole(1, 5));
    ShapeMap shape = small_shape(object, ring, options);
    if (whole(0, 1) == 0) {
        shape.h_low_q20 = fixed(real(-1.5, 0.2), 20);
        shape.bands_per_unit_q12 = fixed(options.bands * real(0.3, 3), 12);
    }
    if (whole(0, 5) == 0) {  // up to the ends of the ranges, where numbers saturate
        shape.h_low_q20 = fixed(real(-255, 255), 20);
        shape.bands_per_unit_q12 = fixed(real(100, 16383), 12);
    }
    if (whole(0, 2) == 0) {
        shape.reference_distance_q20 = fixed(real(1.1, 9), 20);
        shape.reference_height_q20 = fixed(real(-1, 1), 20);
    }
    if (whole(0, 2) == 0) {
        shape.depth_low_q20 = fixed(real(-2, 1), 20);
        shape.depth_step_q24 = fixed(real(0.0001, 0.015), 24);
    }
    shape.jump = whole(0, 2) == 0 ? whole(1, 255) : whole(1, 20);
    shape.thickness = whole(0, 3) == 0 ? whole(0, 255) : whole(0, 30);
    const bool smooth = whole(0, 1) == 0;
    const bool leans = whole(0, 1) == 0;
    const int middle = whole(0, 255);
    for (ShapeCell& cell : shape.cells) {
        cell = {};
        if (real(0, 1) < empty_share) continue;
        const auto depth = [&] { return smooth ? std::clamp(middle + whole(-9, 9), 0, 255) : whole(0, 255); };
        cell.depth = static_cast<std::uint8_t>(depth());
        cell.shown = leans ? static_cast<std::uint8_t>(whole(1, 3)) : ShapeCell::kByBoth;
    }
    return shape;
}

}  // namespace rs::test
