#include "capture/calibration/board/board_calibration.hpp"

#include "capture/calibration/board/board_bundle.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/base/printable.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace rs::capture {
namespace {

constexpr int kCornerHeldOutEvery = 10;
constexpr double kCornerOutlierDeviations = 5;
constexpr double kLeastNoise_px = 0.01;  // below that the corners are numerically exact
constexpr double kContradiction_rad = radians(15);

struct Task {
    std::span<const BoardCorners> views;
    const BoardDesign& design;
    const KnownInputs& known;
    std::span<const std::string> names;
    Lens lens;  // known values, otherwise defaults
    BoardBundleOptions options;
    std::vector<BoardObservation> used, held_out;
};

std::string name_of(std::span<const std::string> names, std::size_t view) {
    return view < names.size() ? names[view] : "view " + std::to_string(view);
}

std::string list_of(std::span<const std::string> names, const std::vector<std::size_t>& views) {
    constexpr std::size_t kMost = 8;
    std::vector<std::string> of_views;
    for (const std::size_t view : views) of_views.push_back(name_of(names, view));
    return listed(of_views, kMost);
}

std::vector<std::size_t> views_without_board(const Task& task) {
    std::vector<std::size_t> without;
    for (std::size_t i = 0; i < task.views.size(); ++i) {
        if (!has_board(task.views[i], task.design)) without.push_back(i);
    }
    return without;
}

Status check(const Task& task) {
    RS_TRY(check_board_design(task.design));
    if (task.known.angles_rad && task.known.angles_rad->size() != task.views.size()) {
        return Error{"board: " + std::to_string(task.known.angles_rad->size()) + " angles for " +
                     std::to_string(task.views.size()) + " views; give one for each"};
    }
    for (const BoardCorners& view : task.views) {
        for (const DetectedCorner& seen : view.corners) {
            if (seen.corner < 0 || seen.corner >= corner_count(task.design) || !std::isfinite(seen.p.x + seen.p.y)) {
                return Error{"board: corner " + std::to_string(seen.corner) + " is not on it; detect again with " +
                             to_string(task.design)};
            }
        }
    }
    const std::vector<std::size_t> without = views_without_board(task);
    if (task.views.size() - without.size() < 3) {
        return Error{"board: " + std::to_string(task.views.size() - without.size()) + " of " +
                     std::to_string(task.views.size()) + " views show at least " +
                     std::to_string(kFewestCornersOfView) +
                     " corners of it, three are needed; check that the board is the one described (" +
                     to_string(task.design) + "), sharp, evenly lit and large in the image"};
    }
    if (task.options.free.angles == AngleFreedom::kEach && !without.empty()) {
        return Error{"board: too few corners are seen in " + list_of(task.names, without) +
                     ", so the object's angle there is undetermined; leave those images out, or state that the "
                     "steps are equal or how large they are"};
    }
    return {};
}

void split_observations(Task& task) {
    int count = 0;
    for (std::size_t i = 0; i < task.views.size(); ++i) {
        if (!has_board(task.views[i], task.design)) continue;
        for (const DetectedCorner& seen : task.views[i].corners) {
            const bool out = ++count % kCornerHeldOutEvery == 0;
            (out ? task.held_out : task.used)
                .push_back({static_cast<int>(i), corner_mm(task.design, seen.corner), seen.p});
        }
    }
}

// The median step between neighbouring views that both show the board; nothing if there are none.
std::optional<double> common_step(const Task& task, const std::vector<double>& angles_rad) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < task.views.size(); ++i) {
        if (!has_board(task.views[i - 1], task.design) || !has_board(task.views[i], task.design)) continue;
        steps.push_back(std::remainder(angles_rad[i] - angles_rad[i - 1], 2 * kPi));
    }
    if (steps.empty()) return std::nullopt;
    return median(std::move(steps));
}

// Applies apply_known(), with angles relative to the first view's. If angles or step are known, the board is rotated by
// the mean difference, so that the projections of its corners do not change.
Status apply_known_angles(const Task& task, BoardTurn& turn) {
    const std::vector<double> measured = turn.model.angles_rad;
    KnownInputs known = task.known;
    if (known.angles_rad) {
        for (double& angle : *known.angles_rad) angle -= task.known.angles_rad->front();
    } else if (known.equal_steps && !known.step_rad) {
        known.step_rad = common_step(task, measured);
        if (!known.step_rad) {
            return Error{"board: no two neighbouring views show it, so the step is unknown; give the step"};
        }
    }
    turn.model = apply_known(std::move(turn.model), known);
    if (!known.angles_rad && !known.step_rad) return {};
    const std::vector<double>& angles = turn.model.angles_rad;
    std::size_t first = 0;
    while (!has_board(task.views[first], task.design)) ++first;
    // Rotates by the mean difference; the difference of the first view alone would spread its error to all views.
    glm::dvec2 mean(0);
    for (std::size_t i = 0; i < angles.size(); ++i) {
        if (!has_board(task.views[i], task.design)) continue;
        const double d = measured[i] - angles[i];
        mean += glm::dvec2(std::cos(d), std::sin(d));
    }
    const double by = std::atan2(mean.y, mean.x);
    if (task.options.free.angles == AngleFreedom::kConstant) {
        for (std::size_t i = 0; i < angles.size(); ++i) {
            if (!has_board(task.views[i], task.design)) continue;
            const double off = std::remainder(measured[i] - angles[i] - by, 2 * kPi);
            if (std::abs(off) < kContradiction_rad) continue;
            return Error{"board: it turned by " + std::to_string(degrees(measured[i] - measured[first])) +
                         " degrees from " + name_of(task.names, first) + " to " + name_of(task.names, i) +
                         ", not by the given " + std::to_string(degrees(angles[i] - angles[first])) +
                         "; check the step and the direction of turning, or leave them out"};
        }
    }
    const glm::dmat3 turn_by(turned({1, 0, 0}, by), turned({0, 1, 0}, by), turned({0, 0, 1}, by));
    turn.board.object_from_board = turn_by * turn.board.object_from_board;
    turn.board.middle = turn_by * turn.board.middle;
    return {};
}

// The best of several starts after a few iterations of adjustment.
Result<BoardTurn> best_start(const Task& task) {
    std::vector<double> focal_lengths{task.lens.f_px};
    if (!task.known.f_px) focal_lengths = estimate_focal_lengths(task.views, task.design, task.lens);
    BoardBundleOptions options = task.options;
    options.noise_px = 1;
    options.max_iterations = 25;
    std::optional<BoardTurn> best;
    std::optional<Error> refused;
    double least = 0;
    for (const double f_px : focal_lengths) {
        Lens lens = task.lens;
        lens.f_px = f_px;
        std::optional<BoardTurn> turn = initialize_board_turn(task.views, task.design, lens);
        if (!turn) continue;
        if (Status applied = apply_known_angles(task, *turn); !applied) {
            if (!refused) refused = applied.error();
            continue;
        }
        const std::optional<double> cost = adjust(*turn, task.used, options);
        if (cost && (!best || *cost < least)) {
            best = turn;
            least = *cost;
        }
    }
    if (best) return *best;
    if (refused) return *refused;
    return Error{
        "board: no turn about one axis explains its corners; check that only the turntable turned, and that the board "
        "did not move on it"};
}

// Standard deviation of a coordinate, from the median length of the residuals (Rayleigh distribution).
double robust_noise_px(const BoardTurn& turn, std::span<const BoardObservation> seen) {
    std::vector<double> lengths;
    for (const BoardObservation& one : seen) {
        const auto r = residual(turn, one);
        lengths.push_back(r ? glm::length(*r) : 1e9);
    }
    return std::max(kLeastNoise_px, median(std::move(lengths)) / 1.1774);
}

std::vector<BoardObservation> inliers_within(const BoardTurn& turn, std::span<const BoardObservation> seen,
                                             double limit_px) {
    std::vector<BoardObservation> kept;
    for (const BoardObservation& one : seen) {
        const auto r = residual(turn, one);
        if (r && glm::length(*r) <= limit_px) kept.push_back(one);
    }
    return kept;
}

double rms_px(const BoardTurn& turn, std::span<const BoardObservation> seen) {
    double sum = 0;
    for (const BoardObservation& one : seen) {
        if (const auto r = residual(turn, one)) sum += glm::dot(*r, *r);
    }
    return seen.empty() ? 0 : std::sqrt(sum / static_cast<double>(seen.size()));
}

std::vector<std::string> warnings_about(const Task& task, const Calibration& c) {
    std::vector<std::string> warnings;
    if (const auto without = views_without_board(task); !without.empty()) {
        warnings.push_back("too few corners of the board are seen in " + list_of(task.names, without) +
                           "; their angles follow from the other views or from what was given");
    }
    if (c.deviations.f_px > 0.02 * c.model.lens.f_px) {
        warnings.emplace_back(
            "the board hardly determines the focal length; take photos of it from 20 to 60 degrees above, larger in "
            "the "
            "image");
    }
    if (c.deviations.cx > 0.02 * c.model.lens.width || c.deviations.cy > 0.02 * c.model.lens.width) {
        warnings.emplace_back("a level board hardly determines the principal point; leave it at the image centre");
    }
    if (c.rms_px > 1.0) {
        warnings.emplace_back(
            "the board's corners are off by more than a pixel; it may be bent, may have slipped, or the "
            "camera moved");
    }
    if (task.known.counter_clockwise && *task.known.counter_clockwise != (c.step_rad > 0)) {
        warnings.emplace_back(std::string("the board turns ") + (c.step_rad > 0 ? "counter-clockwise" : "clockwise") +
                              ", which is not the direction given; that of the board is used");
    }
    return warnings;
}

}  // namespace

Result<BoardCalibration> calibrate_with_board(std::span<const BoardCorners> views, const BoardDesign& design, int width,
                                              int height, const KnownInputs& known,
                                              std::span<const std::string> names) {
    Task task{views, design, known, names, {}, {}, {}, {}};
    const double assumed_f_px = 1.3 * std::max(width, height);
    task.lens = apply_known(Lens{width, height, assumed_f_px, 0.5 * width, 0.5 * height, 0, 0}, known);
    BundleFreedom& free = task.options.free;
    free = free_parameters_beside(known);
    free.k1 = free.k2 = !known.distortion;
    RS_TRY(check(task));
    split_observations(task);
    RS_ASSIGN_OR_RETURN(BoardTurn turn, best_start(task));

    std::vector<BoardObservation> used = task.used;
    for (int round = 0; round < 4; ++round) {
        task.options.noise_px = robust_noise_px(turn, used);
        // Observations rejected because of a poor start are reconsidered.
        used = inliers_within(turn, task.used, kCornerOutlierDeviations * task.options.noise_px);
        if (!adjust(turn, used, task.options)) {
            return Error{"board: the adjustment fails; check that the images are of one turn and in order"};
        }
    }
    std::vector<std::size_t> against;  // views without inliers have no angle of their own
    for (std::size_t i = 0; i < views.size() && free.angles == AngleFreedom::kEach; ++i) {
        const bool left =
            std::any_of(used.begin(), used.end(), [&](const auto& one) { return one.view == static_cast<int>(i); });
        if (!left) against.push_back(i);
    }
    if (!against.empty()) {
        return Error{
            "board: its corners in " + list_of(names, against) +
            " contradict all others; leave those images out, or check that the board did not move on the turntable"};
    }
    // Residual variance, for the deviations: each observation has two coordinates, each unknown takes one degree of
    // freedom.
    std::set<int> shown, corners;
    for (const BoardObservation& one : used) shown.insert(one.view);
    const double unknowns = 13 + (free.angles == AngleFreedom::kEach ? static_cast<double>(shown.size()) - 1 : 1);
    const double fitted = rms_px(turn, used);
    const double count = 2 * static_cast<double>(used.size());
    task.options.noise_px = std::max(kLeastNoise_px, fitted * std::sqrt(0.5 * count / std::max(1.0, count - unknowns)));

    BoardCalibration result;
    Calibration& c = result.calibration;
    c.method = CalibrationMethod::kBoard;
    c.model = turn.model;
    c.deviations = board_standard_deviations(turn, used, task.options);
    for (const BoardCorners& view : views) {
        for (const DetectedCorner& seen : view.corners) corners.insert(seen.corner);
    }
    c.points = static_cast<int>(corners.size());
    c.observations = static_cast<int>(used.size());
    c.rms_px = fitted;
    const auto held_out = inliers_within(turn, task.held_out, kCornerOutlierDeviations * task.options.noise_px);
    c.held_out_rms_px = rms_px(turn, held_out);
    c.step_rad = median_step(c.model.angles_rad);
    for (std::size_t i = 0; i < views.size(); ++i) {
        std::vector<BoardObservation> here;
        for (const BoardObservation& one : used) {
            if (one.view == static_cast<int>(i)) here.push_back(one);
        }
        c.views.push_back({static_cast<int>(here.size()), rms_px(turn, here)});
    }
    c.warnings = warnings_about(task, c);
    result.object_from_board = turn.board.object_from_board;
    result.middle = turn.board.middle;
    result.units_per_mm = turn.board.units_per_mm;
    result.mm_per_unit = 1 / turn.board.units_per_mm;
    result.plane_normal = turn.board.object_from_board[1];
    result.plane_offset = glm::dot(result.plane_normal, result.middle);
    result.outliers = static_cast<int>(task.used.size() + task.held_out.size() - used.size() - held_out.size());
    return result;
}

}  // namespace rs::capture
