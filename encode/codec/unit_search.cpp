#include "encode/codec/unit_search.hpp"

#include "encode/codec/motion_search.hpp"
#include "encode/codec/quantise.hpp"
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
using codec::PartChoice;
using codec::PartPlace;
using codec::PredictionUnit;
using codec::Source;

constexpr int kMacroblockSamples = kMacroblock * kMacroblock;
constexpr float kNever = std::numeric_limits<float>::max();

// How often a part with samples that do not matter is coded anew with what the last coding made of them.
constexpr int kRefits = 2;

// One transform of a plane: what is wanted, predicted, and which samples matter.
struct TransformTarget {
    int size = 8;
    const std::uint8_t* wanted = nullptr;
    const std::uint8_t* matters = nullptr;
    std::ptrdiff_t source_stride = 0;
    const std::uint8_t* predicted = nullptr;
    std::ptrdiff_t stride = 0;
    bool all_matter = true;
};

float error_of(const TransformTarget& target, const std::uint8_t* shown, std::ptrdiff_t stride) {
    int sum = 0;
    for (int y = 0; y < target.size; ++y) {
        for (int x = 0; x < target.size; ++x) {
            const int off = target.wanted[y * target.source_stride + x] - shown[y * stride + x];
            sum += (off * off) & -static_cast<int>(target.matters[y * target.source_stride + x] & 1);
        }
    }
    return static_cast<float>(sum);
}

// Levels for the target; returns whether there are any. `shown` receives what the decoder will show (size * size).
bool code_transform(const TransformTarget& target, const QuantiserSettings& settings, const CostTable& costs,
                    codec::Levels& levels, int& last, std::uint8_t* shown) {
    const int size = target.size;
    std::int16_t residual[kMacroblockSamples];
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const int off = target.wanted[y * target.source_stride + x] - target.predicted[y * target.stride + x];
            residual[y * size + x] =
                static_cast<std::int16_t>(target.matters[y * target.source_stride + x] != 0 ? off : 0);
        }
    }
    bool any = false;
    for (int round = 0; round <= (target.all_matter ? 0 : kRefits); ++round) {
        std::int32_t coefficients[kMacroblockSamples];
        forward_transform(residual, size, coefficients);
        levels = {};
        any = quantise(coefficients, settings, costs, levels, last);
        for (int y = 0; y < size; ++y) std::copy_n(target.predicted + y * target.stride, size, shown + y * size);
        if (!any) return false;
        codec::add_residual(levels, settings.step, size, shown, size);
        if (target.all_matter) break;
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                if (target.matters[y * target.source_stride + x] != 0) continue;
                residual[y * size + x] =
                    static_cast<std::int16_t>(shown[y * size + x] - target.predicted[y * target.stride + x]);
            }
        }
    }
    return any;
}

}  // namespace

PartPlace UnitSearch::place_of(const PredictionUnit& part) const {
    return codec::place_of_part(state_.grid, part, left_, top_);
}

template <class Coder>
void UnitSearch::code_alpha(Coder& coder, const PredictionUnit& part, const PartChoice& choice) const {
    for (int i = 0; i < part.blocks() * part.blocks(); ++i) {
        const int bx = part.bx + (i & (part.blocks() - 1));
        const int by = part.by + i / part.blocks();
        if (state_.grid.at(bx, by).alpha != codec::AlphaClass::kMixed) continue;
        codec::code_block_mask(coder, state_.alpha, bx, by, [&](int x, int y) {
            return codec::predicted_mask(
                codec::interpolated_alpha(choice.source, choice.motion, task_.references, left_ + x, top_ + y));
        });
    }
}

void UnitSearch::write(const PredictionUnit& part, PartChoice& choice, SymbolBuffer& recorder) const {
    const codec::PartSurroundings around{task_.head.references(), task_.head.global_motion};
    codec::code_prediction(recorder, state_.grid, part, around, choice);
    code_alpha(recorder, part, choice);
    codec::code_coefficients(recorder, state_.grid, part, task_.code->sign_data_hiding, choice);
}

void UnitSearch::commit(const PredictionUnit& part, const PartChoice& choice) const {
    codec::reconstruct_unit(choice, place_of(part), task_.head.step, *task_.code, task_.references, task_.out);
    codec::enter_part(state_.grid, part, choice);
}

// `choice` has its prediction; finds coefficients. kNever as soon as it cannot be below `best`.
float UnitSearch::evaluate(const PredictionUnit& part, PartChoice& choice, float best) const {
    const PartPlace place = place_of(part);
    const codec::PartSurroundings around{task_.head.references(), task_.head.global_motion};
    Estimator head_bits(costs_);
    codec::code_prediction(head_bits, state_.grid, part, around, choice);
    code_alpha(head_bits, part, choice);
    const float head_cost = task_.lambda * head_bits.bits();
    if (head_cost >= best) return kNever;

    const bool inter = is_inter(choice.source);
    bool all_matter = true;
    for (int i = 0; i < part.blocks() * part.blocks(); ++i) {
        const auto& info = state_.grid.at(part.bx + (i & (part.blocks() - 1)), part.by + i / part.blocks());
        all_matter = all_matter && info.alpha == codec::AlphaClass::kOpaque;
    }

    std::uint8_t predicted[codec::kPlanes][kMacroblockSamples];
    TransformTarget targets[codec::kPlanes];
    float plain_error = 0;
    for (int plane = 0; plane < codec::kPlanes; ++plane) {
        const auto p = static_cast<std::size_t>(plane);
        codec::predict_part(choice, place, plane, task_.references, task_.out[p]);
        for (int y = 0; y < part.size; ++y) {
            std::copy_n(task_.out[p].row(place.y + y) + place.x, part.size, predicted[plane] + y * part.size);
        }
        const Image<std::uint8_t>& wanted = task_.source->planes[p];
        targets[plane] = {part.size,
                          wanted.row(place.y) + place.x,
                          task_.source->matters.row(place.y) + place.x,
                          wanted.width(),
                          predicted[plane],
                          part.size,
                          all_matter};
        plain_error += kPlaneWeights[p] * error_of(targets[plane], predicted[plane], part.size);
    }

    // Nothing coded.
    choice.coded = false;
    choice.small_transforms = false;
    Estimator none_bits(costs_);
    codec::code_coefficients(none_bits, state_.grid, part, task_.code->sign_data_hiding, choice);
    float cost = plain_error + task_.lambda * none_bits.bits();

    // Coefficients, in large and in small transforms.
    PartChoice trial = choice;
    for (const bool small : {false, true}) {
        if (small && part.size == kBlock) break;
        trial.small_transforms = small;
        trial.coded = false;
        const int size = trial.transform_size(part.size);
        float error = 0;
        for (int plane = 0; plane < codec::kPlanes; ++plane) {
            const auto p = static_cast<std::size_t>(plane);
            const int kind = codec::syntax::block_kind(plane, size, inter);
            const QuantiserSettings settings{size,
                                             kind,
                                             task_.code->plane_step(task_.head.step, plane),
                                             kPlaneWeights[p],
                                             task_.lambda,
                                             task_.code->sign_data_hiding};
            for (std::size_t t = 0; t < static_cast<std::size_t>(trial.transforms(part.size)); ++t) {
                TransformTarget target = targets[plane];
                const std::ptrdiff_t down = static_cast<std::ptrdiff_t>(t >> 1) * kBlock;
                const std::ptrdiff_t right = static_cast<std::ptrdiff_t>(t & 1) * kBlock;
                target.size = size;
                target.wanted += down * target.source_stride + right;
                target.matters += down * target.source_stride + right;
                target.predicted += down * target.stride + right;
                std::uint8_t shown[kMacroblockSamples];
                trial.plane_coded[p][t] =
                    code_transform(target, settings, costs_, trial.levels[p][t], trial.last[p][t], shown);
                trial.coded = trial.coded || trial.plane_coded[p][t];
                error += kPlaneWeights[p] * error_of(target, shown, size);
            }
        }
        if (!trial.coded) continue;
        Estimator bits(costs_);
        codec::code_coefficients(bits, state_.grid, part, task_.code->sign_data_hiding, trial);
        const float total = error + task_.lambda * bits.bits();
        if (total < cost) {
            cost = total;
            choice = trial;
        }
    }
    return head_cost + cost;
}

void UnitSearch::find_intra(const PredictionUnit& part, PartChoice& trial, PartChoice& choice, float& best) const {
    const PartPlace place = place_of(part);
    trial.source = Source::kIntra;
    std::array<std::pair<int, int>, codec::kIntraModes> ranked;
    for (int mode = 0; mode < codec::kIntraModes; ++mode) {
        trial.intra_mode = mode;
        codec::predict_part(trial, place, 0, task_.references, task_.out[0]);
        int sum = 0;
        for (int y = 0; y < part.size; ++y) {
            const std::uint8_t* const shown = task_.out[0].row(place.y + y) + place.x;
            const std::uint8_t* const wanted = task_.source->planes[0].row(place.y + y) + place.x;
            const std::uint8_t* const matters = task_.source->matters.row(place.y + y) + place.x;
            for (int x = 0; x < part.size; ++x) sum += std::abs(wanted[x] - shown[x]) & matters[x];
        }
        ranked[static_cast<std::size_t>(mode)] = {sum, mode};
    }
    std::sort(ranked.begin(), ranked.end());
    constexpr std::size_t kTried = 4;
    for (std::size_t i = 0; i < kTried; ++i) {
        if (i > 0 && ranked[i].first == ranked[0].first) continue;
        trial.intra_mode = ranked[i].second;
        const float cost = evaluate(part, trial, best);
        if (cost < best) {
            best = cost;
            choice = trial;
        }
    }
}

void UnitSearch::find_inter(const PredictionUnit& part, const PartChoice* around, PartChoice& trial, PartChoice& choice,
                            float& best) const {
    const PartPlace place = place_of(part);
    MotionSearch search;
    search.source = task_.source;
    search.x = place.x;
    search.y = place.y;
    search.size = part.size;
    search.bit_cost = std::sqrt(task_.lambda / kPlaneWeights[0]);
    std::array<FoundMotion, 2> found;
    std::array<MotionVector, 2> from;
    const int references = task_.head.references();
    const auto take = [&](Source source) {
        trial.source = source;
        const float cost = evaluate(part, trial, best);
        if (cost >= best) return;
        best = cost;
        choice = trial;
    };
    for (int r = 0; r < references; ++r) {
        const auto n = static_cast<std::size_t>(r);
        from[n] = codec::predicted_motion(state_.grid, part, r, task_.head.global_motion[n]);
        search.reference = task_.references[n][0];
        if (around != nullptr && is_inter(around->source)) {
            const std::array<MotionVector, 2> starts = {around->motion[n], from[n]};
            search.reach_x = 3;
            search.reach_y = 1;
            found[n] = find_motion(search, starts, from[n]);
        } else {
            const std::array<MotionVector, 2> starts = {MotionVector{}, from[n]};
            search.reach_x = task_.reach[n];
            search.reach_y = 2;
            found[n] = find_motion(search, starts, from[n]);
        }
        trial.motion[n] = found[n].vector;
    }
    for (int r = 0; r < references; ++r) take(r == 0 ? Source::kFirst : Source::kSecond);
    if (references < 2) return;
    // Both: each once more, against the other.
    search.reach_x = 1;
    search.reach_y = 1;
    for (const std::size_t r : {std::size_t{0}, std::size_t{1}}) {
        std::uint8_t other[kMacroblockSamples];
        codec::predict_from_picture(task_.references[1 - r][0], place.x, place.y, trial.motion[1 - r], part.size, other,
                                    part.size);
        search.reference = task_.references[r][0];
        const std::array<MotionVector, 1> starts = {trial.motion[r]};
        trial.motion[r] = find_motion(search, starts, from[r], other).vector;
    }
    take(Source::kBoth);
}

float UnitSearch::choose(const PredictionUnit& part, PartChoice& choice, const PartChoice* around) const {
    float best = kNever;
    PartChoice trial;
    if (task_.head.references() > 0) find_inter(part, around, trial, choice, best);
    find_intra(part, trial, choice, best);
    return best;
}

}  // namespace rs::encode
