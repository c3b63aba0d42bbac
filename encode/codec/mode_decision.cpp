#include "encode/codec/mode_decision.hpp"

#include "encode/codec/motion_search.hpp"
#include "encode/codec/quantise.hpp"
#include "encode/codec/search_kernels.hpp"
#include "rayspace/codec/alpha_mask.hpp"
#include "rayspace/codec/kernels/transform.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace rs::encode {
namespace {

using codec::kBlock;
using codec::kMacroblock;
using codec::MotionVector;
using codec::PredictionUnit;
using codec::Source;
using codec::UnitChoice;
using codec::UnitPosition;

constexpr int kMacroblockSamples = kMacroblock * kMacroblock;
constexpr float kInfiniteCost = std::numeric_limits<float>::max();

// Residuals up to this squared error, in squared steps, have no coefficient that reaches half a step.
constexpr float kNothingToCode = 0.25F;

// Target of one transform of a plane: source samples, prediction, and the mask of valid samples.
struct TransformTarget {
    SampleBlock samples;
    const std::uint8_t* predicted = nullptr;
    std::ptrdiff_t stride = 0;
    bool all_valid = true;

    [[nodiscard]] float error_of(const std::uint8_t* reconstruction, std::ptrdiff_t reconstruction_stride) const {
        return static_cast<float>(squared_differences(samples, reconstruction, reconstruction_stride));
    }
};

// Result of one transform.
struct CodedTransform {
    codec::Levels& levels;
    int& last;                               // set if any level is not zero
    std::uint8_t* reconstruction = nullptr;  // the decoder's samples, size * size
};

// Quantises the target. Returns true if any level is not zero.
bool code_transform(const TransformTarget& target, const QuantiserSettings& settings, const CostTable& costs,
                    int refits, const CodedTransform& out) {
    const int size = target.samples.size;
    std::uint8_t* const reconstruction = out.reconstruction;
    const auto start_with_prediction = [&] {
        for (int y = 0; y < size; ++y)
            std::copy_n(target.predicted + y * target.stride, size, reconstruction + y * size);
    };
    start_with_prediction();
    const float step = static_cast<float>(codec::step_q4(settings.step)) / 16.0F;
    if (target.error_of(reconstruction, size) < kNothingToCode * step * step) return false;
    std::int16_t residual[kMacroblockSamples];
    for (int y = 0; y < size; ++y) {
        const std::uint8_t* const wanted = target.samples.wanted + y * target.samples.stride;
        const std::uint8_t* const mask = target.samples.mask + y * target.samples.stride;
        for (int x = 0; x < size; ++x) {
            residual[y * size + x] =
                static_cast<std::int16_t>((wanted[x] & mask[x]) - (reconstruction[y * size + x] & mask[x]));
        }
    }
    for (int round = 0;; ++round) {
        std::int32_t coefficients[kMacroblockSamples];
        forward_transform(residual, size, coefficients);
        out.levels = {};
        const bool any = quantise(coefficients, settings, costs, out.levels, out.last);
        start_with_prediction();
        if (!any) return false;
        codec::add_residual(out.levels, settings.step, size, reconstruction, size);
        if (target.all_valid || round == refits) return true;
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                if (target.samples.mask[y * target.samples.stride + x] != 0) continue;
                residual[y * size + x] =
                    static_cast<std::int16_t>(reconstruction[y * size + x] - target.predicted[y * target.stride + x]);
            }
        }
    }
}

}  // namespace

void ModeDecision::Candidate::take(const UnitChoice& choice) {
    source = choice.source;
    intra_mode = choice.intra_mode;
    motion = choice.motion;
}

void ModeDecision::Candidate::put(UnitChoice& choice) const {
    choice.source = source;
    choice.intra_mode = intra_mode;
    choice.motion = motion;
}

std::span<const ModeDecision::Candidate*> ModeDecision::Candidates::select_best(int count) {
    for (std::size_t i = 0; i < count_; ++i) order_[i] = &all_[i];
    std::stable_sort(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(count_),
                     [](const Candidate* a, const Candidate* b) { return a->estimate < b->estimate; });
    return std::span(order_).first(std::min(count_, static_cast<std::size_t>(count)));
}

UnitPosition ModeDecision::position_of(const PredictionUnit& unit) const {
    return codec::unit_position(state_.grid, unit, left_, top_);
}

template <class Coder>
void ModeDecision::code_alpha(Coder& coder, const PredictionUnit& unit, const UnitChoice& choice) const {
    for (int i = 0; i < unit.blocks() * unit.blocks(); ++i) {
        const int bx = unit.bx + (i & (unit.blocks() - 1));
        const int by = unit.by + i / unit.blocks();
        if (state_.grid.at(bx, by).alpha != codec::AlphaClass::kMixed) continue;
        codec::code_block_mask(coder, state_.alpha, bx, by, [&](int x, int y) {
            return codec::mask_context(
                codec::interpolate_alpha(choice.source, choice.motion, task_.references, left_ + x, top_ + y));
        });
    }
}

void ModeDecision::write(const PredictionUnit& unit, UnitChoice& choice, SymbolBuffer& recorder) const {
    const codec::UnitSurroundings around{task_.head.references(), task_.head.global_motion};
    codec::code_prediction(recorder, state_.grid, unit, around, choice);
    code_alpha(recorder, unit, choice);
    codec::code_coefficients(recorder, state_.grid, unit, task_.code->sign_data_hiding, choice);
}

void ModeDecision::commit(const PredictionUnit& unit, const UnitChoice& choice) const {
    codec::reconstruct_unit(choice, position_of(unit), task_.head.step, *task_.code, task_.references, task_.out);
    codec::record_unit(state_.grid, unit, choice);
}

SampleBlock ModeDecision::target_samples(const UnitPosition& place, int plane) const {
    const Image<std::uint8_t>& wanted = task_.source->planes[static_cast<std::size_t>(plane)];
    return {wanted.row(place.y) + place.x, task_.source->valid.row(place.y) + place.x, wanted.width(), place.size};
}

// Estimates the candidate's cost before coding: its head cost and its total.
void ModeDecision::estimate_cost(const PredictionUnit& unit, UnitChoice& trial, Candidate& candidate) const {
    const UnitPosition place = position_of(unit);
    candidate.take(trial);
    const codec::UnitSurroundings around{task_.head.references(), task_.head.global_motion};
    CostEstimator bits(costs_);
    codec::code_prediction(bits, state_.grid, unit, around, trial);
    code_alpha(bits, unit, trial);
    candidate.head_cost = task_.lambda * bits.bits();
    float left = 0;
    for (int plane = 0; plane < codec::kPlanes; ++plane) {
        left += static_cast<float>(
            hadamard_differences(target_samples(place, plane), candidate.predicted[plane], unit.size));
    }
    candidate.estimate = left + bit_cost() * bits.bits();
}

// Codes the candidate's residual with the given transform sizes. Replaces `choice` and `best` if it costs less.
void ModeDecision::evaluate(const PredictionUnit& unit, const Candidate& candidate, Transforms transforms,
                            UnitChoice& trial, UnitChoice& choice, float& best) const {
    if (candidate.head_cost >= best) return;
    const UnitPosition place = position_of(unit);
    candidate.put(trial);
    const bool inter = is_inter(trial.source);
    bool all_valid = true;
    for (int i = 0; i < unit.blocks() * unit.blocks(); ++i) {
        const auto& info = state_.grid.at(unit.bx + (i & (unit.blocks() - 1)), unit.by + i / unit.blocks());
        all_valid = all_valid && info.alpha == codec::AlphaClass::kOpaque;
    }
    TransformTarget targets[codec::kPlanes];
    float plain_error = 0;
    for (int plane = 0; plane < codec::kPlanes; ++plane) {
        targets[plane] = {target_samples(place, plane), candidate.predicted[plane], unit.size, all_valid};
        plain_error += kPlaneWeights[static_cast<std::size_t>(plane)] *
                       targets[plane].error_of(candidate.predicted[plane], unit.size);
    }

    const auto finish = [&](float error) {
        CostEstimator bits(costs_);
        codec::code_coefficients(bits, state_.grid, unit, task_.code->sign_data_hiding, trial);
        const float cost = candidate.head_cost + error + task_.lambda * bits.bits();
        if (cost >= best) return;
        best = cost;
        choice = trial;
    };
    if (transforms != Transforms::kSmall) {
        trial.coded = false;
        trial.small_transforms = false;
        finish(plain_error);
    }
    for (const bool small : {false, true}) {
        if (small && unit.size == kBlock) break;
        if (transforms == (small ? Transforms::kLarge : Transforms::kSmall)) continue;
        trial.small_transforms = small;
        trial.coded = false;
        const int size = trial.transform_size(unit.size);
        float error = 0;
        for (int plane = 0; plane < codec::kPlanes; ++plane) {
            const auto p = static_cast<std::size_t>(plane);
            const QuantiserSettings settings{size,
                                             codec::syntax::block_kind(plane, size, inter),
                                             task_.code->plane_step(task_.head.step, plane),
                                             kPlaneWeights[p],
                                             task_.lambda,
                                             task_.code->sign_data_hiding};
            for (std::size_t t = 0; t < static_cast<std::size_t>(trial.transforms(unit.size)); ++t) {
                TransformTarget target = targets[plane];
                const std::ptrdiff_t down = static_cast<std::ptrdiff_t>(t >> 1) * kBlock;
                const std::ptrdiff_t right = static_cast<std::ptrdiff_t>(t & 1) * kBlock;
                target.samples.size = size;
                target.samples.wanted += down * target.samples.stride + right;
                target.samples.mask += down * target.samples.stride + right;
                target.predicted += down * target.stride + right;
                std::uint8_t reconstruction[kMacroblockSamples];
                trial.plane_coded[p][t] = code_transform(
                    target, settings, costs_, task_.effort.refits,
                    {.levels = trial.levels[p][t], .last = trial.last[p][t], .reconstruction = reconstruction});
                trial.coded = trial.coded || trial.plane_coded[p][t];
                error += kPlaneWeights[p] * target.error_of(reconstruction, size);
            }
        }
        if (trial.coded) finish(error);
    }
}

// Adds the intra modes of the lowest estimate, from Y alone.
void ModeDecision::add_intra(const PredictionUnit& unit, UnitChoice& trial, Candidates& candidates) const {
    const UnitPosition place = position_of(unit);
    trial.source = Source::kIntra;
    const SampleBlock wanted = target_samples(place, 0);
    std::array<std::pair<int, int>, codec::kIntraModes> ranked;
    std::uint8_t predicted[codec::kIntraModes][kMacroblockSamples];
    const auto predict = [&](int plane, std::uint8_t* out) {
        const ImageView<std::uint8_t> scratch = task_.out[static_cast<std::size_t>(plane)];
        codec::predict_unit(trial, place, plane, task_.references, scratch);
        for (int y = 0; y < unit.size; ++y) {
            std::copy_n(scratch.row(place.y + y) + place.x, unit.size, out + y * unit.size);
        }
    };
    for (int mode = 0; mode < codec::kIntraModes; ++mode) {
        trial.intra_mode = mode;
        predict(0, predicted[mode]);
        ranked[static_cast<std::size_t>(mode)] = {absolute_differences(wanted, predicted[mode], unit.size), mode};
    }
    std::sort(ranked.begin(), ranked.end());
    for (std::size_t i = 0; i < static_cast<std::size_t>(task_.effort.intra); ++i) {
        if (i > 0 && ranked[i].first == ranked[0].first) continue;
        trial.intra_mode = ranked[i].second;
        Candidate& candidate = candidates.add();
        std::copy_n(predicted[trial.intra_mode], unit.size * unit.size, candidate.predicted[0]);
        for (const int plane : {1, 2}) predict(plane, candidate.predicted[plane]);
        estimate_cost(unit, trial, candidate);
    }
}

void ModeDecision::add_inter(const PredictionUnit& unit, const UnitChoice* around, UnitChoice& trial,
                             Candidates& candidates) const {
    const UnitPosition place = position_of(unit);
    MotionSearch search;
    search.source = task_.source;
    search.x = place.x;
    search.y = place.y;
    search.size = unit.size;
    search.bit_cost = bit_cost();
    search.neighbours = task_.effort.fractions;
    std::array<MotionMatch, 2> found;
    std::array<MotionVector, 2> from;
    const int references = task_.head.references();
    const auto add = [&](Source source) {
        trial.source = source;
        Candidate& candidate = candidates.add();
        for (int plane = 0; plane < codec::kPlanes; ++plane) {
            const auto p = static_cast<std::size_t>(plane);
            const std::size_t first = uses(source, 0) ? 0 : 1;
            codec::predict_from_image(task_.references[first][p], place.x, place.y, trial.motion[first], unit.size,
                                      candidate.predicted[plane], unit.size);
            if (source != Source::kBoth) continue;
            std::uint8_t other[kMacroblockSamples];
            codec::predict_from_image(task_.references[1][p], place.x, place.y, trial.motion[1], unit.size, other,
                                      unit.size);
            codec::average_into(candidate.predicted[plane], unit.size, other, unit.size, unit.size);
        }
        estimate_cost(unit, trial, candidate);
    };
    for (int r = 0; r < references; ++r) {
        const auto n = static_cast<std::size_t>(r);
        from[n] = codec::predict_motion(state_.grid, unit, r, task_.head.global_motion[n]);
        search.reference = task_.references[n][0];
        if (around != nullptr && is_inter(around->source)) {
            const std::array<MotionVector, 2> starts = {around->motion[n], from[n]};
            search.reach_x = 3;
            search.reach_y = 1;
            search.step = 1;
            found[n] = search_motion(search, starts, from[n]);
        } else {
            const std::array<MotionVector, 2> starts = {MotionVector{}, from[n]};
            search.reach_x = task_.reach[n];
            search.reach_y = 2;
            search.step = task_.effort.motion_step;
            found[n] = search_motion(search, starts, from[n]);
        }
        trial.motion[n] = found[n].vector;
    }
    for (int r = 0; r < references; ++r) add(r == 0 ? Source::kFirst : Source::kSecond);
    if (references < 2) return;
    // Bidirectional: refine each vector given the other's prediction.
    search.reach_x = 1;
    search.reach_y = 1;
    search.step = 1;
    for (const std::size_t r : {std::size_t{0}, std::size_t{1}}) {
        std::uint8_t other[kMacroblockSamples];
        codec::predict_from_image(task_.references[1 - r][0], place.x, place.y, trial.motion[1 - r], unit.size, other,
                                  unit.size);
        search.reference = task_.references[r][0];
        const std::array<MotionVector, 1> starts = {trial.motion[r]};
        trial.motion[r] = search_motion(search, starts, from[r], other).vector;
    }
    add(Source::kBoth);
}

float ModeDecision::choose(const PredictionUnit& unit, UnitChoice& choice, const UnitChoice* around) const {
    UnitChoice trial;
    Candidates candidates;
    if (task_.head.references() > 0) add_inter(unit, around, trial, candidates);
    add_intra(unit, trial, candidates);
    const std::span<const Candidate*> select_best = candidates.select_best(task_.effort.coded);
    const Transforms transforms = task_.effort.all_transforms ? Transforms::kBoth : Transforms::kLarge;
    float best = kInfiniteCost;
    const Candidate* winner = nullptr;
    for (const Candidate* candidate : select_best) {
        const float before = best;
        evaluate(unit, *candidate, transforms, trial, choice, best);
        if (best < before) winner = candidate;
    }
    if (transforms == Transforms::kLarge && unit.size == kMacroblock && choice.coded) {
        evaluate(unit, *winner, Transforms::kSmall, trial, choice, best);
    }
    return best;
}

}  // namespace rs::encode
