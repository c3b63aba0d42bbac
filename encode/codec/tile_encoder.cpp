#include "encode/codec/tile_encoder.hpp"

#include "encode/codec/mode_decision.hpp"
#include "rayspace/codec/alpha_mask.hpp"
#include "rayspace/codec/deblocking.hpp"
#include "rayspace/codec/prediction_unit.hpp"
#include "rayspace/codec/reconstruct_unit.hpp"

#include <algorithm>
#include <memory>

namespace rs::encode {
namespace {

using codec::AlphaClass;
using codec::kBlock;
using codec::kMacroblock;
using codec::PredictionUnit;
using codec::UnitChoice;

class TileEncoder {
public:
    TileEncoder(const ImageTask& task, const CostTable& costs, const codec::TileRect& place,
                std::vector<Decision>& decisions, std::array<std::vector<codec::MotionVector>, 2>& motions)
        : task_(task),
          costs_(costs),
          place_(place),
          left_(place.left),
          top_(place.top),
          recorder_(decisions),
          motions_(motions) {}

    void encode() {
        classify(place_.width, place_.height);
        for (int y = 0; y < place_.height; y += kMacroblock) {
            for (int x = 0; x < place_.width; x += kMacroblock) macroblock(x / kBlock, y / kBlock);
        }
        codec::AlphaFinisher(recorder_, *task_.code,
                             {.grid = state_.grid,
                              .mask = state_.alpha,
                              .depths = state_.depths,
                              .references = task_.references,
                              .place = place_,
                              .out = task_.out[3]})
            .finish();
        codec::filter_edges(state_.grid, *task_.code, task_.head.step, place_, task_.out);
    }

private:
    // Computes alpha levels of the whole tile and the classes of its blocks. The classes are stored separately, since
    // the grid must not contain blocks that are coded later.
    void classify(int width, int height) {
        const int full = (1 << task_.code->alpha_bits) - 1;
        for (int by = 0; by < height / kBlock; ++by) {
            for (int bx = 0; bx < width / kBlock; ++bx) {
                int lowest = full;
                int highest = 0;
                for (int y = by * kBlock; y < (by + 1) * kBlock; ++y) {
                    for (int x = bx * kBlock; x < (bx + 1) * kBlock; ++x) {
                        const int level = task_.source->alpha(left_ + x, top_ + y);
                        lowest = std::min(lowest, level);
                        highest = std::max(highest, level);
                        const int mask = codec::mask_of_level(level, task_.code->alpha_bits);
                        state_.alpha.at(x, y) = static_cast<std::uint8_t>(mask);
                        state_.depths.at(x, y) = static_cast<std::uint8_t>(mask != 0 ? full - level : level);
                        task_.out[3](left_ + x, top_ + y) =
                            static_cast<std::uint8_t>(codec::alpha_of_level(level, task_.code->alpha_bits));
                    }
                }
                classes_[static_cast<std::size_t>(by)][static_cast<std::size_t>(bx)] = highest == 0 ? AlphaClass::kEmpty
                                                                                       : lowest == full
                                                                                           ? AlphaClass::kOpaque
                                                                                           : AlphaClass::kMixed;
            }
        }
    }

    void macroblock(int bx, int by) {
        for (int i = 0; i < 4; ++i) {
            state_.grid.at(bx + (i & 1), by + (i >> 1)).alpha =
                classes_[static_cast<std::size_t>(by + (i >> 1))][static_cast<std::size_t>(bx + (i & 1))];
        }
        if (!codec::code_macroblock_alpha(recorder_, state_.grid, bx, by)) {
            codec::clear_tile({left_ + bx * kBlock, top_ + by * kBlock, kMacroblock, kMacroblock}, task_.out);
            return;
        }
        const ModeDecision search(task_, costs_, state_, left_, top_);

        CostEstimator whole_bits(costs_);
        codec::syntax::split(whole_bits, state_.grid, bx, by, false);
        CostEstimator split_bits(costs_);
        codec::syntax::split(split_bits, state_.grid, bx, by, true);

        const PredictionUnit whole{bx, by, kMacroblock};
        const float whole_cost = search.choose(whole, *choices_[4]) + task_.lambda * whole_bits.bits();
        const bool may_split = task_.effort.all_splits || choices_[4]->coded;
        float split_cost = may_split ? task_.lambda * split_bits.bits() : whole_cost;
        for (int i = 0; i < 4 && split_cost < whole_cost; ++i) {
            const PredictionUnit quarter{bx + (i & 1), by + (i >> 1), kBlock};
            if (state_.grid.at(quarter.bx, quarter.by).alpha == AlphaClass::kEmpty) {
                codec::clear_tile({left_ + quarter.bx * kBlock, top_ + quarter.by * kBlock, kBlock, kBlock}, task_.out);
                continue;
            }
            split_cost += search.choose(quarter, *choices_[static_cast<std::size_t>(i)], choices_[4].get());
            search.commit(quarter, *choices_[static_cast<std::size_t>(i)]);
        }
        const bool is_split = split_cost < whole_cost;
        for (int i = 0; i < 4; ++i) {
            codec::BlockInfo& info = state_.grid.at(bx + (i & 1), by + (i >> 1));
            info.source = codec::Source::kNone;
            info.split = false;
        }
        codec::syntax::split(recorder_, state_.grid, bx, by, is_split);
        for (int i = 0; i < 4; ++i) state_.grid.at(bx + (i & 1), by + (i >> 1)).split = is_split;
        if (!is_split) {
            put(search, whole, *choices_[4]);
            return;
        }
        for (int i = 0; i < 4; ++i) {
            const PredictionUnit quarter{bx + (i & 1), by + (i >> 1), kBlock};
            if (state_.grid.at(quarter.bx, quarter.by).alpha == AlphaClass::kEmpty) {
                codec::clear_tile({left_ + quarter.bx * kBlock, top_ + quarter.by * kBlock, kBlock, kBlock}, task_.out);
            } else {
                put(search, quarter, *choices_[static_cast<std::size_t>(i)]);
            }
        }
    }

    void put(const ModeDecision& search, const PredictionUnit& unit, UnitChoice& choice) {
        search.write(unit, choice, recorder_);
        search.commit(unit, choice);
        for (std::size_t r = 0; r < 2; ++r) {
            if (uses(choice.source, static_cast<int>(r))) motions_[r].push_back(choice.motion[r]);
        }
    }

    const ImageTask& task_;
    const CostTable& costs_;
    codec::TileRect place_;
    int left_;
    int top_;
    SymbolBuffer recorder_;
    std::array<std::vector<codec::MotionVector>, 2>& motions_;
    TileState state_;
    std::array<std::array<AlphaClass, 8>, 8> classes_{};
    // Choices of the four quarters and of the whole macroblock.
    std::array<std::unique_ptr<UnitChoice>, 5> choices_ = {
        std::make_unique<UnitChoice>(), std::make_unique<UnitChoice>(), std::make_unique<UnitChoice>(),
        std::make_unique<UnitChoice>(), std::make_unique<UnitChoice>()};
};

}  // namespace

void encode_tile(const ImageTask& task, const CostTable& costs, const codec::TileRect& place,
                 std::vector<Decision>& decisions, std::array<std::vector<codec::MotionVector>, 2>& motions) {
    TileEncoder(task, costs, place, decisions, motions).encode();
}

}  // namespace rs::encode
