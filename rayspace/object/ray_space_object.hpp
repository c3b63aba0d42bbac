#pragma once
// A ray-space object in memory, created by the encoder, stored in .rso files and rendered by the engine.
//
// Lengths are in object radii (conventions.hpp). Suffix `_qN` means fixed point with N fractional bits. All values are
// integers: the renderer's arithmetic (engine/RECONSTRUCTION.md) starts from these numbers and is exact.
//
// A captured image is a line of ray space: through the point x of reference plane k it has exactly one ray. The RS map
// of a plane therefore stores only the index of the image that is shown in a cell (x, u); the CapturedLine of (image,
// plane) then gives column and vertical scale of the ray through x exactly, without the rounding of a column stored per
// cell.

#include "rayspace/codec/code/coded_images.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/shape_map.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs {

inline constexpr std::uint16_t kNoImage = 0xFFFF;

/// Projection of the plane point x (q20) into a captured image:
///     axial depth  l = l0 + x * l1                        (object radii)
///     column       q = cx + (q0 + x * q1) / l             (px; floor gives the column index)
///     row scale    m = fl_y / l                           (rows per object radius)
struct CapturedLine {
    std::int32_t l0_q20 = 0;
    std::int32_t l1_q30 = 0;
    std::int32_t q0_q16 = 0;
    std::int32_t q1_q16 = 0;
    bool operator==(const CapturedLine&) const = default;
};

/// The upright camera of a stored image. Height Y at a plane point appears in row cy - m * (Y - height).
struct CapturedView {
    std::int32_t cx_q16 = 0;
    std::int32_t cy_q16 = 0;
    std::int32_t fl_y_q16 = 0;
    std::int32_t height_q20 = 0;
    std::vector<CapturedLine> lines;  // [k], one per reference plane of the view's ring
    bool operator==(const CapturedView&) const = default;
};

/// A ring of views and its RS map. Cell (k, xi, ui) is cells[(k * x_cells + xi) * u_cells + ui] and contains the index
/// of a view of the object, or kNoImage. xi = floor((x + x_half) * x_cells_per_unit) for x in [-x_half, x_half); ui =
/// floor((u + u_half) * u_cells_per_unit); both clamped to the map.
struct Ring {
    std::int32_t elevation_udeg = 0;  // mean elevation of the viewpoints above the horizontal plane, 1e-6 degrees
    int planes = 0;                   // K
    int x_cells = 0;
    int u_cells = 0;
    // Slightly above 1 / cos(pi / K), the largest x at which a ray that touches the object's cylinder crosses the
    // plane.
    std::int32_t x_half_q20 = 0;
    std::int32_t x_cells_per_unit_q12 = 0;  // x_cells / (2 * x_half)
    std::int32_t u_half_q28 = 0;            // the map covers |u| <= u_half; a little above tan(pi / K)
    std::int32_t u_cells_per_unit_q12 = 0;  // u_cells / (2 * u_half)
    std::vector<std::uint16_t> views;       // indices of the views that belong to the ring, in turning order
    std::vector<std::uint16_t> cells;
    ShapeMap shape;  // empty: the object is assumed to lie on the reference plane, as in the paper
    bool operator==(const Ring&) const = default;

    [[nodiscard]] std::size_t cell_index(int plane, int xi, int ui) const {
        return (static_cast<std::size_t>(plane) * static_cast<std::size_t>(x_cells) + static_cast<std::size_t>(xi)) *
                   static_cast<std::size_t>(u_cells) +
               static_cast<std::size_t>(ui);
    }
};

/// A stored image: Y and alpha at full size, U and V at half width and height (rounded up) or, if chroma_shift is 0, at
/// full size too; 8 bits each.
struct PlanarImage {
    Image<std::uint8_t> y, u, v, a;
    int chroma_shift = 1;  // right shift of a pixel's column and row for U and V
    [[nodiscard]] bool empty() const { return y.empty(); }
    bool operator==(const PlanarImage&) const = default;
};

struct RaySpaceObject {
    std::string name;
    double units_per_radius = 1;           // length of the object radius in the units of the capture set
    std::optional<std::int32_t> foot_q20;  // Y of the ground below the object, object radii; nullopt: unknown
    std::string rig_json;  // the rig of the stored (upright) images, in the capture set's units: rig.hpp
    int width = 0;         // px, of every image
    int height = 0;
    std::vector<CapturedView> views;
    std::vector<Ring> rings;
    std::vector<PlanarImage> images;  // [view]; empty: not loaded (progressive reading)
    // The images in compressed form, if the file is compressed; `images` may then be empty until codec::decode_images()
    // decodes them.
    std::shared_ptr<const codec::CodedImages> coded;
};

/// The size of chroma planes: half, rounded up.
constexpr int half_size(int size) {
    return (size + 1) / 2;
}

/// Progressive level of a ring's n-th view, counted from 0. Views are stored and loaded by level: every 8th view of a
/// ring first (level 0), then every 4th (1), every 2nd (2) and all (3).
constexpr int progressive_level(int n) {
    if (n % 8 == 0) return 0;
    if (n % 4 == 0) return 1;
    return n % 2 == 0 ? 2 : 3;
}
inline constexpr int kProgressiveLevels = 4;

}  // namespace rs
