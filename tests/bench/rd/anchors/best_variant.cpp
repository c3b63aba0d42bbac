#include "tests/bench/rd/anchors/best_variant.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace rs::bench {
namespace {

struct VariantCurve {
    std::string codec;
    std::string variant;
    std::vector<Measurement> points;
};

std::vector<VariantCurve> group_by_variant(const std::vector<Measurement>& measured) {
    std::vector<VariantCurve> groups;
    for (const Measurement& point : measured) {
        const auto same = [&](const VariantCurve& group) {
            return group.codec == point.codec && group.variant == point.variant;
        };
        auto group = std::find_if(groups.begin(), groups.end(), same);
        if (group == groups.end()) group = groups.insert(groups.end(), {point.codec, point.variant, {}});
        group->points.push_back(point);
    }
    return groups;
}

ChosenCurve choose_best(const std::vector<VariantCurve>& variants) {
    const auto fewer = [](const VariantCurve& a, const VariantCurve& b) { return a.points.size() < b.points.size(); };
    const auto most = std::max_element(variants.begin(), variants.end(), fewer);
    auto best = static_cast<std::size_t>(most - variants.begin());
    for (std::size_t n = 0; n < variants.size(); ++n) {
        if (variants[n].points.size() < most->points.size()) continue;
        const auto ratio = mean_rate_ratio(RateCurve(variants[n].points), RateCurve(variants[best].points));
        if (ratio && *ratio < 1) best = n;
    }
    ChosenCurve chosen{
        variants[best].codec, variants[best].variant, variants[best].points, RateCurve(variants[best].points), {}};
    for (std::size_t n = 0; n < variants.size(); ++n) {
        if (n == best) continue;
        const auto ratio = mean_rate_ratio(RateCurve(variants[n].points), chosen.curve);
        chosen.rejected.push_back({variants[n].variant, ratio.value_or(1), variants[n].points});
    }
    return chosen;
}

}  // namespace

std::vector<ChosenCurve> best_variants(const std::vector<Measurement>& measured) {
    const std::vector<VariantCurve> groups = group_by_variant(measured);
    std::vector<ChosenCurve> curves;
    for (const VariantCurve& group : groups) {
        if (find_curve(curves, group.codec) != nullptr) continue;
        std::vector<VariantCurve> variants;
        std::copy_if(groups.begin(), groups.end(), std::back_inserter(variants),
                     [&](const VariantCurve& other) { return other.codec == group.codec; });
        curves.push_back(choose_best(variants));
    }
    return curves;
}

const ChosenCurve* find_curve(const std::vector<ChosenCurve>& curves, const std::string& codec) {
    const auto found =
        std::find_if(curves.begin(), curves.end(), [&](const ChosenCurve& curve) { return curve.codec == codec; });
    return found == curves.end() ? nullptr : &*found;
}

}  // namespace rs::bench
