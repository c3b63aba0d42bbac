#include "encode/raymap/silhouette_repair.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace rs::encode {
namespace {

struct Pixel {
    int column = 0, row = 0;
};

std::optional<Pixel> pixel_of(const WorkView& view, const PlaceInSpace& point) {
    const SeenColumn seen = view.see(point.place);
    if (seen.axial <= 0) return std::nullopt;
    const double row = view.row_of(point.y, seen.axial);
    if (!(seen.column >= 0 && seen.column < view.width && row >= 0 && row < view.height)) return std::nullopt;
    return Pixel{static_cast<int>(seen.column), static_cast<int>(row)};
}

bool rules_out(const SampledHull& hull, const PlaceInSpace& point) {
    return std::ranges::none_of(hull.heights_above(point.place), [&](const Interval& heights) {
        return heights.low <= point.y && point.y <= heights.high;
    });
}

bool shows(const DepthView& picture, const PlaceInSpace& point, double tolerance) {
    const std::optional<Pixel> at = pixel_of(picture.view, point);
    if (!at) return false;
    const HorizontalRay ray = picture.view.ray_of(at->column + 0.5);
    const double there = static_cast<double>(picture.depth(at->row, at->column));
    return std::abs(glm::dot(point.place - ray.foot, ray.along) - there) < tolerance;  // false where there is none
}

template <class Each>
void for_each_around(const WorkView& view, const Pixel& pixel, const Each& each) {
    for (int column = std::max(pixel.column - 1, 0); column <= std::min(pixel.column + 1, view.width - 1); ++column) {
        for (int row = std::max(pixel.row - 1, 0); row <= std::min(pixel.row + 1, view.height - 1); ++row) {
            each(column, row);
        }
    }
}

// Nothing where that may be: what lies outside of the frame may be object.
std::optional<Pixel> pixel_beside(const WorkView& view, const PlaceInSpace& point) {
    const std::optional<Pixel> at = pixel_of(view, point);
    if (!at || at->column == 0 || at->row == 0 || at->column == view.width - 1 || at->row == view.height - 1) {
        return std::nullopt;
    }
    bool beside = true;
    for_each_around(view, *at, [&](int column, int row) { beside = beside && view.at(column, row).a < kInside; });
    return beside ? at : std::nullopt;
}

}  // namespace

std::vector<RuledOutPoint> ruled_out(const DepthView& picture, std::span<const DepthView* const> beside,
                                     double tolerance, const SampledHull& searched, const SampledHull& hull) {
    std::vector<RuledOutPoint> points;
    const WorkView& view = picture.view;
    for (int column = 0; column < view.width; ++column) {
        const HorizontalRay ray = view.ray_of(column + 0.5);
        for (int row = 0; row < view.height; ++row) {
            const auto depth = static_cast<double>(picture.depth(row, column));
            if (std::isnan(depth) || view.at(column, row).a < kOpaque) continue;
            const auto at = [&](double d) {
                return PlaceInSpace{ray.place_at(d), view.height_of(row + 0.5, ray.axial_at(d))};
            };
            const RuledOutPoint point{at(depth - tolerance), at(depth), at(depth + tolerance)};
            if (!rules_out(hull, point.found) || !rules_out(hull, point.nearest) || !rules_out(hull, point.farthest)) {
                continue;
            }
            if (rules_out(searched, point.found)) continue;
            const auto shows_it = [&](const DepthView* other) { return shows(*other, point.found, tolerance); };
            if (std::ranges::all_of(beside, shows_it)) points.push_back(point);
        }
    }
    return points;
}

Image<float> missing_depths(const WorkView& view, std::span<const std::vector<RuledOutPoint>> points) {
    Image<float> missing(view.height, view.width, kNoDepth);
    const auto pixels = view.columns.pixels();
    if (std::ranges::none_of(pixels, [](const Rgba8& pixel) { return pixel.a >= kInside; })) return missing;
    for (const std::vector<RuledOutPoint>& of_picture : points) {
        for (const RuledOutPoint& point : of_picture) {
            const std::optional<Pixel> at = pixel_beside(view, point.found);
            if (!at || !pixel_beside(view, point.nearest) || !pixel_beside(view, point.farthest)) continue;
            const HorizontalRay ray = view.ray_of(at->column + 0.5);
            const auto depth = static_cast<float>(glm::dot(point.found.place - ray.foot, ray.along));
            float& nearest = missing(at->row, at->column);
            if (!(nearest <= depth)) nearest = depth;
        }
    }
    return missing;
}

bool shows_nothing(const Image<float>& depths) {
    return std::ranges::all_of(depths.pixels(), [](float depth) { return std::isnan(depth); });
}

void fill_missing(WorkView& view, const Image<float>& missing) {
    for (int column = 0; column < missing.height(); ++column) {
        for (int row = 0; row < missing.width(); ++row) {
            if (std::isnan(missing(row, column))) continue;
            for (int part = 0; part < 4; ++part) {
                for_each_around(view, {2 * column + part / 2, 2 * row + part % 2},
                                [&](int c, int r) { view.columns(r, c).a = 255; });
            }
        }
    }
}

}  // namespace rs::encode
