#pragma once
// Inner loop of the fast core for objects with a shape map: SIMD implementation of shape_pixel.hpp, many rows of a view
// column at once. Each lane computes the same numbers as shape_pixel().
//
// Upright views only: one set-up serves a column, and all pixels of a row have the same rise.

#include "engine/core/definition/effective_depth.hpp"
#include "engine/core/definition/shape_setup.hpp"
#include "engine/core/definition/view_registers.hpp"
#include "engine/core/fast/column_walk.hpp"
#include "engine/core/fast/surface_column.hpp"
#include "engine/core/fast/texel_store.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace rs::engine {

// Rows of a column that are written at once.
inline constexpr int kBlockRows = 16;

// ShapeImage and the members of CapturedView that it is used with.
struct ShapeImageColumn {
    bool used = false;       // false: the column does not sample this image
    std::int32_t start = 0;  // index of texel (0, 0)
    std::int32_t l0_q20 = 0;
    std::int32_t l1_q24 = 0;
    std::int32_t n0_q12 = 0;
    std::int32_t n1_q12 = 0;
    std::int32_t cx_q8 = 0;
    std::int32_t cy_q8 = 0;
    std::int32_t fl_y_q8 = 0;
    std::int32_t height_q16 = 0;
};

// ShapeSetup of a view column. A column without a ray has no rows.
struct ShapeColumn {
    std::int32_t first_row = 0;  // view rows outside of first_row .. end_row - 1 are transparent
    std::int32_t end_row = 0;
    ShapeImageColumn first;
    ShapeImageColumn second;
    std::int32_t weight = 0;  // of the second image, 0..256
    bool alone = false;       // one image has all the weight
    // No ray of the column marches and no number of section 6 of engine/RECONSTRUCTION.md saturates.
    bool level = false;
    // SurfaceColumn and its entries; first_middle: centre of the first entry's band.
    const std::int32_t* smooth = nullptr;
    const std::int32_t* deepest = nullptr;
    const std::int32_t* steps = nullptr;
    std::int32_t last_entry = 0;
    std::int32_t first_middle_q12 = 0;
    std::int32_t nearest = 0;
    std::int32_t beyond = 0;
    std::int32_t foot_depth_q3 = 0;
    std::int32_t lambda_foot_q20 = 0;
    std::int32_t lambda0_q20 = 0;
    std::int32_t lambda1_q21 = 0;
    std::int32_t inverse_r_q20 = 0;
    std::int32_t inverse_rho_q20 = 0;
};

// Neighbouring columns; a row of them fills a cache line of output.
struct ShapeStrip {
    ShapeColumn columns[kStripColumns];
    SurfaceEntries entries;
};

// Constants of a view.
struct ShapeWalk {
    const Rgba8* texels = nullptr;         // of TexelStore
    const std::int8_t* details = nullptr;  // of TexelStore; null with the bilinear filter
    TexelFilter filter = TexelFilter::kBilinear;
    std::int32_t column_stride = 0;
    std::int32_t width = 0;  // of the captured images
    std::int32_t height = 0;
    std::int32_t rows = 0;            // of the view
    std::int32_t first_rise_q24 = 0;  // of the first row of the view; rises are monotonic over rows
    std::int32_t last_rise_q24 = 0;   // of the last row
    std::int32_t b_q16 = 0;
    std::int32_t reference_height_q16 = 0;
    std::int32_t h_low_q16 = 0;
    std::int32_t bands_per_unit_q12 = 0;
    std::int32_t thickness = 0;  // depth steps
    std::int32_t depth_step_q24 = 0;
    std::array<std::int32_t, EffectiveDepth::kDepths + kBlockRows> effective_depth_q3{};  // padded for look_up()
};

ShapeWalk set_up_walk(const RaySpaceObject& object, const TexelStore& texels, const ViewRegisters& registers);

// Columns [first, last] of a captured image, to decode them in advance; empty if last < first.
struct ColumnRange {
    int first = 0;
    int last = -1;
};

/// All columns that sample_image() (shape_pixel.hpp) reads at any depth 0 .. 255; the range may be a little larger.
ColumnRange sampled_columns(const RaySpaceObject& object, const ShapeImage& image);

/// Sets up the view columns first_column .. first_column + kStripColumns - 1, as far as they exist, and ensures the
/// texels that they read. Overwrites `strip` and reuses its memory.
void set_up_shape_strip(const RaySpaceObject& object, const TexelStore& texels, const ViewRegisters& registers,
                        const ShapeWalk& walk, int first_column, ShapeStrip& strip);

// Destination of the pixels: row j of the strip at colour + j * colour_stride and, unless null, at
// lambda_q20 + j * lambda_stride.
struct ShapeWalkOutput {
    Rgba8* colour = nullptr;
    std::ptrdiff_t colour_stride = 0;
    std::int32_t* lambda_q20 = nullptr;
    std::ptrdiff_t lambda_stride = 0;
};

/// False on a machine without 16-byte vectors, where shape_pixel() is as fast.
bool can_walk_shape();

/// Writes `columns` (1..kStripColumns) pixels of all rows of the view. Requires can_walk_shape(). The SIMD target is
/// chosen at the first call; all targets give the same bytes.
/// \param rise_q24  rises of the rows, padded to a multiple of kBlockRows
void walk_shape(const ShapeWalk& walk, const ShapeStrip& strip, const std::int32_t* rise_q24, int columns,
                const ShapeWalkOutput& out);

}  // namespace rs::engine
