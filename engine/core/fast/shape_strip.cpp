// What shape_walk.cpp walks down: set-ups of neighbouring columns, side by side.

#include "engine/core/fast/shape_columns.hpp"
#include "engine/core/fast/shape_walk.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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
    lanes.n1_q12[lane] = picture.n1_q12;
    lanes.cx_q8[lane] = view.cx_q16 >> 8;
    lanes.cy_q8[lane] = view.cy_q16 >> 8;
    lanes.fl_y_q8[lane] = view.fl_y_q16 >> 8;
    lanes.height_q16[lane] = view.height_q20 >> 4;
}

void set_surfaces(const ShapeMap& shape, const ShapeSetup& setup, int lane, ShapeStrip& strip) {
    const std::size_t start = static_cast<std::size_t>(lane) * surface_entries(shape.bands);
    const SurfaceColumn column = setup.has_shape()
                                     ? lay_surfaces(setup.cells, shape.bands, shape.jump, start, strip.entries)
                                     : lay_nothing(start, strip.entries);
    strip.entry_start[lane] = static_cast<std::int32_t>(start);
    strip.last_entry[lane] = column.last;
    strip.first_middle_q12[lane] = (column.first_band << 12) + (1 << 11);
    strip.nearest[lane] = column.nearest;
    strip.beyond[lane] = column.beyond;
    strip.p_part[lane] = setup.cells.p_part;
}

// Everything of section 6 is linear in the rise but for roundings of a few units, so that the view's ends bound it.
bool is_level(const ShapeWalk& walk, const ShapeSetup& setup) {
    constexpr double kMostPerDepth = 2000;  // 2048 would march
    constexpr double kMost = 1 << 28;       // 2^29 would saturate
    for (const std::int32_t rise_q24 : {walk.first_rise_q24, walk.last_rise_q24}) {
        const double h = walk.b_q16 + std::ldexp(double(setup.lambda_foot_q20) * rise_q24, -28);
        const double slope = std::ldexp(double(rise_q24) * setup.inverse_r_q20, -24);
        const double reference = std::ldexp((h - walk.reference_height_q16) * setup.inverse_rho_q20, -16);
        const double per_radius = std::ldexp((slope - reference) * walk.bands_per_unit_q12, -12);
        const double foot = std::ldexp((h - walk.h_low_q16) * walk.bands_per_unit_q12, -16);
        const double per_depth = std::ldexp(per_radius * walk.depth_step_q24, -24);
        if (std::abs(per_depth) > kMostPerDepth) return false;
        if (std::max({std::abs(reference), std::abs(per_radius), std::abs(foot)}) > kMost) return false;
    }
    return true;
}

}  // namespace

ShapeWalk set_up_walk(const RaySpaceObject& object, const TexelStore& texels, const ViewRegisters& registers) {
    const ShapeMap& shape = object.rings[static_cast<std::size_t>(registers.ring)].shape;
    ShapeWalk walk;
    walk.texels = texels.texels();
    walk.jump = shape.jump;
    walk.column_stride = texels.column_stride();
    walk.width_q8 = object.width << 8;
    walk.height_q8 = object.height << 8;
    walk.first_rise_q24 = registers.rise_q24(0, 0);
    walk.last_rise_q24 = registers.rise_q24(0, registers.height - 1);
    walk.b_q16 = registers.b_q20 >> 4;
    walk.reference_height_q16 = shape.reference_height_q20 >> 4;
    walk.h_low_q16 = shape.h_low_q20 >> 4;
    walk.bands_per_unit_q12 = shape.bands_per_unit_q12;
    walk.depth_low_q20 = shape.depth_low_q20;
    walk.depth_step_q24 = shape.depth_step_q24;
    return walk;
}

void set_up_shape_strip(const RaySpaceObject& object, const TexelStore& texels, const ViewRegisters& registers,
                        const ShapeWalk& walk, int first_column, ShapeStrip& strip) {
    const ShapeMap& shape = object.rings[static_cast<std::size_t>(registers.ring)].shape;
    SurfaceEntries entries = std::move(strip.entries);
    strip = {};
    strip.entries = std::move(entries);
    strip.entries.hold(kStripColumns * surface_entries(shape.bands));
    strip.level = true;
    const int columns = std::min(kStripColumns, registers.width - first_column);
    for (int lane = 0; lane < columns; ++lane) {
        const ShapeSetup setup = set_up_shape(object, registers, first_column + lane, 0);
        if (!setup.has_ray) continue;
        strip.empty = false;
        strip.level = strip.level && is_level(walk, setup);
        if (setup.weight < 256) set_picture(object, texels, setup.first, lane, strip.first);
        if (setup.weight > 0) set_picture(object, texels, setup.second, lane, strip.second);
        strip.weight[lane] = setup.weight;
        strip.first.share[lane] = (256 - setup.weight) * 0x10001;
        strip.second.share[lane] = setup.weight * 0x10001;
        strip.alone[lane] = setup.weight == 0 || setup.weight == 256 ? -1 : 0;
        // Without a shape a ray shows the foot's depth 0: what a lane without surfaces does, since its weight is 0.
        set_surfaces(shape, setup, lane, strip);
        strip.foot_depth_q3[lane] = setup.foot_depth_q3;
        strip.lambda_foot_q20[lane] = setup.lambda_foot_q20;
        strip.lambda0_q20[lane] = setup.lambda0_q20;
        strip.lambda1_q21[lane] = setup.lambda1_q21;
        strip.inverse_r_q20[lane] = setup.inverse_r_q20;
        strip.inverse_rho_q20[lane] = setup.inverse_rho_q20;
    }
}

}  // namespace rs::engine
