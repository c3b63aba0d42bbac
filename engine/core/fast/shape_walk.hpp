#pragma once
// The inner loop of the fast core for objects with a shape map: a strip of view columns goes down the view together,
// each along its own line of cells and its own two captured pictures. The fast twin of shape_pixel.hpp; what a lane
// computes is what shape_pixel() says, number by number.
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

// A captured picture of each lane: ShapePicture and what it needs of CapturedView.
struct ShapePictureLanes {
    alignas(64) std::int32_t used[kStripColumns];   // -1, or 0: the lane does not look at this picture
    alignas(64) std::int32_t share[kStripColumns];  // its weight of 256, in both halves of 32 bits
    alignas(64) std::int32_t start[kStripColumns];  // index of texel (0, 0)
    alignas(64) std::int32_t l0_q20[kStripColumns];
    alignas(64) std::int32_t l1_q24[kStripColumns];
    alignas(64) std::int32_t n0_q12[kStripColumns];
    alignas(64) std::int32_t n1_q12[kStripColumns];
    alignas(64) std::int32_t cx_q8[kStripColumns];
    alignas(64) std::int32_t cy_q8[kStripColumns];
    alignas(64) std::int32_t fl_y_q8[kStripColumns];
    alignas(64) std::int32_t height_q16[kStripColumns];
};

// ShapeSetup, lane by lane. A lane without a ray uses neither picture.
struct ShapeStrip {
    ShapePictureLanes first;
    ShapePictureLanes second;
    alignas(64) std::int32_t weight[kStripColumns];
    alignas(64) std::int32_t alone[kStripColumns];  // -1: one picture answers alone
    // SurfaceColumn, in `entries` from entry_start on; first_middle: the middle of the first entry's band.
    alignas(64) std::int32_t entry_start[kStripColumns];
    alignas(64) std::int32_t last_entry[kStripColumns];
    alignas(64) std::int32_t first_middle_q12[kStripColumns];
    alignas(64) std::int32_t nearest[kStripColumns];
    alignas(64) std::int32_t beyond[kStripColumns];
    alignas(64) std::int32_t p_part[kStripColumns];
    alignas(64) std::int32_t foot_depth_q3[kStripColumns];
    alignas(64) std::int32_t lambda_foot_q20[kStripColumns];
    alignas(64) std::int32_t lambda0_q20[kStripColumns];
    alignas(64) std::int32_t lambda1_q21[kStripColumns];
    alignas(64) std::int32_t inverse_r_q20[kStripColumns];
    alignas(64) std::int32_t inverse_rho_q20[kStripColumns];
    SurfaceEntries entries;
    // No ray of the strip marches, and no number of its set-up saturates (engine/RECONSTRUCTION.md, section 6).
    bool level = false;
    bool empty = true;  // no lane has a ray
};

// What all lanes of all strips share.
struct ShapeWalk {
    const Rgba8* texels = nullptr;  // TexelStore's
    int jump = 0;
    std::int32_t column_stride = 0;
    std::int32_t width_q8 = 0;  // of the captured pictures
    std::int32_t height_q8 = 0;
    std::int32_t first_rise_q24 = 0;  // of the view's rows: all others lie between
    std::int32_t last_rise_q24 = 0;
    std::int32_t b_q16 = 0;
    std::int32_t reference_height_q16 = 0;
    std::int32_t h_low_q16 = 0;
    std::int32_t bands_per_unit_q12 = 0;
    std::int32_t depth_low_q20 = 0;
    std::int32_t depth_step_q24 = 0;
};

ShapeWalk set_up_walk(const RaySpaceObject& object, const TexelStore& texels, const ViewRegisters& registers);

// View columns first_column .. first_column + kStripColumns - 1, those that exist. Ensures the texels that they read.
// What `strip` was before does not matter, but for its memory, which is used again.
void set_up_shape_strip(const RaySpaceObject& object, const TexelStore& texels, const ViewRegisters& registers,
                        const ShapeWalk& walk, int first_column, ShapeStrip& strip);

// Where the pixels go: row j of the strip to colour + j * colour_stride and, where it is wanted, lambda_q20 + j *
// lambda_stride.
struct ShapeWalkOutput {
    Rgba8* colour = nullptr;
    std::ptrdiff_t colour_stride = 0;
    std::int32_t* lambda_q20 = nullptr;
    std::ptrdiff_t lambda_stride = 0;
};

// False on a machine without vectors of 16 bytes; there is nothing to be gained over shape_pixel() then.
bool can_walk_shape();

// can_walk_shape() must be true. Writes `columns` (1..kStripColumns) pixels of `rows` view rows whose rises are
// rise_q24[0 .. rows - 1]. The SIMD code for the machine at hand is chosen at the first call; all choices give the same
// bytes.
void walk_shape(const ShapeWalk& walk, const ShapeStrip& strip, const std::int32_t* rise_q24, int rows, int columns,
                const ShapeWalkOutput& out);

}  // namespace rs::engine
