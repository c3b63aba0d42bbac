#include "encode/raymap/silhouettes/silhouette_repair.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace rs::encode {
namespace {

bool rules_out(const SampledHull& hull, const SpacePoint& point) {
    return std::ranges::none_of(hull.heights_above(point.place), [&](const Interval& heights) {
        return heights.low <= point.y && point.y <= heights.high;
    });
}

bool shows(const DepthView& image, const SpacePoint& point, double tolerance) {
    const std::optional<ProjectedPoint> at = image.view.see(point.place, point.y);
    if (!at) return false;
    const double depth = image.view.ray_of(at->whole_column() + 0.5).depth_of(point.place);
    const auto there = static_cast<double>(image.depth(at->whole_row(), at->whole_column()));
    return std::abs(depth - there) < tolerance;  // false where there is no depth
}

// nullopt where the point may be part of the object: points outside of the frame may be.
std::optional<glm::ivec2> pixel_beside(const WorkView& view, const SpacePoint& point) {
    const std::optional<ProjectedPoint> at = view.see(point.place, point.y);
    if (!at) return std::nullopt;
    const glm::ivec2 pixel(at->whole_column(), at->whole_row());
    if (pixel.x == 0 || pixel.y == 0 || pixel.x == view.width - 1 || pixel.y == view.height - 1) return std::nullopt;
    bool beside = true;
    for_each_around(view, pixel.x, pixel.y, 1,
                    [&](int column, int row) { beside = beside && view.at(column, row).a < kInside; });
    return beside ? std::optional(pixel) : std::nullopt;
}

}  // namespace

std::vector<RuledOutPoint> find_ruled_out(const DepthView& image, std::span<const DepthView* const> beside,
                                          double tolerance, const SampledHull& searched, const SampledHull& hull) {
    std::vector<RuledOutPoint> points;
    const WorkView& view = image.view;
    for (int column = 0; column < view.width; ++column) {
        const HorizontalRay ray = view.ray_of(column + 0.5);
        for (int row = 0; row < view.height; ++row) {
            const auto depth = static_cast<double>(image.depth(row, column));
            if (std::isnan(depth) || view.at(column, row).a < kOpaque) continue;
            const auto at = [&](double d) {
                return SpacePoint{ray.place_at(d), view.height_of(row + 0.5, ray.axial_at(d))};
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
    for (const std::vector<RuledOutPoint>& of_image : points) {
        for (const RuledOutPoint& point : of_image) {
            const std::optional<glm::ivec2> at = pixel_beside(view, point.found);
            if (!at || !pixel_beside(view, point.nearest) || !pixel_beside(view, point.farthest)) continue;
            const auto depth = static_cast<float>(view.ray_of(at->x + 0.5).depth_of(point.found.place));
            float& nearest = missing(at->y, at->x);
            if (!(nearest <= depth)) nearest = depth;
        }
    }
    return missing;
}

void fill_missing(WorkView& view, const Image<float>& missing) {
    for (int column = 0; column < missing.height(); ++column) {
        for (int row = 0; row < missing.width(); ++row) {
            if (std::isnan(missing(row, column))) continue;
            for (int part = 0; part < 4; ++part) {
                for_each_around(view, 2 * column + part / 2, 2 * row + part % 2, 1,
                                [&](int c, int r) { view.columns(r, c).a = 255; });
            }
        }
    }
}

}  // namespace rs::encode
