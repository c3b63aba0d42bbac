#pragma once
/// \file
/// Ray-space object in memory, as the encoder makes it, the file stores it and executors read it. Users who only render
/// need rs::api::Object instead.
///
/// Lengths are in object radii: the radius of the bounding cylinder about the turntable's axis, the Y axis. `_qN` after
/// a name denotes fixed point with N fractional bits. Everything is integer: the arithmetic of a view
/// (engine/RECONSTRUCTION.md) starts from these numbers and is exact. Ranges: encode/FORMAT.md, section "Ranges".
///
/// A captured photo i is a line of ray space: through the point x of reference plane k it has exactly one ray. So the
/// RS map of a plane only holds *which photo* answers a cell (x, u); the CapturedLine of (photo, plane) gives column
/// and vertical scale of the ray through x exactly, without the rounding of a column stored per cell.

#include "rayspace/api/types/image.hpp"
#include "rayspace/api/types/shape_map.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs {

namespace codec {
struct CodedImages;
}

/// Cell of an RS map without a photo.
inline constexpr std::uint16_t kNoImage = 0xFFFF;

/// Projection of the points of a reference plane into one photo. The plane point x (q20) is at
///
///     axial depth  l = l0 + x * l1                        (object radii)
///     column       q = cx + (q0 + x * q1) / l             (px; floor gives the column index)
///     row scale    m = fl_y / l                           (rows per object radius)
struct CapturedLine {
    std::int32_t l0_q20 = 0;                               ///< l0, object radii
    std::int32_t l1_q30 = 0;                               ///< l1
    std::int32_t q0_q16 = 0;                               ///< q0, px * object radii
    std::int32_t q1_q16 = 0;                               ///< q1, px
    bool operator==(const CapturedLine&) const = default;  ///< equal in all members
};

/// Upright camera of one stored photo. A height Y on the plane point appears in row cy - m * (Y - height).
struct CapturedView {
    std::int32_t cx_q16 = 0;                               ///< principal point, px
    std::int32_t cy_q16 = 0;                               ///< principal point, px
    std::int32_t fl_y_q16 = 0;                             ///< vertical focal length, px
    std::int32_t height_q20 = 0;                           ///< Y of the camera's centre
    std::vector<CapturedLine> lines;                       ///< [k], one per reference plane of the view's ring
    bool operator==(const CapturedView&) const = default;  ///< equal in all members
};

/// Rotation from the object's axes to a ring's axes, whose Y is the axis that the ring's views surround: a unit
/// quaternion.
struct RingRotation {
    std::int32_t x_q30 = 0;                                ///< x
    std::int32_t y_q30 = 0;                                ///< y
    std::int32_t z_q30 = 0;                                ///< z
    std::int32_t w_q30 = 1 << 30;                          ///< w, the real part
    bool operator==(const RingRotation&) const = default;  ///< equal in all members
    /// True if the ring surrounds the object's own Y axis.
    [[nodiscard]] bool is_identity() const { return *this == RingRotation{}; }
};

/// Ring of views and its RS map. Planes, lines, elevation and shape map are in the ring's axes (`rotation`). Cell (k,
/// xi, ui) is cells[(k * x_cells + xi) * u_cells + ui] and holds the index of a view of the object, or kNoImage. xi =
/// floor((x + x_half) * x_cells_per_unit) for x in [-x_half, x_half); ui = floor((u + u_half) * u_cells_per_unit); both
/// clamped to the map.
struct Ring {
    RingRotation rotation;            ///< identity for turntable photos
    std::int32_t elevation_udeg = 0;  ///< mean elevation of the viewpoints above the ring's plane y = 0, 1e-6 degrees
    int planes = 0;                   ///< K, number of reference planes
    int x_cells = 0;                  ///< cells along x
    int u_cells = 0;                  ///< cells along u
    /// Half the extent in x: a little above 1 / cos(pi / K), where a ray that touches the object's cylinder crosses the
    /// plane.
    std::int32_t x_half_q20 = 0;
    std::int32_t x_cells_per_unit_q12 = 0;  ///< x_cells / (2 * x_half)
    std::int32_t u_half_q28 = 0;            ///< the map covers |u| <= u_half; a little above tan(pi / K)
    std::int32_t u_cells_per_unit_q12 = 0;  ///< u_cells / (2 * u_half)
    std::vector<std::uint16_t> views;       ///< indices of the ring's views, in turning order
    std::vector<std::uint16_t> cells;       ///< the RS map
    ShapeMap shape;  ///< depth of the rays; empty: the object is assumed to lie on the reference plane, as in the paper
    bool operator==(const Ring&) const = default;  ///< equal in all members

    /// Index of cell (plane, xi, ui) in `cells`.
    [[nodiscard]] std::size_t cell_index(int plane, int xi, int ui) const {
        return (static_cast<std::size_t>(plane) * static_cast<std::size_t>(x_cells) + static_cast<std::size_t>(xi)) *
                   static_cast<std::size_t>(u_cells) +
               static_cast<std::size_t>(ui);
    }
};

/// Stored photo: Y and alpha at full size, U and V at half width and height (rounded up) or, if chroma_shift is 0, at
/// full size too; 8 bits each. BT.601 full range; the conversion to RGB is normative (engine/RECONSTRUCTION.md).
struct PlanarImage {
    Image<std::uint8_t> y;  ///< luma
    Image<std::uint8_t> u;  ///< blue difference, centred on 128
    Image<std::uint8_t> v;  ///< red difference, centred on 128
    Image<std::uint8_t> a;  ///< alpha
    int chroma_shift = 1;   ///< right shift of a pixel's column and row that gives its place in U and V
    /// True if the photo was not loaded.
    [[nodiscard]] bool empty() const { return y.empty(); }
    bool operator==(const PlanarImage&) const = default;  ///< equal in all members
};

/// Ray-space object.
struct RaySpaceObject {
    std::string name;                      ///< UTF-8
    double units_per_radius = 1;           ///< length of the object radius in the units of the capture set
    std::optional<std::int32_t> foot_q20;  ///< Y of the ground that the object stands on, if known
    std::string rig_json;  ///< transforms.json of the stored (upright) photos, in the capture set's units; may be empty
    int width = 0;         ///< px, of every photo
    int height = 0;        ///< px, of every photo
    std::vector<CapturedView> views;  ///< one per photo
    std::vector<Ring> rings;          ///< at least one
    std::vector<PlanarImage> images;  ///< [view]; empty ones were not loaded (progressive reading)
    /// Compressed photos, if the file has them; then `images` may all be empty. Opaque to users of the library:
    /// rs::api::Object::unpacked() has every photo in `images`.
    std::shared_ptr<const codec::CodedImages> coded;
};

}  // namespace rs
