#pragma once
// Alpha coded as a mask: one bit per sample, set if alpha is one half or more, and the reconstruction of alpha from a
// tile's masks. Integer and normative: encode/FORMAT.md, section "Masks". No function allocates.

#include "rayspace/codec/code/dense_code.hpp"
#include "rayspace/codec/dense_tile.hpp"
#include "rayspace/codec/prediction_unit.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace rs::codec {

constexpr int mask_of_level(int level, int bits) {
    return level >> (bits - 1);
}

/// Weighted sum of the mask around (x, y) with weights 1 2 1, 2 4 2, 1 2 1: 0 .. 16. Samples outside of the tile (width
/// x height samples) repeat the nearest ones inside.
inline int mask_sum(const AlphaLevels& mask, int x, int y, int width, int height) {
    const int left = std::max(x - 1, 0);
    const int right = std::min(x + 1, width - 1);
    const auto row = [&](int at) { return mask.at(left, at) + 2 * mask.at(x, at) + mask.at(right, at); };
    return row(std::max(y - 1, 0)) + 2 * row(y) + row(std::min(y + 1, height - 1));
}

/// The weight in `sum` of samples that differ from the centre: 0 .. 12.
constexpr int differing_weight(int mask, int sum) {
    return mask != 0 ? 16 - sum : sum;
}

/// Alpha reconstructed from the mask only, with the object's mean edge softness.
inline int smooth_alpha(const EdgeAlpha& edge, int mask, int sum) {
    const int weight = differing_weight(mask, sum);
    const int off = weight == 0 ? 0 : edge[static_cast<std::size_t>(kEdgeWeights * mask + weight - 1)];
    return mask != 0 ? 255 - off : off;
}

/// The references' alpha at sample (x, y) of the image, interpolated between samples; -1 if the unit has no references.
int interpolate_alpha(Source source, const std::array<MotionVector, 2>& motion,
                      const std::array<ConstPlaneViews, 2>& references, int x, int y);

/// The first index of context::kMask.
constexpr int mask_context(int alpha) {
    if (alpha < 0) return 0;
    if (alpha == 0) return 1;
    return alpha < 64 ? 2 : alpha < 112 ? 3 : alpha < 144 ? 4 : alpha < 192 ? 5 : alpha < 255 ? 6 : 7;
}

/// A tile whose masks and units are known.
struct MaskedTile {
    const TileGrid& grid;
    const AlphaLevels& mask;
    AlphaLevels& depths;  // values for syntax::alpha_depth if the coder writes; filled in
    const std::array<ConstPlaneViews, 2>& references;
    const TileRect& place;
    const ImageView<std::uint8_t>& out;  // alpha of the image
};

/// Finishes a tile's alpha: smooths it, or codes the further bits.
template <class Coder>
class AlphaFinisher {
public:
    AlphaFinisher(Coder& coder, const DenseCode& code, const MaskedTile& tile)
        : coder_(coder),
          bits_(code.alpha_bits),
          edge_(code.edge_alpha),
          grid_(tile.grid),
          mask_(tile.mask),
          depths_(tile.depths),
          references_(tile.references),
          place_(tile.place),
          out_(tile.out) {}

    void finish() {
        for (int by = 0; by < place_.height / kBlock; ++by) {
            for (int bx = 0; bx < place_.width / kBlock; ++bx) {
                if (grid_.at(bx, by).source == Source::kNone) continue;
                if (bits_ > 1) {
                    if (grid_.at(bx, by).alpha == AlphaClass::kMixed) refine(bx, by);
                } else if (!is_uniform(bx, by)) {
                    smooth(bx, by);
                }
            }
        }
    }

private:
    // True if a block is not mixed and its neighbours in the tile have the same class.
    [[nodiscard]] bool is_uniform(int bx, int by) const {
        const AlphaClass own = grid_.at(bx, by).alpha;
        if (own == AlphaClass::kMixed) return false;
        for (int y = std::max(by - 1, 0); y <= std::min(by + 1, place_.height / kBlock - 1); ++y) {
            for (int x = std::max(bx - 1, 0); x <= std::min(bx + 1, place_.width / kBlock - 1); ++x) {
                if (grid_.at(x, y).alpha != own) return false;
            }
        }
        return true;
    }

    void smooth(int bx, int by) {
        for (int y = by * kBlock; y < (by + 1) * kBlock; ++y) {
            for (int x = bx * kBlock; x < (bx + 1) * kBlock; ++x) {
                out_(place_.left + x, place_.top + y) = static_cast<std::uint8_t>(
                    smooth_alpha(edge_, mask_.at(x, y), mask_sum(mask_, x, y, place_.width, place_.height)));
            }
        }
    }

    // The depth at (x, y) relative to the mask `own`. A sample with the other mask counts as deeper than all depths.
    [[nodiscard]] int depth_relative_to(int x, int y, int own) const {
        return mask_.at(x, y) == own ? depths_.at(x, y) : (1 << (bits_ - 1)) - 1;
    }

    int code_depth(int x, int y, int mask, int sum, int predicted) {
        const bool has_west = x > 0;
        const bool has_north = y > 0;
        int west = has_west ? depth_relative_to(x - 1, y, mask) : 0;
        int north = has_north ? depth_relative_to(x, y - 1, mask) : west;
        if (!has_west) west = north;
        const int north_west = has_west && has_north ? depth_relative_to(x - 1, y - 1, mask) : west;
        // Gradient prediction, clamped to the range of both neighbours.
        const int guess = std::clamp(west + north - north_west, std::min(west, north), std::max(west, north));
        const int activity = std::abs(west - north_west) + std::abs(north - north_west);
        const int beside = differing_weight(mask, sum) != 0 ? 1 : 0;
        return syntax::alpha_depth(coder_, bits_, guess, activity, beside, predicted, depths_.at(x, y));
    }

    void refine(int bx, int by) {
        const BlockInfo& info = grid_.at(bx, by);
        const int full = (1 << bits_) - 1;
        for (int y = by * kBlock; y < (by + 1) * kBlock; ++y) {
            for (int x = bx * kBlock; x < (bx + 1) * kBlock; ++x) {
                const int mask = mask_.at(x, y);
                const int interpolated =
                    interpolate_alpha(info.source, info.motion, references_, place_.left + x, place_.top + y);
                const int predicted = interpolated < 0 ? 0 : interpolated < 32 || interpolated > 223 ? 1 : 2;
                const int sum = mask_sum(mask_, x, y, place_.width, place_.height);
                const int neighbours = (depths_.at(x - 1, y) != 0 ? 1 : 0) + (depths_.at(x, y - 1) != 0 ? 1 : 0);
                const int depth = bits_ == 2
                                      ? syntax::alpha_inner(coder_, mask, sum, neighbours, predicted, depths_.at(x, y))
                                      : code_depth(x, y, mask, sum, predicted);
                depths_.at(x, y) = static_cast<std::uint8_t>(depth);
                out_(place_.left + x, place_.top + y) =
                    static_cast<std::uint8_t>(alpha_of_level(mask != 0 ? full - depth : depth, bits_));
            }
        }
    }

    Coder& coder_;
    int bits_;
    const EdgeAlpha& edge_;
    const TileGrid& grid_;
    const AlphaLevels& mask_;
    AlphaLevels& depths_;
    const std::array<ConstPlaneViews, 2>& references_;
    const TileRect& place_;
    const ImageView<std::uint8_t>& out_;
};

}  // namespace rs::codec
