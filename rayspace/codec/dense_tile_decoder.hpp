#pragma once
// Decoding steps of a tile of a dense image, for any reading Coder (syntax.hpp), such as a decoder or one that also
// measures.

#include "rayspace/codec/alpha_mask.hpp"
#include "rayspace/codec/deblocking.hpp"
#include "rayspace/codec/dense_tile.hpp"
#include "rayspace/codec/prediction_unit.hpp"
#include "rayspace/codec/reconstruct_unit.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace rs::codec {

template <class Coder>
class DenseTileDecoder {
public:
    /// \param reader  reads tile.bytes.
    DenseTileDecoder(Coder& reader, const DenseCode& code, const CodedTile& tile, const PlaneViews& out)
        : code_(code),
          head_(tile.head),
          reader_(reader),
          place_(tile.place),
          left_(tile.place.left),
          top_(tile.place.top),
          references_(tile.references),
          listener_(tile.listener),
          out_(out),
          around_{tile.head.references(), tile.head.global_motion} {}

    void decode() {
        for (int y = 0; y < place_.height; y += kMacroblock) {
            for (int x = 0; x < place_.width; x += kMacroblock) macroblock(x / kBlock, y / kBlock);
        }
        if (code_.has_masks) {
            AlphaFinisher(reader_, code_,
                          {.grid = grid_,
                           .mask = alpha_,
                           .depths = depths_,
                           .references = references_,
                           .place = place_,
                           .out = out_[3]})
                .finish();
        }
        filter_edges(grid_, code_, head_.step, place_, out_);
    }

private:
    void macroblock(int bx, int by) {
        if (!code_macroblock_alpha(reader_, grid_, bx, by)) {
            clear_tile({left_ + bx * kBlock, top_ + by * kBlock, kMacroblock, kMacroblock}, out_);
            return;
        }
        if (!syntax::split(reader_, grid_, bx, by, false)) {
            unit({bx, by, kMacroblock});
            return;
        }
        for (int i = 0; i < 4; ++i) grid_.at(bx + (i & 1), by + (i >> 1)).split = true;
        for (int i = 0; i < 4; ++i) {
            const PredictionUnit quarter{bx + (i & 1), by + (i >> 1), kBlock};
            if (grid_.at(quarter.bx, quarter.by).alpha != AlphaClass::kEmpty) {
                unit(quarter);
            } else {
                clear_tile({left_ + quarter.bx * kBlock, top_ + quarter.by * kBlock, kBlock, kBlock}, out_);
            }
        }
    }

    void unit(const PredictionUnit& unit) {
        UnitChoice& choice = choice_;
        choice.coded = false;
        code_prediction(reader_, grid_, unit, around_, choice);
        if (listener_ != nullptr) notify_listener(unit, choice);
        if (code_.has_masks) {
            mask(unit, choice);
        } else {
            alpha(unit, choice);
        }
        code_coefficients(reader_, grid_, unit, code_.sign_data_hiding, choice);
        const UnitPosition place = unit_position(grid_, unit, left_, top_);
        reconstruct_unit(choice, place, head_.step, code_, references_, out_);
        record_unit(grid_, unit, choice);
        if (choice.coded) clear_levels(unit, choice);
    }

    void notify_listener(const PredictionUnit& unit, const UnitChoice& choice) {
        for (int r = 0; r < 2; ++r) {
            if (!uses(choice.source, r)) continue;
            const MotionVector motion = choice.motion[static_cast<std::size_t>(r)];
            const int x = left_ + unit.bx * kBlock + (motion.x >> 2);
            const int y = top_ + unit.by * kBlock + (motion.y >> 2);
            const int width = out_[0].width();
            const int height = out_[0].height();
            listener_->need(r, std::clamp(x - kTapsBefore, 0, width - 1), std::clamp(y - kTapsBefore, 0, height - 1),
                            std::clamp(x + unit.size + kTapsAfter, 1, width),
                            std::clamp(y + unit.size + kTapsAfter, 1, height));
        }
    }

    void alpha(const PredictionUnit& unit, const UnitChoice& choice) {
        const auto& plane = out_[3];
        for (int i = 0; i < unit.blocks() * unit.blocks(); ++i) {
            const int bx = unit.bx + (i & (unit.blocks() - 1));
            const int by = unit.by + i / unit.blocks();
            const AlphaClass kind = grid_.at(bx, by).alpha;
            if (kind == AlphaClass::kMixed) {
                const auto predicted = [&](int x, int y) {
                    return predict_alpha(choice, references_, left_ + x, top_ + y, code_.alpha_bits);
                };
                code_block_alpha(reader_, alpha_, code_.alpha_bits, bx, by, predicted);
            } else {
                alpha_.fill_block(bx, by, kind == AlphaClass::kOpaque ? (1 << code_.alpha_bits) - 1 : 0);
            }
            for (int y = 0; y < kBlock; ++y) {
                std::uint8_t* const row = plane.row(top_ + by * kBlock + y) + left_ + bx * kBlock;
                for (int x = 0; x < kBlock; ++x) {
                    row[x] = static_cast<std::uint8_t>(
                        alpha_of_level(alpha_.at(bx * kBlock + x, by * kBlock + y), code_.alpha_bits));
                }
            }
        }
    }

    // Decodes the unit's mask. Alpha of blocks that are not mixed is written now; AlphaFinisher changes the blocks near
    // an edge.
    void mask(const PredictionUnit& unit, const UnitChoice& choice) {
        for (int i = 0; i < unit.blocks() * unit.blocks(); ++i) {
            const int bx = unit.bx + (i & (unit.blocks() - 1));
            const int by = unit.by + i / unit.blocks();
            const AlphaClass kind = grid_.at(bx, by).alpha;
            if (kind == AlphaClass::kMixed) {
                code_block_mask(reader_, alpha_, bx, by, [&](int x, int y) {
                    return mask_context(
                        interpolate_alpha(choice.source, choice.motion, references_, left_ + x, top_ + y));
                });
                continue;
            }
            alpha_.fill_block(bx, by, kind == AlphaClass::kOpaque ? 1 : 0);
            for (int y = 0; y < kBlock; ++y) {
                std::memset(out_[3].row(top_ + by * kBlock + y) + left_ + bx * kBlock,
                            kind == AlphaClass::kOpaque ? 255 : 0, kBlock);
            }
        }
    }

    static void clear_levels(const PredictionUnit& unit, UnitChoice& choice) {
        for (std::size_t plane = 0; plane < kPlanes; ++plane) {
            for (std::size_t t = 0; t < static_cast<std::size_t>(choice.transforms(unit.size)); ++t) {
                if (choice.plane_coded[plane][t]) choice.levels[plane][t] = Levels{};
            }
        }
        choice.small_transforms = false;
    }

    const DenseCode& code_;
    const ImageHead& head_;
    Coder& reader_;
    TileRect place_;
    int left_;
    int top_;
    const std::array<ConstPlaneViews, 2>& references_;
    ReferenceListener* listener_;
    const PlaneViews& out_;
    UnitSurroundings around_;
    TileGrid grid_;
    AlphaLevels alpha_;
    AlphaLevels depths_;
    UnitChoice choice_;
};

}  // namespace rs::codec
