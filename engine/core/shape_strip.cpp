// What shape_walk.cpp walks down: set-ups of neighbouring columns, side by side.

#include "engine/core/shape_columns.hpp"
#include "engine/core/shape_walk.hpp"

#include <algorithm>

namespace rs::engine {
namespace {

void set_picture(const RaySpaceObject& object, const TexelStore& texels, const ShapePicture& picture, int lane,
                 ShapePictureLanes& lanes) {
    if (texels.is_coded()) {
        const ColumnRange columns = columns_read(object, picture);
        if (columns.first <= columns.last) texels.ensure(picture.view, columns.first, columns.last);
    }
    const CapturedView& view = object.views[static_cast<std::size_t>(picture.view)];
    lanes.used[lane] = -1;
    lanes.start[lane] = texels.column_start(picture.view, 0);
    lanes.l0_q20[lane] = picture.l0_q20;
    lanes.l1_q24[lane] = picture.l1_q24;
    lanes.n0_q12[lane] = picture.n0_q12;
    lanes.n1_q14[lane] = picture.n1_q14;
    lanes.cx_q8[lane] = view.cx_q16 >> 8;
    lanes.cy_q8[lane] = view.cy_q16 >> 8;
    lanes.fl_y_q8[lane] = view.fl_y_q16 >> 8;
    lanes.height_q16[lane] = view.height_q20 >> 4;
}

// Between which bands and depths a ray of the lane can meet a cell: the march need not look elsewhere.
void set_cells(const ShapeMap& shape, const ShapeCell* cells, int lane, ShapeStrip& strip) {
    int low = 0;
    int high = 0;
    int nearest = 256;
    int beyond = 0;
    for (int band = 0; band < shape.bands; ++band) {
        const ShapeCell& cell = cells[band];
        if (cell.rays == 0) continue;
        if (high == 0) low = band;
        high = band + 1;
        nearest = std::min(nearest, cell.nearest());
        beyond = std::max(beyond, cell.back + 1);
    }
    strip.low_band[lane] = low;
    strip.cell_start[lane] = static_cast<std::int32_t>(cells + low - shape.cells.data());
    strip.bands[lane] = high - low;
    strip.nearest[lane] = nearest;
    strip.beyond[lane] = beyond;
}

}  // namespace

ShapeWalk set_up_walk(const RaySpaceObject& object, const TexelStore& texels, const ViewRegisters& registers) {
    static constexpr ShapeCell kNoCell;
    const ShapeMap& shape = object.rings[static_cast<std::size_t>(registers.ring)].shape;
    ShapeWalk walk;
    walk.cells = shape.cells.empty() ? &kNoCell : shape.cells.data();
    walk.texels = texels.texels();
    walk.column_stride = texels.column_stride();
    walk.width_q8 = object.width << 8;
    walk.height_q8 = object.height << 8;
    walk.b_q16 = registers.b_q20 >> 4;
    walk.reference_height_q16 = shape.reference_height_q20 >> 4;
    walk.h_low_q16 = shape.h_low_q20 >> 4;
    walk.bands_per_unit_q12 = shape.bands_per_unit_q12;
    walk.depth_low_q20 = shape.depth_low_q20;
    walk.depth_step_q24 = shape.depth_step_q24;
    return walk;
}

ShapeStrip set_up_shape_strip(const RaySpaceObject& object, const TexelStore& texels, const ViewRegisters& registers,
                              int first_column) {
    const ShapeMap& shape = object.rings[static_cast<std::size_t>(registers.ring)].shape;
    ShapeStrip strip{};
    const int columns = std::min(kStripColumns, registers.width - first_column);
    for (int lane = 0; lane < columns; ++lane) {
        const ShapeSetup setup = set_up_shape(object, registers, first_column + lane, 0);
        if (!setup.has_ray) continue;
        strip.empty = false;
        if (setup.weight < 256) set_picture(object, texels, setup.first, lane, strip.first);
        if (setup.weight > 0) set_picture(object, texels, setup.second, lane, strip.second);
        strip.weight[lane] = setup.weight;
        if (setup.weight == 0) strip.alone[lane] = kFirstSeesLayer0;
        if (setup.weight == 256) strip.alone[lane] = kSecondSeesLayer0;
        // Without a shape a ray shows the foot's depth 0: what a lane without bands does, since its weight is 0.
        if (setup.cells != nullptr) set_cells(shape, setup.cells, lane, strip);
        strip.foot_depth[lane] = setup.foot_depth;
        strip.lambda_foot_q20[lane] = setup.lambda_foot_q20;
        strip.lambda0_q20[lane] = setup.lambda0_q20;
        strip.lambda1_q24[lane] = setup.lambda1_q24;
        strip.inverse_r_q20[lane] = setup.inverse_r_q20;
        strip.inverse_rho_q20[lane] = setup.inverse_rho_q20;
    }
    return strip;
}

}  // namespace rs::engine
