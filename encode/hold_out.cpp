#include "encode/hold_out.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/rig.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace rs::encode {
namespace {

double azimuth_rad(const Rig& rig, int view) {
    const glm::dvec3 centre = rig.views[static_cast<std::size_t>(view)].camera.centre();
    return std::atan2(centre.x, centre.z);
}

double elevation_rad(const Rig& rig, int view) {
    const glm::dvec3 centre = rig.views[static_cast<std::size_t>(view)].camera.centre();
    return std::atan2(centre.y, std::hypot(centre.x, centre.z));
}

struct LeadingNumber {
    int value = -1;  // -1: none
    std::string_view ending;
};
LeadingNumber leading_number(std::string_view text) {
    LeadingNumber number;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number.value);
    if (error != std::errc{}) return {};
    number.ending = {rest, static_cast<std::size_t>(end - rest)};
    return number;
}

}  // namespace

Result<HoldOutRule> parse_hold_out(const std::string& text) {
    constexpr std::string_view kEvery = "every-", kTurn = "turn=";
    if (text.starts_with(kEvery)) {
        const auto [every, ending] = leading_number(std::string_view(text).substr(kEvery.size()));
        const bool ordinal = ending == "st" || ending == "nd" || ending == "rd" || ending == "th";
        if (ordinal && every >= 2) return HoldOutRule{HoldOutKind::kEveryNth, every};
    }
    if (text.starts_with(kTurn)) {
        const auto [turn, ending] = leading_number(std::string_view(text).substr(kTurn.size()));
        if (ending.empty() && turn >= 0) return HoldOutRule{HoldOutKind::kWholeTurn, turn};
    }
    return Error{"--hold-out " + text +
                 ": is neither every-Nth nor turn=N; use every-2nd, every-3rd and so on, or "
                 "turn=0, turn=1 and so on"};
}

Result<HoldOut> choose_hold_out(const Rig& rig, int every, const std::string& where) {
    RS_CHECK(every >= 2);
    const auto run = static_cast<std::size_t>(every);
    HoldOut chosen;
    for (const ViewRing& ring : find_rings(rig)) {
        for (std::size_t n = 0; n < ring.views.size(); ++n) {
            (n % run == run / 2 ? chosen.held : chosen.kept).push_back(ring.views[n]);
        }
    }
    if (chosen.held.empty() || chosen.kept.size() < 2) {
        return Error{where + ": " + std::to_string(rig.views.size()) + " views are too few to hold out one of every " +
                     std::to_string(every) +
                     "; a set with more views in a ring, or a smaller number, leaves some to build from and some to "
                     "score with"};
    }
    std::sort(chosen.kept.begin(), chosen.kept.end());
    std::sort(chosen.held.begin(), chosen.held.end());
    return chosen;
}

Result<HoldOut> hold_out_turn(const Rig& rig, int turn, const std::string& where) {
    HoldOut chosen;
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        const auto key = rig.views[i].extras.find("turn");
        const bool is_held = key != rig.views[i].extras.end() && *key == turn;
        (is_held ? chosen.held : chosen.kept).push_back(static_cast<int>(i));
    }
    if (chosen.held.empty()) {
        return Error{where + ": no frame has \"turn\": " + std::to_string(turn) +
                     "; sets of several turns have it, from 0 on; use every-2nd for others"};
    }
    if (chosen.kept.size() < 2) {
        return Error{where + ": fewer than two views are not of turn " + std::to_string(turn) +
                     "; use every-2nd for a set of one turn"};
    }
    return chosen;
}

Result<HoldOut> choose_hold_out(const Rig& rig, const HoldOutRule& rule, const std::string& where) {
    return rule.kind == HoldOutKind::kWholeTurn ? hold_out_turn(rig, rule.number, where)
                                                : choose_hold_out(rig, rule.number, where);
}

int nearest_kept_view(const Rig& rig, const HoldOut& hold_out, int view) {
    RS_CHECK(!hold_out.kept.empty());
    Rig kept;
    for (const int k : hold_out.kept) kept.views.push_back(rig.views[static_cast<std::size_t>(k)]);
    const std::vector<ViewRing> rings = find_rings(kept);
    const double elevation = elevation_rad(rig, view);
    const ViewRing& ring = *std::min_element(rings.begin(), rings.end(), [&](const ViewRing& a, const ViewRing& b) {
        return std::abs(a.elevation_rad - elevation) < std::abs(b.elevation_rad - elevation);
    });

    // Held-out views are usually halfway between two kept ones; rounding errors must not choose between these.
    constexpr double kSame_rad = 1e-9;
    const double azimuth = azimuth_rad(rig, view);
    int nearest = -1;
    double least = 0;
    for (const int n : ring.views) {
        const double turn = std::abs(std::remainder(azimuth_rad(kept, n) - azimuth, 2 * kPi));
        if (nearest >= 0 && turn > least - kSame_rad) continue;
        nearest = n;
        least = turn;
    }
    return hold_out.kept[static_cast<std::size_t>(nearest)];
}

int nearest_kept_direction(const Rig& rig, const HoldOut& hold_out, int view) {
    RS_CHECK(!hold_out.kept.empty());
    const auto direction = [&](int n) {
        return glm::normalize(rig.views[static_cast<std::size_t>(n)].camera.centre());
    };
    return *std::ranges::max_element(hold_out.kept, {}, [&](int n) { return glm::dot(direction(n), direction(view)); });
}

}  // namespace rs::encode
