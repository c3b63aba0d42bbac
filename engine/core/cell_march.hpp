#pragma once
// Section 6 of engine/RECONSTRUCTION.md: which cells of a shape map a view ray meets.

#include "engine/core/fixed_point.hpp"
#include "engine/core/shape_setup.hpp"
#include "rayspace/shape_map.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace rs::engine {

// A ray with the slope of the reference viewpoint's stays in one band. Any other passes from band to band, linearly in
// depth: band = zero + d * per_depth. It is followed away from the viewer in steps of half a band, and gives the cells
// whose object, between nearest layer and back, it meets, one after the other; at the end the one that a ray of
// reference slope would meet.
class CellMarch {
public:
    static constexpr int kMostSteps = 64;
    static constexpr std::int32_t kMostPerDepth_q20 = 1 << 22;

    CellMarch(const ShapeMap& shape, const ShapeSetup& setup, std::int32_t b_q20, std::int32_t rise_q24)
        : cells_(setup.cells), bands_(shape.bands) {
        const std::int32_t h_q16 = (b_q20 >> 4) + multiply_shift(setup.lambda_foot_q20, rise_q24, 28);
        const std::int32_t slope_q20 = multiply_shift(rise_q24, setup.inverse_r_q20, 24);
        const std::int32_t reference_q20 =
            multiply_shift(h_q16 - (shape.reference_height_q20 >> 4), setup.inverse_rho_q20, 16);
        const std::int32_t per_radius_q20 = multiply_shift(slope_q20 - reference_q20, shape.bands_per_unit_q12, 12);
        foot_q12_ = multiply_shift(h_q16 - (shape.h_low_q20 >> 4), shape.bands_per_unit_q12, 16);
        zero_q12_ = foot_q12_ + multiply_shift(per_radius_q20, shape.depth_low_q20, 28);
        per_depth_q20_ =
            std::clamp(multiply_shift(per_radius_q20, shape.depth_step_q24, 24), -kMostPerDepth_q20, kMostPerDepth_q20);
        const int steps = std::min((std::abs(per_depth_q20_) >> 11) + 1, kMostSteps);
        step_ = 256 / steps;
        if (steps == 1) begin_ = 256;
    }

    // The next cell; one without rays at the end.
    ShapeCell next() {
        while (begin_ < 256) {
            const int begin = begin_;
            begin_ += step_;
            ShapeCell cell = cell_at(band_q12(begin + step_ / 2));
            if (cell.rays == 0 || cell.nearest() > begin_ || cell.back < begin) continue;
            for (std::uint8_t& d : cell.depth) d = static_cast<std::uint8_t>(std::max<int>(d, begin));
            return cell;
        }
        if (ended_) return {};
        ended_ = true;
        const ShapeCell cell = cell_at(foot_q12_);
        if (cell.rays == 0) return cell;
        const ShapeCell there = cell_at(band_q12(cell.depth[0]));
        return there.rays == 0 ? cell : there;
    }

private:
    [[nodiscard]] ShapeCell cell_at(std::int32_t at_q12) const {
        const std::int32_t band = at_q12 >> 12;
        return band >= 0 && band < bands_ ? cells_[band] : ShapeCell{};
    }
    [[nodiscard]] std::int32_t band_q12(int d) const { return zero_q12_ + ((d * per_depth_q20_) >> 8); }

    const ShapeCell* cells_;
    int bands_;
    std::int32_t foot_q12_ = 0;
    std::int32_t zero_q12_ = 0;
    std::int32_t per_depth_q20_ = 0;
    int step_ = 256;
    int begin_ = 0;
    bool ended_ = false;
};

}  // namespace rs::engine
