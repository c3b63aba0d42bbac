#pragma once
// Section 6 of engine/RECONSTRUCTION.md: intersects a view ray with the surfaces of a shape map.

#include "engine/core/definition/effective_depth.hpp"
#include "engine/core/definition/fixed_point.hpp"
#include "engine/core/definition/shape_cells.hpp"
#include "engine/core/definition/shape_setup.hpp"
#include "rayspace/api/types/shape_map.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <utility>

namespace rs::engine {

// Marches a view ray through the bands of a shape map and enumerates the surfaces that it meets.
//
// A ray with the slope of the reference viewpoint's ray stays in one band. Any other ray crosses bands, linearly in
// the effective depth: band = foot + effective depth * per_depth. The march goes away from the viewer in steps of about
// half a band. A step meets the surface of its band if the surface is in front of the end of the step, and the step
// begins at most the map's thickness behind the deepest surrounding cell. The march ends with the surface that a ray of
// reference slope would meet, and the surfaces that may lie behind it.
class CellMarch {
public:
    static constexpr int kMaxSteps = 64;
    static constexpr std::int32_t kMaxPerDepth_q20 = 1 << 22;

    CellMarch(const ShapeMap& shape, const ShapeSetup& setup, std::int32_t b_q20, std::int32_t rise_q24)
        : cells_(setup.cells),
          effective_depth_(shape),
          bands_(shape.bands),
          jump_(shape.jump),
          thickness_(shape.thickness) {
        const std::int32_t h_q16 = (b_q20 >> 4) + multiply_shift(setup.lambda_foot_q20, rise_q24, 28);
        const std::int32_t slope_q20 = multiply_shift(rise_q24, setup.inverse_r_q20, 24);
        const std::int32_t reference_q20 =
            multiply_shift(h_q16 - (shape.reference_height_q20 >> 4), setup.inverse_rho_q20, 16);
        const std::int32_t per_radius_q20 = multiply_shift(slope_q20 - reference_q20, shape.bands_per_unit_q12, 12);
        foot_q12_ = multiply_shift(h_q16 - (shape.h_low_q20 >> 4), shape.bands_per_unit_q12, 16);
        const std::int32_t per_depth_q20 =
            std::clamp(multiply_shift(per_radius_q20, shape.depth_step_q24, 24), -kMaxPerDepth_q20, kMaxPerDepth_q20);
        per_depth_q17_ = per_depth_q20 >> 3;
        const int steps = std::min((std::abs(per_depth_q20) >> 11) + 1, kMaxSteps);
        step_ = 256 / steps;
        if (steps == 1) begin_ = 256;
    }

    /// Next surface along the ray; exists() is false after the last one.
    SurfaceCell next() {
        while (begin_ < 256) {
            const int begin = begin_;
            begin_ += step_;
            SurfaceCell cell = surfaces_at(band_q12(begin + step_ / 2)).first;
            if (!cell.exists() || cell.depth_q3 > 8 * begin_ || cell.deepest + thickness_ < begin) continue;
            cell.depth_q3 = std::max(cell.depth_q3, 8 * begin);
            return cell;
        }
        if (ended_) return std::exchange(behind_.exists() ? behind_ : farthest_, {});
        ended_ = true;
        const SurfaceStack at_foot = surfaces_at(foot_q12_);
        if (!at_foot.first.exists()) return {};
        const SurfaceStack there = surfaces_at(band_q12(at_foot.first.depth_q3 >> 3));
        const SurfaceStack& last = there.first.exists() ? there : at_foot;
        behind_ = last.behind;
        farthest_ = last.farthest;
        return last.first;
    }

    /// True once next() has reached the surfaces at the end of the march.
    [[nodiscard]] bool at_end() const { return ended_; }

private:
    // Surfaces at a band coordinate. Cells are samples at the centres of their bands.
    [[nodiscard]] SurfaceStack surfaces_at(std::int32_t at_q12) const {
        const std::int32_t from_middle_q12 = at_q12 - (1 << 11);
        const std::int32_t band = from_middle_q12 >> 12;
        SurfaceCell around[2][2];
        for (int p = 0; p < 2; ++p) {
            for (int h = 0; h < 2; ++h) {
                if (band + h < 0 || band + h >= bands_) continue;
                around[p][h] =
                    between_lines(cells_.at[p][0][band + h], cells_.at[p][1][band + h], cells_.line_part, jump_);
            }
        }
        return surfaces_between(around, cells_.p_part, (from_middle_q12 >> 9) & 7, jump_);
    }
    [[nodiscard]] std::int32_t band_q12(int d) const {
        return foot_q12_ + ((effective_depth_.at(d) * per_depth_q17_) >> 8);
    }

    const CellColumns& cells_;
    EffectiveDepth effective_depth_;
    int bands_;
    int jump_;
    int thickness_;
    std::int32_t foot_q12_ = 0;
    std::int32_t per_depth_q17_ = 0;
    int step_ = 256;
    int begin_ = 0;
    bool ended_ = false;
    SurfaceCell behind_, farthest_;  // returned after the last surface of the march
};

}  // namespace rs::engine
