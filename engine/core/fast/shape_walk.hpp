#pragma once
// The inner loop of the fast core for objects with a shape map: every view column goes down its own line of cells and
// its own two captured pictures, many rows at once. The fast twin of shape_pixel.hpp; what a lane computes is what
// shape_pixel() computes, number by number.
//
// Only for upright views: there one set-up serves a column, and all pixels of a row have the same rise.

#include "engine/core/definition/shape_setup.hpp"
#include "engine/core/definition/view_registers.hpp"
#include "engine/core/fast/column_walk.hpp"
#include "engine/core/fast/surface_column.hpp"
#include "engine/core/fast/texel_store.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstddef>
#include <cstdint>

namespace rs::engine {

// How many rows of a column are written at once.
inline constexpr int kBlockRows = 16;

// ShapePicture and what it needs of CapturedView.
struct ShapePictureColumn {
    bool used = false;       // else the column does not look at it
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

// ShapeSetup of a view column. One without a ray has no rows.
struct ShapeColumn {
    std::int32_t first_row = 0;  // of the view: in no other does it show anything
    std::int32_t end_row = 0;
    ShapePictureColumn first;
    ShapePictureColumn second;
    std::int32_t weight = 0;
    bool alone = false;  // one picture answers alone
    // No ray of the column marches, and no number of its set-up saturates (engine/RECONSTRUCTION.md, section 6).
    bool level = false;
    // SurfaceColumn and its entries; first_middle: the middle of the first entry's band.
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

// Neighbouring columns, so many that a row of them fills a cache line of output.
struct ShapeStrip {
    ShapeColumn columns[kStripColumns];
    SurfaceEntries entries;
};

// What all columns of a view share.
struct ShapeWalk {
    const Rgba8* texels = nullptr;         // TexelStore's
    const std::int8_t* details = nullptr;  // TexelStore's; null with the bilinear filter
    TexelFilter filter = TexelFilter::kBilinear;
    std::int32_t column_stride = 0;
    std::int32_t width = 0;  // of the captured pictures
    std::int32_t height = 0;
    std::int32_t rows = 0;            // of the view
    std::int32_t first_rise_q24 = 0;  // of the view's rows: all others lie between
    std::int32_t last_rise_q24 = 0;
    std::int32_t b_q16 = 0;
    std::int32_t reference_height_q16 = 0;
    std::int32_t h_low_q16 = 0;
    std::int32_t bands_per_unit_q12 = 0;
    std::int32_t thickness = 0;  // depth steps
    std::int32_t depth_low_q20 = 0;
    std::int32_t depth_step_q24 = 0;
};

ShapeWalk set_up_walk(const RaySpaceObject& object, const TexelStore& texels, const ViewRegisters& registers);

// View columns first_column .. first_column + kStripColumns - 1, those that exist. Ensures the texels that they read.
// What `strip` was before does not matter, but for its memory, which is used again.
void set_up_shape_strip(const RaySpaceObject& object, const TexelStore& texels, const ViewRegisters& registers,
                        const ShapeWalk& walk, int first_column, ShapeStrip& strip);

// Where the pixels go: row j of the strip to colour + j * colour_stride and, where it is needed, lambda_q20 + j *
// lambda_stride.
struct ShapeWalkOutput {
    Rgba8* colour = nullptr;
    std::ptrdiff_t colour_stride = 0;
    std::int32_t* lambda_q20 = nullptr;
    std::ptrdiff_t lambda_stride = 0;
};

// False on a machine without vectors of 16 bytes; there is nothing to be gained over shape_pixel() then.
bool can_walk_shape();

// can_walk_shape() must be true. Writes `columns` (1..kStripColumns) pixels of all rows of the view. rise_q24: their
// rises, and some number each for what the last block of kBlockRows has more. The SIMD code for the machine at hand is
// chosen at the first call; all choices give the same bytes.
void walk_shape(const ShapeWalk& walk, const ShapeStrip& strip, const std::int32_t* rise_q24, int columns,
                const ShapeWalkOutput& out);

}  // namespace rs::engine
