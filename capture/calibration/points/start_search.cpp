#include "capture/calibration/points/bundle.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rs::capture {
namespace {

constexpr std::array<double, 3> kFieldsOfView_deg{12, 28, 55};
constexpr std::array<double, 3> kTilts_deg{2, 22, 50};
constexpr std::size_t kMostTracks = 500;  // used to choose a start
constexpr std::size_t kFewTracks = 200;   // used to choose the finalists
constexpr double kEnoughToChoose = 1e-4;  // function tolerance
constexpr double kLoss_px = 3;            // large, because wrong matches are still included
constexpr std::size_t kFinalists = 4;     // of each direction of turning
constexpr std::array<double, 3> kLimits_px{8, 5, 3};

// An evenly spaced selection: the longest tracks would be those of highlights, or of jumps along a repetitive pattern.
std::vector<Track> sample_tracks(std::span<const Track> tracks, std::size_t count) {
    std::vector<Track> chosen;
    const std::size_t most = std::min(count, tracks.size());
    for (std::size_t i = 0; i < most; ++i) chosen.push_back(tracks[i * tracks.size() / most]);
    return chosen;
}

glm::dvec2 middle_of(std::span<const Track> tracks) {
    glm::dvec2 sum(0.0);
    double count = 0;
    for (const Track& track : tracks) {
        for (const Observation& seen : track.seen) {
            sum += seen.p;
            ++count;
        }
    }
    return sum / std::max(1.0, count);
}

bool moves_up_and_down(std::span<const MatchedPair> pairs) {
    double along_x = 0, along_y = 0;
    for (const MatchedPair& pair : pairs) {
        along_x += pair.spread_x_px * pair.matches;
        along_y += pair.spread_y_px * pair.matches;
    }
    return along_y > 1.3 * along_x;
}

struct Hypothesis {
    TurntableModel model;
    bool counter_clockwise = false;
};

std::vector<Hypothesis> hypotheses(std::span<const Track> tracks, std::span<const MatchedPair> pairs, int views,
                                   const Lens& middle, const KnownInputs& known) {
    const glm::dvec2 centre = middle_of(tracks);
    std::vector<double> rolls{0};
    if (moves_up_and_down(pairs)) rolls = {0.5 * kPi, -0.5 * kPi};
    std::vector<Hypothesis> all;
    for (const double fov_deg : kFieldsOfView_deg) {
        for (const double tilt_deg : kTilts_deg) {
            for (const double roll : rolls) {
                for (const bool counter_clockwise : {false, true}) {
                    if (known.f_px && fov_deg != kFieldsOfView_deg[0]) continue;
                    if (known.pose && (tilt_deg != kTilts_deg[0] || roll != rolls[0])) continue;
                    if (known.counter_clockwise && counter_clockwise != *known.counter_clockwise) continue;
                    Hypothesis h{{middle, {}, {}}, counter_clockwise};
                    h.model.lens.f_px = known.f_px.value_or(0.5 * middle.width / std::tan(0.5 * radians(fov_deg)));
                    const double beside = roll == 0  ? middle.cx - centre.x
                                          : roll > 0 ? centre.y - middle.cy
                                                     : middle.cy - centre.y;
                    h.model.pose =
                        known.pose.value_or(CameraPose{std::atan(beside / h.model.lens.f_px), radians(tilt_deg), roll});
                    const double sense = counter_clockwise ? 1 : -1;
                    double step = sense * 2 * kPi / views;
                    if (known.step_rad) step = std::abs(*known.step_rad) * sense;
                    for (int i = 0; i < views; ++i) h.model.angles_rad.push_back(i * step);
                    if (known.angles_rad) h.model.angles_rad = *known.angles_rad;
                    all.push_back(std::move(h));
                }
            }
        }
    }
    return all;
}

}  // namespace

std::optional<InitialModel> find_initial_model(std::span<const Track> tracks, std::span<const MatchedPair> pairs,
                                               int views, const Lens& middle, const KnownInputs& known) {
    const std::vector<Track> few = sample_tracks(tracks, kMostTracks);
    const std::vector<Track> fewest = sample_tracks(tracks, kFewTracks);
    std::vector<Hypothesis> tried = hypotheses(few, pairs, views, middle, known);
    BundleOptions options;
    // Errors grow with the size of the photos.
    const double scale_px = std::max(1.0, std::max(middle.width, middle.height) / 1000.0);
    options.loss_px = kLoss_px * scale_px;
    options.max_iterations = 25;
    options.function_tolerance = kEnoughToChoose;
    options.free.f = !known.f_px;
    options.free.pan = options.free.tilt = options.free.roll = !known.pose;
    options.free.angles = known.step_rad || known.angles_rad ? AngleFreedom::kConstant : AngleFreedom::kCommonStep;

    std::vector<Bundle> bundles(tried.size());
    std::vector<double> costs(tried.size(), 1e30);
    for_each_index(tried.size(), [&](std::size_t i) {
        bundles[i] = make_bundle(tried[i].model, fewest);
        // Most tracks must be triangulated, otherwise a rig that explains three of them would win.
        if (bundles[i].tracks.size() * 2 < fewest.size()) return;
        const auto cost = adjust(bundles[i], options);
        if (!cost) return;
        const auto lost =
            static_cast<double>(fewest.size() - bundles[i].tracks.size()) / static_cast<double>(fewest.size());
        costs[i] = *cost + lost * 4 * options.loss_px * options.loss_px;
    });
    // Wrong matches are rejected for the finalists; the start with the most inliers is chosen.
    std::vector<std::size_t> order;
    for (const bool sense : {false, true}) {
        std::vector<std::size_t> of_sense;
        for (std::size_t i = 0; i < tried.size(); ++i) {
            if (tried[i].counter_clockwise == sense && costs[i] < 1e29) of_sense.push_back(i);
        }
        std::stable_sort(of_sense.begin(), of_sense.end(), [&](auto a, auto b) { return costs[a] < costs[b]; });
        if (of_sense.size() > kFinalists) of_sense.resize(kFinalists);
        order.insert(order.end(), of_sense.begin(), of_sense.end());
    }
    std::vector<int> agreeing(order.size(), 0);
    for_each_index(order.size(), [&](std::size_t k) {
        Bundle& bundle = bundles[order[k]];
        BundleOptions own = options;
        for (const double limit_px : kLimits_px) {
            Bundle next = make_robust_bundle(bundle.model, few, limit_px * scale_px);
            own.loss_px = 0.5 * limit_px * scale_px;
            if (next.tracks.size() < 10 || !adjust(next, own)) return;
            bundle = std::move(next);
        }
        agreeing[k] = observation_count(make_robust_bundle(bundle.model, few, kLimits_px.back() * scale_px));
    });
    if (order.empty()) return std::nullopt;
    const auto best = static_cast<std::size_t>(std::max_element(agreeing.begin(), agreeing.end()) - agreeing.begin());
    if (agreeing[best] == 0) return std::nullopt;
    InitialModel start{bundles[order[best]].model, agreeing[best], 0};
    for (std::size_t k = 0; k < order.size(); ++k) {
        if (tried[order[k]].counter_clockwise != tried[order[best]].counter_clockwise) {
            start.agreeing_opposite = std::max(start.agreeing_opposite, agreeing[k]);
        }
    }
    return start;
}

}  // namespace rs::capture
