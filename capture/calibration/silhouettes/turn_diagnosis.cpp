#include "capture/calibration/silhouettes/turn_diagnosis.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/base/printable.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace rs::capture {
namespace {

constexpr double kFewestAgreeing = 0.2;        // of all candidates
constexpr double kFewestAgreeingOfView = 0.4;  // of the median over all views
constexpr double kMostViewsApart = 0.15;
constexpr double kLeastExplained = 0.6;  // of the shares' scatter, explained by one change
constexpr double kLeastChange = 0.25;
constexpr double kLargestRms = 0.004;        // relative to the image's longer side: 4 px of 1000
constexpr double kMostUncertainLens = 0.25;  // deviation of f / f
constexpr double kStepWarning_deg = 0.5;
constexpr double kRepeat = 0.1;  // of the median step
constexpr double kGap = 1.6;
constexpr std::size_t kFewUneven = 4;  // steps listed individually
constexpr double kAxesApart_px = 0.5;

// [view]: share of its candidates that agree with the rig.
std::vector<double> inlier_shares(const Bundle& bundle, std::span<const int> candidates) {
    const std::vector<int> kept = observations_per_view(bundle.tracks, bundle.model.angles_rad.size());
    std::vector<double> shares;
    for (std::size_t view = 0; view < kept.size(); ++view) {
        shares.push_back(static_cast<double>(kept[view]) / std::max(1, candidates[view]));
    }
    return shares;
}

// Views whose candidates mostly disagree with the rig.
std::vector<std::size_t> disagreeing_views(const Bundle& bundle, std::span<const int> candidates) {
    const std::vector<int> kept = observations_per_view(bundle.tracks, bundle.model.angles_rad.size());
    const std::vector<double> shares = inlier_shares(bundle, candidates);
    const double least = kFewestAgreeingOfView * median(shares);
    std::vector<std::size_t> apart;
    for (std::size_t view = 0; view < kept.size(); ++view) {
        if (kept[view] < kFewestObservations || shares[view] < least) {
            apart.push_back(view);
        }
    }
    return apart;
}

std::string list_of(const std::vector<std::size_t>& views, std::span<const std::string> names) {
    std::vector<std::string> of_views;
    for (const std::size_t view : views) of_views.push_back(names[view]);
    return listed(of_views, 3);
}

// The first view after a single change: the shares before and after it have two levels that explain most of the
// variance. Nothing if the shares vary otherwise, for example with two alternating cameras.
std::optional<std::size_t> first_view_after_change(std::span<const double> shares) {
    const auto count = static_cast<double>(shares.size());
    double mean = 0, scatter = 0;
    for (const double share : shares) mean += share / count;
    for (const double share : shares) scatter += (share - mean) * (share - mean);
    std::optional<std::size_t> moment;
    double most = kLeastExplained * scatter;
    double before = 0;  // sum
    for (std::size_t view = 1; view < shares.size(); ++view) {
        before += shares[view - 1];
        const auto first = static_cast<double>(view);
        const double change = (count * mean - before) / (count - first) - before / first;
        const double explained = first * (count - first) / count * change * change;
        if (std::abs(change) < kLeastChange || explained < most) continue;
        most = explained;
        moment = view;
    }
    return moment;
}

// The view before which the object turns back by several steps, if there are photos of a turn on both sides of it.
std::optional<std::size_t> first_view_of_second_turn(std::span<const double> angles_rad) {
    constexpr std::size_t kFewestOfTurn = 5;
    constexpr double kBack_steps = 3;
    const double usual = median_step(angles_rad);
    for (std::size_t i = kFewestOfTurn; i + kFewestOfTurn <= angles_rad.size(); ++i) {
        if ((angles_rad[i] - angles_rad[i - 1]) * usual < -kBack_steps * usual * usual) return i;
    }
    return std::nullopt;
}

}  // namespace

std::vector<int> repeated_views(std::span<const double> angles_rad) {
    const double usual = std::abs(median_step(angles_rad));
    std::vector<int> repeated;
    std::vector<double> taken;
    for (std::size_t i = 0; i < angles_rad.size(); ++i) {
        const bool repeats = std::any_of(taken.begin(), taken.end(), [&](double other) {
            return std::abs(std::remainder(angles_rad[i] - other, 2 * kPi)) < kRepeat * usual;
        });
        if (repeats) {
            repeated.push_back(static_cast<int>(i));
        } else {
            taken.push_back(angles_rad[i]);
        }
    }
    return repeated;
}

Status check_plausibility(const Bundle& bundle, const ModelDeviations& deviations, std::span<const int> candidates,
                          std::span<const std::string> names) {
    const TurntableModel& model = bundle.model;
    double offered = 0;
    for (const int count : candidates) offered += count;
    const double share = observation_count(bundle) / std::max(1.0, offered);
    const std::vector<std::size_t> apart = disagreeing_views(bundle, candidates);
    const auto views = static_cast<double>(names.size());
    if (share < kFewestAgreeing || static_cast<double>(apart.size()) > kMostViewsApart * views) {
        std::string text = "the images do not show one turn before a fixed camera: " + format_fixed(100 * share, 0) +
                           " % of the observations agree with the best one";
        if (!apart.empty()) text += ", and not those of " + list_of(apart, names);
        if (const auto moment = first_view_after_change(inlier_shares(bundle, candidates))) {
            text += "; was the camera or the tripod moved at about " + names[*moment] +
                    "? Take the turn again; two turns need a folder each";
        } else {
            text += "; are they of one camera, one zoom and one object that did not move on the turntable?";
        }
        return Error{text};
    }
    const double longer = std::max(model.lens.width, model.lens.height);
    if (rms_px(bundle) > kLargestRms * longer) {
        return Error{"the best turn misses the observations by " + format_fixed(rms_px(bundle), 1) +
                     " px; are the images in the order they were taken, from one fixed camera?"};
    }
    const double usual = median_step(model.angles_rad);
    int against = 0;
    for (std::size_t i = 1; i < model.angles_rad.size(); ++i) {
        if ((model.angles_rad[i] - model.angles_rad[i - 1]) * usual < -kRepeat * usual * usual) ++against;
    }
    if (std::abs(degrees(usual)) < 0.05 || against > 0.1 * views) {
        return Error{"the angles make no turn (median step " + format_fixed(degrees(usual), 2) + " degrees, " +
                     std::to_string(against) +
                     " steps against it); are the images in the order they were taken? Names are sorted naturally"};
    }
    if (const auto second = first_view_of_second_turn(model.angles_rad)) {
        return Error{"the angles start again at " + names[*second] +
                     "; are these the photos of two turns? Give a folder for each"};
    }
    const double turn_deg = std::abs(degrees(model.angles_rad.back() - model.angles_rad.front()));
    if (turn_deg < 15 || turn_deg > 400) {
        return Error{
            "the images cover " + format_fixed(turn_deg, 1) +
            " degrees of turn; 15 to 400 are needed (one turn, without repeats; two turns need a folder each)"};
    }
    if (!(deviations.f_px < kMostUncertainLens * model.lens.f_px)) {
        return Error{"the images leave the focal length open; give it with --fov, or put a board under the object"};
    }
    return {};
}

bool has_single_change(const Bundle& bundle, std::span<const int> candidates) {
    return first_view_after_change(inlier_shares(bundle, candidates)).has_value();
}

std::vector<std::string> step_warnings(std::span<const double> angles, const ModelDeviations& deviations,
                                       std::span<const std::string> names) {
    std::vector<std::string> lines;
    std::vector<std::size_t> uneven;  // steps to these views
    const double usual = degrees(median_step(angles));
    const auto off = [&](std::size_t i) {  // deviation of step i - 1 -> i from the usual one, degrees forward
        return (degrees(angles[i] - angles[i - 1]) - usual) * (usual < 0 ? -1 : 1);
    };
    const auto step_to = [&](std::size_t i) { return std::abs(usual) + off(i); };
    const auto tolerance = [&](std::size_t i) {
        return std::max(kStepWarning_deg,
                        4 * degrees(std::hypot(deviations.angles_rad[i], deviations.angles_rad[i - 1])));
    };
    for (std::size_t i = 1; i < angles.size(); ++i) {
        const double step = step_to(i);
        if (std::abs(off(i)) <= tolerance(i)) continue;
        if (std::abs(step) < kRepeat * std::abs(usual)) {
            lines.push_back(names[i] + " is at the angle of " + names[i - 1] + " (" + format_fixed(step, 2) +
                            " degrees on); the turntable had not turned");
        } else if (i + 1 < angles.size() && std::abs(off(i) + off(i + 1)) <= tolerance(i)) {
            lines.push_back(names[i] + " is " + format_fixed(std::abs(off(i)), 1) + " degrees off (" +
                            (off(i) > 0 ? "too far" : "not far enough") + "); its true angle is used");
            ++i;
        } else if (step > kGap * std::abs(usual)) {
            lines.push_back("there is a gap of " + format_fixed(step, 1) + " degrees between " + names[i - 1] +
                            " and " + names[i] + " where other steps are " + format_fixed(std::abs(usual), 1));
        } else {
            uneven.push_back(i);
        }
    }
    const std::string others =
        " degrees where others are " + format_fixed(std::abs(usual), 1) + "; the true angles are used";
    if (uneven.size() <= kFewUneven) {
        for (const std::size_t i : uneven) {
            lines.push_back("the step from " + names[i - 1] + " to " + names[i] + " is " + format_fixed(step_to(i), 1) +
                            others);
        }
    } else {
        const auto [least, most] = std::ranges::minmax(uneven, {}, step_to);
        const std::string from = format_fixed(step_to(least), 1), to = format_fixed(step_to(most), 1);
        lines.push_back(std::to_string(uneven.size()) + " of " + std::to_string(angles.size() - 1) + " steps are " +
                        from + (from == to ? "" : " to " + to) + others);
    }
    const double closing = 360 - std::abs(degrees(angles.back() - angles.front()));
    if (closing > kGap * std::abs(usual) && closing < 90) {
        lines.push_back("the turn does not close: " + format_fixed(closing, 1) + " degrees are missing between " +
                        names.back() + " and " + names.front());
    }
    return lines;
}

std::vector<std::string> image_warnings(const Bundle& bundle, std::span<const int> candidates,
                                        std::span<const int> features, std::span<const std::string> names) {
    std::vector<std::string> lines;
    std::vector<double> counts(features.begin(), features.end());
    const double ordinary = median(counts);
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (features[i] < 0.25 * ordinary) {
            lines.push_back(names[i] + " shows " + std::to_string(features[i]) + " features where others show " +
                            format_fixed(ordinary, 0) + "; is it blurred?");
        }
    }
    const std::vector<int> kept = observations_per_view(bundle.tracks, bundle.model.angles_rad.size());
    for (const std::size_t view : disagreeing_views(bundle, candidates)) {
        if (candidates[view] < kFewestObservations) {
            lines.push_back(
                names[view] + " shows only " + std::to_string(candidates[view]) +
                " points that other images show, too, and its angle may be wrong; larger images have more of them");
            continue;
        }
        lines.push_back(names[view] + " does not fit the turn (" + std::to_string(kept[view]) + " of " +
                        std::to_string(candidates[view]) +
                        " observations agree); was the object or the camera moved? Take it again or leave it out");
    }
    return lines;
}

std::string place_warning(std::span<const ImagePlacement> places) {
    double shift_px = 0;
    double least = places.front().scale, most = least;
    for (const ImagePlacement& place : places) {
        shift_px = std::max(shift_px, glm::length(place.shift_px - places.front().shift_px));
        least = std::min(least, place.scale);
        most = std::max(most, place.scale);
    }
    return "the images were moved (by up to " + format_fixed(shift_px, 0) + " px) and scaled (by up to " +
           format_fixed(100 * (most / least - 1), 0) + " %) individually, as shops do; this is undone";
}

std::optional<std::string> axis_warning(const AxisPosition& of_tracks, const AxisPosition& of_silhouettes,
                                        int reduction) {
    const double apart = std::abs(of_tracks.position_px - of_silhouettes.position_px);
    const double believed = 3 * std::hypot(of_tracks.deviation_px, of_silhouettes.deviation_px);
    if (!(apart > std::max(believed, kAxesApart_px * reduction))) return std::nullopt;
    return "the object's texture turns about an axis " + format_fixed(apart, 1) +
           " px beside that of its silhouettes, which is used; stripes wound around the object have this effect, and "
           "so "
           "have masks that lack the same side in all images: check those, or put a printed board under the "
           "object";
}

}  // namespace rs::capture
