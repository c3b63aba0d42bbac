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

// A position in scan order.
struct ScanPlace {
    std::uint8_t place;  // v * size + u
    std::uint8_t band;
    std::uint8_t side;  // max(u, v) + 1
    std::int16_t at;    // in Levels and Magnitudes
};

template <int kSize>
const std::array<ScanPlace, kSize * kSize>& scan_places() {
    static const auto kPlaces = [] {
        std::array<ScanPlace, kSize * kSize> places;
        const std::uint8_t* const scan = codec::syntax::scan_order(kSize);
        for (std::size_t i = 0; i < places.size(); ++i) {
            const int u = scan[i] % kSize;
            const int v = scan[i] / kSize;
            places[i] = {scan[i], static_cast<std::uint8_t>(codec::syntax::band_of(u + v, kSize)),
                         static_cast<std::uint8_t>(std::max(u, v) + 1),
                         static_cast<std::int16_t>(v * codec::Levels::kStride + u)};
        }
        return places;
    }();
    return kPlaces;
}

// Magnitudes of Levels, limited to 3, so that syntax::near_sum() takes five additions.
struct Magnitudes {
    std::uint8_t at[(kLargest + 2) * codec::Levels::kStride] = {};

    void set(int place, int level) { at[place] = static_cast<std::uint8_t>(std::min(std::abs(level), 3)); }
    [[nodiscard]] int near_sum(int place) const {
        constexpr int kDown = codec::Levels::kStride;
        const std::uint8_t* const m = at + place;
        const int sum = m[1] + m[2] + m[kDown] + m[2 * kDown] + m[kDown + 1];
        return std::min((sum + 1) >> 1, codec::context::kNearSums - 1);
    }
};

// Rate-distortion costs of one transform's levels.
struct Quantiser {
    const std::int32_t* coefficients;
    const QuantiserSettings& settings;
    const CostTable& costs;
    const ScanPlace* scan;
    float step;   // in units of the coefficients
    float scale;  // factor of their squared errors

    [[nodiscard]] float magnitude(int i) const { return static_cast<float>(std::abs(coefficients[scan[i].place])); }
    [[nodiscard]] float distortion(int i, int level) const {
        const float off = magnitude(i) - static_cast<float>(level) * step;
        return scale * off * off;
    }
    [[nodiscard]] float level_cost(int i, int near, bool must_be, int level) const {
        return settings.lambda * costs.level(settings.kind, scan[i].band, near, must_be, level);
    }
    [[nodiscard]] float last_cost(int last) const { return settings.lambda * costs.last_place(settings.kind, last); }
};

// Sign data hiding: changes one level per group, the cheapest, where the parity of the group's sum does not match the
// hidden sign.
class SignHider {
public:
    SignHider(const Quantiser& quantiser, codec::Levels& levels, Magnitudes& magnitudes, int& last)
        : quantiser_(quantiser), levels_(levels), magnitudes_(magnitudes), last_(last) {}

    void hide() {
        for (int begin = last_ & ~(codec::syntax::kSignGroup - 1); begin >= 0; begin -= codec::syntax::kSignGroup) {
            if (!is_parity_right(begin)) adjust_parity(begin);
        }
    }

private:
    std::int16_t& at(int i) { return levels_.at[quantiser_.scan[i].at]; }

    // True if the group hides no sign, or its parity matches the hidden sign.
    bool is_parity_right(int begin) {
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

    void adjust_parity(int begin) {
        const int end = std::min(begin + codec::syntax::kSignGroup - 1, last_);
        float best_cost = std::numeric_limits<float>::max();
        int best_place = -1;
        int best_level = 0;
        for (int i = end; i >= begin; --i) {
            const int near = magnitudes_.near_sum(quantiser_.scan[i].at);
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
                const int level = quantiser_.coefficients[quantiser_.scan[i].place] < 0 ? -changed : changed;
                // Any change flips the parity; adding or removing a level may also change which sign is hidden.
                at(i) = static_cast<std::int16_t>(level);
                if ((size != 0 && changed != 0) || is_parity_right(begin)) {
                    best_cost = cost;
                    best_place = i;
                    best_level = level;
                }
                at(i) = before;
            }
        }
        at(best_place) = static_cast<std::int16_t>(best_level);
        magnitudes_.set(quantiser_.scan[best_place].at, best_level);
        if (best_place == last_ && best_level == 0) last_ = last_below(last_);
    }

    // The next lower position with a level; a group to be adjusted has at least two.
    int last_below(int i) {
        do --i;
        while (at(i) == 0);
        return i;
    }

    const Quantiser& quantiser_;
    codec::Levels& levels_;
    Magnitudes& magnitudes_;
    int& last_;
};

}  // namespace

bool quantise(const std::int32_t* coefficients, const QuantiserSettings& settings, const CostTable& costs,
              codec::Levels& levels, int& last) {
    const int size = settings.size;
    const int count = size * size;
    const float unit = size == 8 ? 16.0F : 8.0F;  // scale of the coefficients relative to orthonormal ones
    const float step = static_cast<float>(codec::step_q4(settings.step)) / 16.0F * unit;
    const float inverse = 1 / step;
    const ScanPlace* const scan = size == 8 ? scan_places<8>().data() : scan_places<16>().data();
    const Quantiser quantiser{coefficients, settings, costs, scan, step, settings.weight / (unit * unit)};

    int start = count - 1;
    while (start >= 0 && quantiser.magnitude(start) * inverse < 0.5F) --start;
    if (start < 0) return false;

    // cost[i]: cost of coding position i; dropped[i]: cost of setting it to 0; flagless[i]: cost of coding it as the
    // last one.
    std::array<float, kLargest * kLargest> cost;
    std::array<float, kLargest * kLargest> dropped;
    std::array<float, kLargest * kLargest> flagless;
    Magnitudes magnitudes;
    for (int i = start; i >= 0; --i) {
        const auto n = static_cast<std::size_t>(i);
        const float magnitude = quantiser.magnitude(i);
        dropped[n] = quantiser.scale * magnitude * magnitude;
        const int near = magnitudes.near_sum(scan[i].at);
        float best_cost = dropped[n] + quantiser.level_cost(i, near, false, 0);
        flagless[n] = 1e30F;
        const auto nearest = static_cast<int>(std::min(magnitude * inverse + 0.5F, 16000.0F));
        int best = 0;
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
        if (best == 0) continue;
        levels.at[scan[i].at] = static_cast<std::int16_t>(coefficients[scan[i].place] < 0 ? -best : best);
        magnitudes.set(scan[i].at, best);
    }

    // Choose the last position: all levels above it are dropped.
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
        levels.at[scan[i].at] = 0;
        magnitudes.set(scan[i].at, 0);
    }
    if (settings.sign_data_hiding && last >= 0) SignHider(quantiser, levels, magnitudes, last).hide();
    levels.used = 0;
    for (int i = 0; i <= last; ++i) {
        if (levels.at[scan[i].at] != 0) levels.used = std::max(levels.used, static_cast<int>(scan[i].side));
    }
    return last >= 0;
}

}  // namespace rs::encode
