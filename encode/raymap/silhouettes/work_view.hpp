#pragma once
// A photo at the working resolution of depth estimation: stored by columns, with the geometry of its upright camera
// separated into a horizontal and a vertical part.
//
// Places are (x, z) in the ground plan and heights are y, both in object radii; pixels are (column, row) of the upright
// photo, with centres at +0.5.

#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

namespace rs::encode {

inline constexpr int kInside = 128;  // least alpha of a pixel inside the silhouette
inline constexpr int kOpaque = 250;  // least alpha of an opaque pixel
/// Least distance between an occluder and the surface behind it, object radii. Errors of depth are mostly smaller, and
/// distances between parts of an object mostly larger.
inline constexpr double kClearlyInFront = 0.1;
inline constexpr float kNoDepth = std::numeric_limits<float>::quiet_NaN();

/// The projection of a pixel's ray onto the ground plan: through its foot, the point nearest to the axis, in direction
/// `along` (unit, x and z). A point at depth `depth` is at foot + depth * along.
struct HorizontalRay {
    glm::dvec2 along{0, 1};
    glm::dvec2 foot{0, 0};
    double to_foot = 0;               // distance from the camera's centre to the foot
    double horizontal_per_axial = 1;  // horizontal length of the ray per unit of axial depth

    [[nodiscard]] glm::dvec2 place_at(double depth) const { return foot + depth * along; }
    /// The depth of the ray's point nearest to a place.
    [[nodiscard]] double depth_of(const glm::dvec2& place) const { return glm::dot(place - foot, along); }
    [[nodiscard]] double axial_at(double depth) const { return (to_foot + depth) / horizontal_per_axial; }
};

/// Largest distance of a depth from the foot, to either side; slightly more than the object radius.
inline constexpr double kMaxDepth = 1 + 1.0 / 32;

/// The depth hypotheses of a search: level n, 0 <= n < count, is at low + n * step object radii from a ray's foot.
struct DepthRange {
    double low = -1;
    double step = 2.0 / 127;
    int count = 128;
    [[nodiscard]] double at(double level) const { return low + level * step; }
    [[nodiscard]] double level_of(double depth) const { return (depth - low) / step; }
};

/// The projection of a place of the ground plan, shared by all points above it.
struct ProjectedColumn {
    double axial = 0;   // depth along the optical axis; behind the camera where <= 0
    double column = 0;  // px
};

/// The projection of a point, px.
struct ProjectedPoint {
    double column = 0, row = 0;
    [[nodiscard]] int whole_column() const { return static_cast<int>(column); }
    [[nodiscard]] int whole_row() const { return static_cast<int>(row); }
};

struct WorkView {
    Image<Rgba8> columns;  // transposed: pixel (column, row) is columns(row, column)
    int width = 0;         // px, of the upright photo
    int height = 0;
    double fl_x = 0, fl_y = 0, cx = 0, cy = 0;  // px
    glm::dvec2 centre{0, 0};                    // x and z, object radii
    double centre_y = 0;
    glm::dvec2 right{1, 0};
    glm::dvec2 forward{0, -1};

    [[nodiscard]] const Rgba8& at(int column, int row) const { return columns(row, column); }
    /// Azimuth of the camera about the axis, radians, -pi .. pi.
    [[nodiscard]] double azimuth() const { return std::atan2(centre.x, centre.y); }
    /// Centre of the camera: x, z, y.
    [[nodiscard]] glm::dvec3 place() const { return {centre, centre_y}; }
    /// The ray through a column; `column` + 0.5 is its middle.
    [[nodiscard]] HorizontalRay ray_of(double column) const;
    [[nodiscard]] ProjectedColumn see(const glm::dvec2& place) const {
        const glm::dvec2 from_centre = place - centre;
        const double axial = glm::dot(from_centre, forward);
        return {axial, cx + fl_x * glm::dot(from_centre, right) / axial};
    }
    /// nullopt where the projection is outside of the frame.
    [[nodiscard]] std::optional<ProjectedPoint> see(const glm::dvec2& place, double y) const {
        const ProjectedColumn seen = see(place);
        if (seen.axial <= 0) return std::nullopt;
        const double row = row_of(y, seen.axial);
        if (!(seen.column >= 0 && seen.column < width && row >= 0 && row < height)) return std::nullopt;
        return ProjectedPoint{seen.column, row};
    }
    /// The row of height y at an axial depth, and the inverse.
    [[nodiscard]] double row_of(double y, double axial) const { return cy - fl_y * (y - centre_y) / axial; }
    [[nodiscard]] double height_of(double row, double axial) const { return centre_y + axial * (cy - row) / fl_y; }
};

/// Calls each(column, row) for the pixels of the frame at most `radius` columns and rows away from a pixel.
template <class Each>
void for_each_around(const WorkView& view, int column, int row, int radius, const Each& each) {
    for (int c = std::max(column - radius, 0); c <= std::min(column + radius, view.width - 1); ++c) {
        for (int r = std::max(row - radius, 0); r <= std::min(row + radius, view.height - 1); ++r) each(c, r);
    }
}

/// A photo with its depth map. Images are transposed as WorkView::columns is.
struct DepthView {
    WorkView view;
    Image<float> depth;                  // object radii from the foot of the pixel's ray; kNoDepth where unknown
    Image<std::uint8_t> occluders = {};  // 1 where the depth may occlude other surfaces; empty: none does
};

/// The number of pixels with a depth.
inline std::ptrdiff_t count_depths(const Image<float>& depths) {
    return std::ranges::count_if(depths.pixels(), [](float depth) { return !std::isnan(depth); });
}

/// Downsamples a photo by averaging blocks of `reduction` x `reduction` pixels, colour weighted by alpha; incomplete
/// blocks at the right and lower edges are dropped. `camera` is upright and in object radii.
WorkView make_work_view(const Camera& camera, ConstImageView<Rgba8> image, int reduction);

/// Downsamples a view once more, by two.
WorkView halve(const WorkView& view);

/// 255 where coverage is soft over 5x5 pixels (soft_coverage.hpp) and below one half, else 0; transposed as
/// WorkView::columns is. Such pixels are a surface of their own: shadows that were segmented with the object, gauze.
Image<std::uint8_t> soft_pixels(const WorkView& view);

/// Makes soft pixels opaque, in their colours composited over white.
void make_soft_opaque(WorkView& view, const Image<std::uint8_t>& soft);

/// Measures texture: the standard deviation of luma over the object's pixels among the 9x9 around each pixel, in codes,
/// rounded down, 0..127; transposed as WorkView::columns is. 0 outside of the silhouette (alpha below kInside).
Image<std::uint8_t> measure_texture(const WorkView& view);

/// High-pass filter: reduces the contrast of the local mean colour (9x9 pixels, weighted by alpha) to a quarter, since
/// gloss and shading differ between photos, and keeps each pixel's difference from it. Alpha is not changed.
void attenuate_shading(WorkView& view);

}  // namespace rs::encode
