// Set-up of neighbouring columns for shape_walk.cpp.

#include "engine/core/definition/effective_depth.hpp"
#include "engine/core/definition/fixed_point.hpp"
#include "engine/core/definition/shape_pixel.hpp"
#include "engine/core/fast/shape_walk.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::engine {
namespace {

// Range of depths in which section 7's integers deviate less than half a column from the exact quotient. Nearer points
// are not visible; at farther ones the reciprocal has too few bits.
constexpr std::int64_t kMaxBracketDepth_q20 = std::int64_t{1} << 26;
constexpr std::int64_t kMaxLateral_q12 = std::int64_t{1} << 30;

// Bilinear reads need one column on either side; a second one covers rounding.
constexpr int kMargin = 2;

ShapeImageColumn image_column(const RaySpaceObject& object, const TexelStore& texels, const ShapeImage& image) {
    if (texels.is_coded()) {
        const ColumnRange columns = sampled_columns(object, image);
        if (columns.first <= columns.last) texels.ensure(image.view, columns.first, columns.last);
    }
    const CapturedView& view = object.views[static_cast<std::size_t>(image.view)];
    ShapeImageColumn column;
    column.used = true;
    column.start = texels.column_start(image.view, 0);
    column.l0_q20 = image.l0_q20;
    column.l1_q24 = image.l1_q24;
    column.n0_q12 = image.n0_q12;
    column.n1_q12 = image.n1_q12;
    column.cx_q8 = view.cx_q16 >> 8;
    column.cy_q8 = view.cy_q16 >> 8;
    column.fl_y_q8 = view.fl_y_q16 >> 8;
    column.height_q16 = view.height_q20 >> 4;
    return column;
}

void set_surfaces(const ShapeMap& shape, const ShapeSetup& setup, std::size_t start, SurfaceEntries& entries,
                  ShapeColumn& column) {
    const SurfaceColumn surfaces = setup.has_shape() ? build_surface_column(setup.cells, shape, start, entries)
                                                     : build_empty_column(start, entries);
    column.smooth = entries.smooth.data() + start;
    column.deepest = entries.deepest.data() + start;
    column.steps = entries.steps.data() + kSurfaceParts * start;
    column.last_entry = surfaces.last;
    column.first_middle_q12 = (surfaces.first_band << 12) + (1 << 11);
    column.nearest = surfaces.nearest;
    column.beyond = surfaces.beyond;
}

// Section 6 at the first or last row of the view, without rounding. Apart from rounding everything is linear in the
// rise, so the values of all other rows are between those of the two ends.
struct BandsAtEnd {
    double foot_q12 = 0;
    double per_depth_q20 = 0;
    double largest = 0;  // magnitude of the largest number that may saturate

    [[nodiscard]] double band_q12(std::int32_t effective_q3) const {
        return foot_q12 + effective_q3 * per_depth_q20 * 0x1p-11;
    }
};

BandsAtEnd bands_at_end(const ShapeWalk& walk, const ShapeSetup& setup, double rise_q24) {
    const double h = walk.b_q16 + setup.lambda_foot_q20 * rise_q24 * 0x1p-28;
    const double slope = rise_q24 * setup.inverse_r_q20 * 0x1p-24;
    const double reference = (h - walk.reference_height_q16) * setup.inverse_rho_q20 * 0x1p-16;
    const double per_radius = (slope - reference) * walk.bands_per_unit_q12 * 0x1p-12;
    BandsAtEnd bands;
    bands.foot_q12 = (h - walk.h_low_q16) * walk.bands_per_unit_q12 * 0x1p-16;
    bands.per_depth_q20 = per_radius * walk.depth_step_q24 * 0x1p-24;
    bands.largest = std::max({std::abs(reference), std::abs(per_radius), std::abs(bands.foot_q12)});
    return bands;
}

// Upper bounds of the rounding errors.
struct BandErrors {
    double band_q12 = 0;
    double per_depth_q20 = 0;
};

BandErrors band_errors(const ShapeWalk& walk, const ShapeSetup& setup) {
    const double h = 2 + std::abs(setup.lambda_foot_q20) * 0x1p-28;
    const double slope = 2 + setup.inverse_r_q20 * 0x1p-24;
    const double reference = 1 + h * setup.inverse_rho_q20 * 0x1p-16;
    const double per_radius = 1 + (slope + reference) * walk.bands_per_unit_q12 * 0x1p-12;
    const double foot = 1 + h * walk.bands_per_unit_q12 * 0x1p-16;
    const double per_depth = 1 + per_radius * walk.depth_step_q24 * 0x1p-24;
    constexpr double kOfThreeBits = 8;
    return {1 + foot + (per_depth + kOfThreeBits) * EffectiveDepth::kMax_q3 * 0x1p-11, per_depth};
}

// Computes the range of rows that read non-empty entries, and `level`.
void set_row_range(const ShapeWalk& walk, const ShapeSetup& setup, ShapeColumn& column) {
    constexpr double kMinMarching_q20 = 2048;     // least per_depth of a ray that marches
    constexpr double kMaxPerDepth_q20 = 1 << 21;  // 2^22 would be clamped
    constexpr double kMaxNumber = 1 << 28;        // 2^29 would saturate
    const BandsAtEnd first = bands_at_end(walk, setup, walk.first_rise_q24);
    const BandsAtEnd last = bands_at_end(walk, setup, walk.last_rise_q24);
    const bool is_unsaturated = std::max(first.largest, last.largest) <= kMaxNumber;
    const double per_depth = std::max(std::abs(first.per_depth_q20), std::abs(last.per_depth_q20));
    const BandErrors errors = band_errors(walk, setup);
    column.level = is_unsaturated && per_depth + errors.per_depth_q20 < kMinMarching_q20;
    column.first_row = 0;
    column.end_row = walk.rows;
    if (column.alone || !is_unsaturated || per_depth > kMaxPerDepth_q20) return;
    if (column.beyond == 0) {
        column.end_row = 0;
        return;
    }
    const double low_q12 = column.first_middle_q12 - errors.band_q12;
    const double high_q12 = column.first_middle_q12 + (column.last_entry << 12) + errors.band_q12;
    double begin = walk.rows;
    double end = 0;
    const auto include = [&](double at_first, double at_last) {
        const double per_row = (at_last - at_first) / (walk.rows - 1);
        const double at_low = (low_q12 - at_first) / per_row;
        const double at_high = (high_q12 - at_first) / per_row;
        begin = std::min({begin, at_low, at_high});
        end = std::max({end, at_low, at_high});
        return per_row;
    };
    const double foot_per_row = include(first.foot_q12, last.foot_q12);
    bool same_way = std::abs(foot_per_row) > 0;
    for (const std::int32_t effective_q3 :
         {walk.effective_depth_q3[0], walk.effective_depth_q3[EffectiveDepth::kDepths - 1]}) {
        if (column.level) break;
        const double per_row = include(first.band_q12(effective_q3), last.band_q12(effective_q3));
        same_way = same_way && foot_per_row * per_row > 0;
    }
    if (!same_way) return;
    column.first_row = static_cast<std::int32_t>(std::clamp<double>(std::floor(begin) - 1, 0, walk.rows));
    column.end_row = static_cast<std::int32_t>(std::clamp<double>(std::ceil(end) + 2, column.first_row, walk.rows));
}

}  // namespace

ColumnRange sampled_columns(const RaySpaceObject& object, const ShapeImage& image) {
    const ColumnRange whole{0, object.width - 1};
    const std::int32_t cx_q8 = object.views[static_cast<std::size_t>(image.view)].cx_q16 >> 8;
    // The column is a quotient of linear functions of depth. It is between its values at both ends if the divisor is
    // positive at both.
    std::int64_t least_q8 = 0;
    std::int64_t most_q8 = 0;
    for (const int d_q3 : {0, 255 * 8}) {
        const std::int64_t l_q20 = image.l0_q20 + ((std::int64_t{d_q3} * image.l1_q24) >> 7);
        const std::int64_t n_q12 = image.n0_q12 + ((std::int64_t{d_q3} * image.n1_q12) >> 3);
        if (l_q20 < kNearest_q20 || l_q20 > kMaxBracketDepth_q20) return whole;
        if (n_q12 < -kMaxLateral_q12 || n_q12 > kMaxLateral_q12) return whole;
        const auto inverse_q20 = static_cast<std::int32_t>((std::int64_t{1} << 40) / l_q20);
        const std::int64_t column_q8 =
            std::int64_t{cx_q8} + multiply_shift(static_cast<std::int32_t>(n_q12), inverse_q20, 24);
        least_q8 = d_q3 == 0 ? column_q8 : std::min(least_q8, column_q8);
        most_q8 = d_q3 == 0 ? column_q8 : std::max(most_q8, column_q8);
    }
    const std::int64_t first = std::max<std::int64_t>((least_q8 >> 8) - kMargin, 0);
    const std::int64_t last = std::min<std::int64_t>((most_q8 >> 8) + kMargin, object.width - 1);
    if (first > last) return {};
    return {static_cast<int>(first), static_cast<int>(last)};
}

ShapeWalk set_up_walk(const RaySpaceObject& object, const TexelStore& texels, const ViewRegisters& registers) {
    const ShapeMap& shape = object.rings[static_cast<std::size_t>(registers.ring)].shape;
    ShapeWalk walk;
    walk.texels = texels.texels();
    if (registers.filter != TexelFilter::kBilinear) walk.details = texels.details();
    walk.filter = registers.filter;
    walk.column_stride = texels.column_stride();
    walk.width = object.width;
    walk.height = object.height;
    walk.rows = registers.height;
    walk.first_rise_q24 = registers.rise_q24(0, 0);
    walk.last_rise_q24 = registers.rise_q24(0, registers.height - 1);
    walk.b_q16 = registers.b_q20 >> 4;
    walk.reference_height_q16 = shape.reference_height_q20 >> 4;
    walk.h_low_q16 = shape.h_low_q20 >> 4;
    walk.bands_per_unit_q12 = shape.bands_per_unit_q12;
    walk.thickness = shape.thickness;
    walk.depth_step_q24 = shape.depth_step_q24;
    const std::array<std::int32_t, EffectiveDepth::kDepths> table = EffectiveDepth(shape).table();
    std::copy(table.begin(), table.end(), walk.effective_depth_q3.begin());
    return walk;
}

void set_up_shape_strip(const RaySpaceObject& object, const TexelStore& texels, const ViewRegisters& registers,
                        const ShapeWalk& walk, int first_column, ShapeStrip& strip) {
    const ShapeMap& shape = object.rings[static_cast<std::size_t>(registers.ring)].shape;
    const std::size_t entries = surface_entries(shape.bands);
    strip.entries.grow(kStripColumns * entries);
    const int columns = std::min(kStripColumns, registers.width - first_column);
    for (int n = 0; n < kStripColumns; ++n) {
        ShapeColumn& column = strip.columns[n];
        column = {};
        if (n >= columns) continue;
        const ShapeSetup setup = set_up_shape(object, registers, first_column + n, 0);
        if (!setup.has_ray) continue;
        if (setup.weight < 256) column.first = image_column(object, texels, setup.first);
        if (setup.weight > 0) column.second = image_column(object, texels, setup.second);
        column.weight = setup.weight;
        // A ray without a shape is rendered at the foot's depth 0, like a ray of weight 0 without surfaces.
        column.alone = setup.weight == 0 || setup.weight == 256;
        set_surfaces(shape, setup, static_cast<std::size_t>(n) * entries, strip.entries, column);
        column.foot_depth_q3 = setup.foot_depth_q3;
        column.lambda_foot_q20 = setup.lambda_foot_q20;
        column.lambda0_q20 = setup.lambda0_q20;
        column.lambda1_q21 = setup.lambda1_q21;
        column.inverse_r_q20 = setup.inverse_r_q20;
        column.inverse_rho_q20 = setup.inverse_rho_q20;
        set_row_range(walk, setup, column);
    }
}

}  // namespace rs::engine
