#pragma once
// A captured picture as the depth search sees it: scaled down to a working size, its columns contiguous, with the
// geometry of an upright camera taken apart into a horizontal and a vertical half.

#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

namespace rs::encode {

inline constexpr int kInside = 128;  // the least alpha of what is within a silhouette
inline constexpr int kOpaque = 250;  // and of what nothing shines through
// A wrong depth is often off by less; what stands in front of another part is mostly farther away. Object radii.
inline constexpr double kClearlyInFront = 0.1;
inline constexpr float kNoDepth = std::numeric_limits<float>::quiet_NaN();

// Where a ray of vertical planes runs, seen from above: through its foot (nearest to the axis) in direction `along`
// (unit, x and z). A point at depth `depth` is at foot + depth * along.
struct HorizontalRay {
    glm::dvec2 along{0, 1};
    glm::dvec2 foot{0, 0};
    double to_foot = 0;               // from the camera's centre to the foot
    double horizontal_per_axial = 1;  // horizontal length of the ray per unit of axial depth

    [[nodiscard]] glm::dvec2 place_at(double depth) const { return foot + depth * along; }
    // Of the point of the ray that is nearest to a place.
    [[nodiscard]] double depth_of(const glm::dvec2& place) const { return glm::dot(place - foot, along); }
    [[nodiscard]] double axial_at(double depth) const { return (to_foot + depth) / horizontal_per_axial; }
};

// To either side of the foot; a little beyond the object radius.
inline constexpr double kDeepest = 1 + 1.0 / 32;

// The depths that a search tries: level n of 0..count-1 is low + n * step object radii along a ray from its foot.
struct DepthRange {
    double low = -1;
    double step = 2.0 / 127;
    int count = 128;
    [[nodiscard]] double at(double level) const { return low + level * step; }
    [[nodiscard]] double level_of(double depth) const { return (depth - low) / step; }
};

// A place seen from above by a camera: all points above each other share it.
struct SeenColumn {
    double axial = 0;   // depth; not seen where <= 0
    double column = 0;  // px
};

// Where a point appears in a picture, px.
struct SeenPoint {
    double column = 0, row = 0;
    [[nodiscard]] int whole_column() const { return static_cast<int>(column); }
    [[nodiscard]] int whole_row() const { return static_cast<int>(row); }
};

struct WorkView {
    Image<Rgba8> columns;  // transposed: pixel (column, row) is columns(row, column)
    int width = 0;         // px, of the upright picture
    int height = 0;
    double fl_x = 0, fl_y = 0, cx = 0, cy = 0;  // px
    glm::dvec2 centre{0, 0};                    // x and z, object radii
    double centre_y = 0;
    glm::dvec2 right{1, 0};
    glm::dvec2 forward{0, -1};

    [[nodiscard]] const Rgba8& at(int column, int row) const { return columns(row, column); }
    // Of the camera about the axis, radians, -pi .. pi.
    [[nodiscard]] double azimuth() const { return std::atan2(centre.x, centre.y); }
    // Of the camera: x and z, then y.
    [[nodiscard]] glm::dvec3 place() const { return {centre, centre_y}; }
    // Through the middle of a column.
    [[nodiscard]] HorizontalRay ray_of(double column) const;
    [[nodiscard]] SeenColumn see(const glm::dvec2& place) const {
        const glm::dvec2 from_centre = place - centre;
        const double axial = glm::dot(from_centre, forward);
        return {axial, cx + fl_x * glm::dot(from_centre, right) / axial};
    }
    // Nothing where that is outside of the frame.
    [[nodiscard]] std::optional<SeenPoint> see(const glm::dvec2& place, double y) const {
        const SeenColumn seen = see(place);
        if (seen.axial <= 0) return std::nullopt;
        const double row = row_of(y, seen.axial);
        if (!(seen.column >= 0 && seen.column < width && row >= 0 && row < height)) return std::nullopt;
        return SeenPoint{seen.column, row};
    }
    // Row of height y at an axial depth, and back.
    [[nodiscard]] double row_of(double y, double axial) const { return cy - fl_y * (y - centre_y) / axial; }
    [[nodiscard]] double height_of(double row, double axial) const { return centre_y + axial * (cy - row) / fl_y; }
};

// each(column, row) of the square that far to each side of a pixel, as far as it lies in the frame.
template <class Each>
void for_each_around(const WorkView& view, int column, int row, int radius, const Each& each) {
    for (int c = std::max(column - radius, 0); c <= std::min(column + radius, view.width - 1); ++c) {
        for (int r = std::max(row - radius, 0); r <= std::min(row + radius, view.height - 1); ++r) each(c, r);
    }
}

// A picture and what was found: along a pixel's ray, distance from the foot in object radii, transposed as
// WorkView::columns is; kNoDepth where there is none.
struct DepthView {
    WorkView view;
    Image<float> depth;
};

// How many pixels have a depth.
inline std::ptrdiff_t count_depths(const Image<float>& depths) {
    return std::ranges::count_if(depths.pixels(), [](float depth) { return !std::isnan(depth); });
}

// `camera` is upright and in object radii. `picture` is averaged over blocks of `reduction` x `reduction` pixels
// (colour weighted by alpha); what is left over at the right and lower edges is dropped.
WorkView make_work_view(const Camera& camera, ConstImageView<Rgba8> picture, int reduction);

// The same, reduced by two once more.
WorkView halved(const WorkView& view);

// 255 where something soft is (soft_coverage.hpp, patches of 5x5 pixels) that covers less than half, else 0; transposed
// as WorkView::columns is. A shadow that was cut out along with the object is a surface, too.
Image<std::uint8_t> soft_pixels(const WorkView& view);

// Makes these pixels part of the object: covered altogether, in the colours that they have before white.
void cover_soft(WorkView& view, const Image<std::uint8_t>& soft);

// Moves each pixel's mean colour of the object around it (9x9 pixels) towards grey, to a quarter of its contrast, and
// keeps what differs from it: gloss and shading change from picture to picture, detail stays. Alpha is not changed.
void weaken_shading(WorkView& view);

}  // namespace rs::encode
