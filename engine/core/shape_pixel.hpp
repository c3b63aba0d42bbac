#pragma once
// Section 6 of engine/RECONSTRUCTION.md: one pixel of a view ray that set_up_shape() has set up. The readable
// definition; engine/core/shape_walk.hpp is its fast twin.

#include "engine/core/fixed_point.hpp"
#include "engine/core/shape_setup.hpp"
#include "rayspace/image.hpp"
#include "rayspace/ray_space_object.hpp"

#include <cstdint>
#include <cstdlib>

namespace rs::engine {

struct ShapePixel {
    Rgba8 colour;
    std::int32_t lambda_q20 = 0;  // axial depth in the view; only where colour.a > 0
};

// What the view ray finds at height `rise` per axial depth (view row j: (rise form at (i, j)) >> 8). Texel(view, column,
// row) gives a stored pixel.
template <class Texel>
ShapePixel shape_pixel(const RaySpaceObject& object, const ViewRegisters& registers, const ShapeSetup& setup,
                       std::int32_t rise_q24, const Texel& texel);

inline constexpr std::int32_t kNearest_q20 = 1 << 17;  // axial depth in a captured picture
inline constexpr int kTransparentScore = 96;   // of two rays that both see nothing
inline constexpr int kSingleScore = 48;        // of a layer that one ray alone sees

namespace shape_pixel_detail {

inline ShapeCell cell_at(const ShapeMap& shape, const ShapeSetup& setup, std::int32_t band_q12) {
    const std::int32_t band = band_q12 >> 12;
    return band >= 0 && band < shape.bands ? setup.cells[band] : ShapeCell{};
}

// Follows the ray from band to band, from the viewer's side, and gives the cells whose surfaces it meets one after the
// other. The ray passes reference heights in bands linear in depth: band = zero + d * per_depth.
class CellMarch {
public:
    CellMarch(const ShapeMap& shape, const ShapeSetup& setup, std::int32_t b_q16, std::int32_t rise_q24)
        : shape_(shape), setup_(setup) {
        const std::int32_t h_q16 = b_q16 + multiply_shift(setup.lambda_foot_q20, rise_q24, 28);
        const std::int32_t slope_q20 = multiply_shift(rise_q24, setup.inverse_r_q20, 24);
        const std::int32_t reference_q20 =
            multiply_shift(h_q16 - (shape.reference_height_q20 >> 4), setup.inverse_rho_q20, 16);
        const std::int32_t bands_per_radius_q20 =
            multiply_shift(slope_q20 - reference_q20, shape.bands_per_unit_q12, 12);
        foot_q12_ = multiply_shift(h_q16 - (shape.h_low_q20 >> 4), shape.bands_per_unit_q12, 16);
        per_depth_q20_ = multiply_shift(bands_per_radius_q20, shape.depth_step_q24, 24);
        zero_q12_ = foot_q12_ + multiply_shift(bands_per_radius_q20, shape.depth_low_q20, 28);
        static const int fine = getenv("FINE") ? atoi(getenv("FINE")) : 1;
        const int span = std::min(((std::abs(per_depth_q20_) * fine) >> 12) + 1, 64);
        step_ = 256 / span;
        if (span <= 1) begin_ = 256;
    }

    // A cell without rays at the end.
    ShapeCell next() {
        while (begin_ < 256) {
            const int begin = begin_;
            begin_ += step_;
            ShapeCell cell = cell_at(shape_, setup_, at(begin + step_ / 2));
            if (cell.rays == 0) continue;
            const int nearest = (cell.rays & 12) != 0 ? std::min(cell.depth[0], cell.depth[1]) : cell.depth[0];
            if (nearest > begin_ || cell.back < begin) continue;
            static const bool refine = getenv("REFINE") != nullptr;
            if (refine && nearest >= begin) {
                const ShapeCell there = cell_at(shape_, setup_, at(nearest));
                if (there.rays != 0) cell = there;
            }
            static const int riser = getenv("RISER") ? atoi(getenv("RISER")) : 0;
            const int beyond = riser == 0 ? begin : riser == 1 ? std::min<int>(begin_ - 1, std::max<int>(cell.back, begin)) : begin + step_ / 2;
            for (auto& d : cell.depth) if (d < begin) d = static_cast<std::uint8_t>(std::max<int>(d, beyond));
            return cell;
        }
        if (ended_) return {};
        ended_ = true;
        ShapeCell cell = cell_at(shape_, setup_, foot_q12_);
        if (cell.rays != 0) {
            const ShapeCell there = cell_at(shape_, setup_, at(cell.depth[0]));
            if (there.rays != 0) cell = there;
        }
        return cell;
    }

private:
    [[nodiscard]] std::int32_t at(int d) const { return zero_q12_ + ((d * per_depth_q20_) >> 8); }

    const ShapeMap& shape_;
    const ShapeSetup& setup_;
    std::int32_t foot_q12_ = 0;
    std::int32_t zero_q12_ = 0;
    std::int32_t per_depth_q20_ = 0;
    int step_ = 256;
    int begin_ = 0;
    bool ended_ = false;
};

// A bilinear sample: sums over four texels of weight * alpha (weights add up to 64) and of weight * alpha * colour.
struct Sample {
    bool exists = false;
    std::int32_t a = 0, r = 0, g = 0, b = 0;
};

struct Layer {
    bool exists = false;
    int score = 0;
    Sample sum;  // both rays: weights add up to 64 * 256
    std::int32_t lambda_q20 = 0;
};

inline constexpr int kOpaque = 64 * 255;

inline Sample blend(const Sample& first, const Sample& second, int weight) {
    const auto mix = [&](int a, int b) { return a * (256 - weight) + b * weight; };
    return {true, mix(first.a, second.a), mix(first.r, second.r), mix(first.g, second.g), mix(first.b, second.b)};
}

inline int disagreement(const Sample& first, const Sample& second) {
    if (first.a == 0 && second.a == 0) return kTransparentScore;
    const auto apart = [](int a, int b) { return std::abs(a - b); };
    return (apart(first.r, second.r) + apart(first.g, second.g) + apart(first.b, second.b) + 2 * 255 * apart(first.a, second.a)) / kOpaque;
}

inline Rgba8 resolve(const Sample& sum) {
    static const double k = getenv("SHARP") ? atof(getenv("SHARP")) : 1;
    const int full = 64 * 255 * 256;
    const int alpha = ((k == 1 ? sum.a : std::clamp((int)((sum.a - full / 2) * k + full / 2), 0, full)) + 64 * 128) >> 14;
    if (alpha == 0 || sum.a == 0) return {};
    const auto channel = [&](int c) { return static_cast<std::uint8_t>((c + sum.a / 2) / sum.a); };
    return {channel(sum.r), channel(sum.g), channel(sum.b), static_cast<std::uint8_t>(alpha)};
}

}  // namespace shape_pixel_detail

template <class Texel>
ShapePixel shape_pixel(const RaySpaceObject& object, const ViewRegisters& registers, const ShapeSetup& setup,
                       std::int32_t rise_q24, const Texel& texel) {
    using namespace shape_pixel_detail;
    const ShapeMap& shape = object.rings[static_cast<std::size_t>(registers.ring)].shape;
    const std::int32_t b_q16 = registers.b_q20 >> 4;
    const bool use_first = setup.weight < 256;
    const bool use_second = setup.weight > 0;

    const auto sample = [&](const ShapePicture& picture, int d, std::int32_t y_q16) -> Sample {
        const CapturedView& view = object.views[static_cast<std::size_t>(picture.view)];
        const std::int32_t l_q20 = picture.l0_q20 + ((d * picture.l1_q24) >> 4);
        if (l_q20 < kNearest_q20) return {};
        const auto inverse_q20 = static_cast<std::int32_t>((std::int64_t{1} << 40) / l_q20);
        const std::int32_t n_q12 = picture.n0_q12 + ((d * picture.n1_q14) >> 2);
        const std::int32_t column_q8 = (view.cx_q16 >> 8) + multiply_shift(n_q12, inverse_q20, 24);
        const std::int32_t m_q12 = multiply_shift(view.fl_y_q16 >> 8, inverse_q20, 16);
        const std::int32_t row_q8 = (view.cy_q16 >> 8) - multiply_shift(m_q12, y_q16 - (view.height_q20 >> 4), 20);
        const std::int32_t column = column_q8 >> 8;
        const std::int32_t row = row_q8 >> 8;
        if (column < 0 || column >= object.width || row < 0 || row >= object.height) return {};
        const std::int32_t x_q3 = (column_q8 - 128 + 16) >> 5;
        const std::int32_t y_q3 = (row_q8 - 128 + 16) >> 5;
        Sample sum{true};
        for (int k = 0; k < 4; ++k) {
            const int dx = k & 1, dy = k >> 1;
            const int w = (dx ? (x_q3 & 7) : 8 - (x_q3 & 7)) * (dy ? (y_q3 & 7) : 8 - (y_q3 & 7));
            const Rgba8 t = texel(picture.view, std::clamp((x_q3 >> 3) + dx, 0, object.width - 1), std::clamp((y_q3 >> 3) + dy, 0, object.height - 1));
            sum.a += w * t.a;
            sum.r += w * t.a * t.r;
            sum.g += w * t.a * t.g;
            sum.b += w * t.a * t.b;
        }
        return sum;
    };
    const auto layer = [&](const ShapeCell& cell, int n) -> Layer {
        const int d = cell.depth[n];
        Layer found;
        found.lambda_q20 = setup.lambda0_q20 + ((d * setup.lambda1_q24) >> 4);
        if (found.lambda_q20 <= 0) return {};
        const std::int32_t y_q16 = b_q16 + multiply_shift(found.lambda_q20, rise_q24, 28);
        const bool first_sees = use_first && (cell.rays & (kFirstSeesLayer0 << (2 * n))) != 0;
        const bool second_sees = use_second && (cell.rays & (kSecondSeesLayer0 << (2 * n))) != 0;
        const Sample first = first_sees ? sample(setup.first, d, y_q16) : Sample{};
        const Sample second = second_sees ? sample(setup.second, d, y_q16) : Sample{};
        found.exists = first.exists || second.exists;
        if (first.exists && second.exists) {
            found.sum = blend(first, second, setup.weight);
            found.score = disagreement(first, second);
            static const int rule = getenv("RULE") ? atoi(getenv("RULE")) : 0;
            if (rule == 1 && (first.a == 0 || second.a == 0)) found.sum = {};
            if (rule == 2 && first.a < second.a) found.sum = blend(first, first, 0);
            if (rule == 2 && first.a >= second.a) found.sum = blend(second, second, 0);
        } else {
            const Sample& one = first.exists ? first : second;
            found.sum = blend(one, one, 0);
            found.score = one.a == 0 ? kTransparentScore : kSingleScore;
        }
        return found;
    };
    const auto better_layer = [&](const ShapeCell& cell) {
        Layer best = layer(cell, 0);
        const Layer other = layer(cell, 1);
        if (other.exists && (!best.exists || other.score < best.score)) best = other;
        return best;
    };
    const auto pixel = [](const Layer& layer) {
        return ShapePixel{layer.exists ? resolve(layer.sum) : Rgba8{}, layer.lambda_q20};
    };
    if (setup.cells == nullptr) return pixel(layer({{0, 0}, 0, kFirstSeesLayer0}, 0));
    CellMarch march(shape, setup, b_q16, rise_q24);
    ShapeCell cell = march.next();
    if (!(use_first && use_second)) {
        const auto foot = std::clamp<std::int64_t>(-shape.depth_low_q20 * std::int64_t{16} / shape.depth_step_q24, 0, 255);
        if (cell.rays == 0) cell.depth[0] = static_cast<std::uint8_t>(foot);
        cell.rays = use_first ? kFirstSeesLayer0 : kSecondSeesLayer0;
        return pixel(layer(cell, 0));
    }
    for (; cell.rays != 0; cell = march.next()) {
        const Layer best = better_layer(cell);
        if (best.exists && best.sum.a > 0) return pixel(best);
    }
    return {};
}

}  // namespace rs::engine
