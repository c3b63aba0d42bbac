#include "encode/codec/quantise.hpp"

#include "rayspace/codec/syntax.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace rs::encode {
namespace {

constexpr int kLargest = codec::kLargestTransform;

template <int kSize>
void forward(const std::int16_t* residual, std::int32_t* coefficients) {
    constexpr int kRowStep = kLargest / kSize;
    constexpr int kLog2 = kSize == 8 ? 3 : 4;
    constexpr int kFirstShift = kLog2 - 1;
    constexpr int kSecondShift = kLog2 + 6;
    std::int32_t columns[kSize * kSize];  // [v][x]
    for (int v = 0; v < kSize; ++v) {
        std::int32_t sums[kSize] = {};
        for (int y = 0; y < kSize; ++y) {
            const std::int32_t factor = codec::kTransform16[v * kRowStep][y];
            for (int x = 0; x < kSize; ++x) sums[x] += factor * residual[y * kSize + x];
        }
        for (int x = 0; x < kSize; ++x) columns[v * kSize + x] = (sums[x] + (1 << (kFirstShift - 1))) >> kFirstShift;
    }
    std::int32_t turned[kSize * kSize];  // [x][v]
    for (int v = 0; v < kSize; ++v) {
        for (int x = 0; x < kSize; ++x) turned[x * kSize + v] = columns[v * kSize + x];
    }
    for (int u = 0; u < kSize; ++u) {
        std::int32_t sums[kSize] = {};
        for (int x = 0; x < kSize; ++x) {
            const std::int32_t factor = codec::kTransform16[u * kRowStep][x];
            for (int v = 0; v < kSize; ++v) sums[v] += factor * turned[x * kSize + v];
        }
        for (int v = 0; v < kSize; ++v) {
            coefficients[v * kSize + u] = (sums[v] + (1 << (kSecondShift - 1))) >> kSecondShift;
        }
    }
}

// Where a level is worth more or less than it costs: what quantise() knows of a transform.
struct Quantiser {
    const std::int32_t* coefficients;
    const QuantiserSettings& settings;
    const CostTable& costs;
    const std::uint8_t* scan;
    float step;   // in units of the coefficients
    float scale;  // of their squared errors

    [[nodiscard]] float magnitude(int i) const { return static_cast<float>(std::abs(coefficients[scan[i]])); }
    [[nodiscard]] float distortion(int i, int level) const {
        const float off = magnitude(i) - static_cast<float>(level) * step;
        return scale * off * off;
    }
    [[nodiscard]] float level_cost(int i, int near, bool must_be, int level) const {
        Estimator estimator(costs);
        codec::syntax::level(estimator, settings.kind, settings.size, scan[i] & (settings.size - 1),
                             scan[i] / settings.size, near, must_be, level);
        return settings.lambda * estimator.bits();
    }
    [[nodiscard]] float last_cost(int last) const {
        Estimator estimator(costs);
        codec::syntax::last_place(estimator, settings.kind, settings.size, last);
        return settings.lambda * estimator.bits();
    }
};

// Makes the parities of the groups those of the signs that they hide, with the level changed by one that costs least.
class SignHider {
public:
    SignHider(const Quantiser& quantiser, codec::Levels& levels, int& last)
        : quantiser_(quantiser), size_(quantiser.settings.size), levels_(levels), last_(last) {}

    void hide() {
        for (int begin = last_ & ~(codec::syntax::kSignGroup - 1); begin >= 0; begin -= codec::syntax::kSignGroup) {
            if (!agrees(begin)) mend(begin);
        }
    }

private:
    std::int16_t& at(int i) {
        const int place = quantiser_.scan[i];
        return levels_.at[(place / size_) * codec::Levels::kStride + (place & (size_ - 1))];
    }

    // Whether the group's parity is that of the sign that it hides, if it hides one.
    bool agrees(int begin) {
        int highest = -1;
        int lowest = -1;
        int sum = 0;
        for (int i = std::min(begin + codec::syntax::kSignGroup - 1, last_); i >= begin; --i) {
            if (at(i) == 0) continue;
            if (highest < 0) highest = i;
            lowest = i;
            sum += std::abs(at(i));
        }
        if (highest - lowest < codec::syntax::kHidingSpan) return true;
        return (sum & 1) == (at(lowest) < 0 ? 1 : 0);
    }

    void mend(int begin) {
        const int end = std::min(begin + codec::syntax::kSignGroup - 1, last_);
        float best_cost = std::numeric_limits<float>::max();
        int best_place = -1;
        int best_level = 0;
        for (int i = end; i >= begin; --i) {
            const int place = quantiser_.scan[i];
            const int near = codec::syntax::near_sum(levels_, place & (size_ - 1), place / size_);
            const std::int16_t before = at(i);
            const int size = std::abs(before);
            const float now = quantiser_.distortion(i, size) + quantiser_.level_cost(i, near, i == last_, size);
            for (const int changed : {size - 1, size + 1}) {
                if (changed < 0) continue;
                const bool shortens = i == last_ && changed == 0;
                float cost = quantiser_.distortion(i, changed) - now;
                cost += shortens ? quantiser_.last_cost(last_below(i)) - quantiser_.last_cost(i)
                                 : quantiser_.level_cost(i, near, i == last_, changed);
                if (cost >= best_cost) continue;
                const int level = quantiser_.coefficients[place] < 0 ? -changed : changed;
                at(i) = static_cast<std::int16_t>(level);
                if (agrees(begin)) {
                    best_cost = cost;
                    best_place = i;
                    best_level = level;
                }
                at(i) = before;
            }
        }
        at(best_place) = static_cast<std::int16_t>(best_level);
        if (best_place == last_ && best_level == 0) last_ = last_below(last_);
    }

    // The next place below that has a level; a group that is mended has two at least.
    int last_below(int i) {
        do --i;
        while (at(i) == 0);
        return i;
    }

    const Quantiser& quantiser_;
    int size_;
    codec::Levels& levels_;
    int& last_;
};

}  // namespace

void forward_transform(const std::int16_t* residual, int size, std::int32_t* coefficients) {
    if (size == 8) {
        forward<8>(residual, coefficients);
    } else {
        forward<16>(residual, coefficients);
    }
}

bool quantise(const std::int32_t* coefficients, const QuantiserSettings& settings, const CostTable& costs,
              codec::Levels& levels, int& last) {
    namespace syntax = codec::syntax;
    const int size = settings.size;
    const int count = size * size;
    const float unit = size == 8 ? 16.0F : 8.0F;  // of the coefficients, in orthonormal ones
    const float step = static_cast<float>(codec::step_q4(settings.step)) / 16.0F * unit;
    const float inverse = 1 / step;
    const Quantiser quantiser{
        coefficients, settings, costs, syntax::scan_order(size), step, settings.weight / (unit * unit)};
    const std::uint8_t* const scan = quantiser.scan;

    int start = count - 1;
    while (start >= 0 && quantiser.magnitude(start) * inverse < 0.5F) --start;
    if (start < 0) return false;

    // cost[i]: of coding place i; dropped[i]: of leaving it out; flagless[i]: of coding it as the last one.
    std::array<float, kLargest * kLargest> cost;
    std::array<float, kLargest * kLargest> dropped;
    std::array<float, kLargest * kLargest> flagless;
    for (int i = start; i >= 0; --i) {
        const int u = scan[i] & (size - 1);
        const int v = scan[i] / size;
        const auto n = static_cast<std::size_t>(i);
        dropped[n] = quantiser.distortion(i, 0);
        const int near = syntax::near_sum(levels, u, v);
        const auto nearest = static_cast<int>(std::min(quantiser.magnitude(i) * inverse + 0.5F, 16000.0F));
        int best = 0;
        float best_cost = dropped[n] + quantiser.level_cost(i, near, false, 0);
        flagless[n] = 1e30F;
        for (int level = nearest; level >= std::max(nearest - 1, 1); --level) {
            const float distortion = quantiser.distortion(i, level);
            const float total = distortion + quantiser.level_cost(i, near, false, level);
            if (total < best_cost) {
                best_cost = total;
                best = level;
                flagless[n] = distortion + quantiser.level_cost(i, near, true, level);
            }
        }
        cost[n] = best_cost;
        levels.at[v * codec::Levels::kStride + u] = static_cast<std::int16_t>(coefficients[scan[i]] < 0 ? -best : best);
    }

    // Where to stop: everything above the last one is dropped.
    float below = 0;
    float all_dropped = 0;
    for (int i = 0; i <= start; ++i) all_dropped += dropped[static_cast<std::size_t>(i)];
    float best_total = all_dropped;
    float above = all_dropped;
    last = -1;
    for (int i = 0; i <= start; ++i) {
        const auto n = static_cast<std::size_t>(i);
        above -= dropped[n];
        if (flagless[n] < 1e30F) {
            const float total = below + above + flagless[n] + quantiser.last_cost(i);
            if (total < best_total) {
                best_total = total;
                last = i;
            }
        }
        below += cost[n];
    }
    for (int i = last + 1; i <= start; ++i) {
        levels.at[(scan[i] / size) * codec::Levels::kStride + (scan[i] & (size - 1))] = 0;
    }
    if (settings.sign_data_hiding && last >= 0) SignHider(quantiser, levels, last).hide();
    levels.used = 0;
    for (int i = 0; i <= last; ++i) {
        const int u = scan[i] & (size - 1);
        const int v = scan[i] / size;
        if (levels.at[v * codec::Levels::kStride + u] != 0) levels.used = std::max(levels.used, std::max(u, v) + 1);
    }
    return last >= 0;
}

}  // namespace rs::encode
