#include "capture/calibration/points/placement_estimation.hpp"

#include "capture/calibration/model/projection.hpp"
#include "capture/calibration/points/bundle.hpp"
#include "capture/opencv/opencv_image.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <ceres/ceres.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace rs::capture {
namespace {

constexpr double kPriorShift = 0.05;  // relative to the image width, one standard deviation
constexpr double kPriorScale = 0.05;  // of the scale's logarithm
constexpr double kPriorAngle_rad = 0.005;
constexpr double kLongestLens_widths = 25;
constexpr std::array<double, 2> kTriedFieldsOfView_deg{14, 28};
constexpr std::array<double, 2> kTriedTilts_deg{5, 30};
constexpr std::size_t kTriedTracks = 300;  // used to choose among the attempts
constexpr double kCoarsest = 0.03;         // first inlier limit, relative to the image width
constexpr double kFinestPlaces_px = 2;     // last inlier limit, in px of the reduced images

struct PlacedReprojection {
    Observation seen;
    glm::dvec2 middle;

    // place: shift x, y in px, the scale's logarithm, and the deviation of the view's angle from the common step.
    template <class T>
    bool operator()(const T* lens, const T* pose, const T* step, const T* point, const T* place, T* residuals) const {
        using std::exp;
        T p[2];
        const T angle = *step * T(seen.view) + place[3];
        if (!project_turned(lens, pose, angle, point, p)) return false;
        const T scale = exp(place[2]);
        const T x = T(middle.x) + scale * (p[0] - T(middle.x)) + place[0] - T(seen.p.x);
        const T y = T(middle.y) + scale * (p[1] - T(middle.y)) + place[1] - T(seen.p.y);
        residuals[0] = T(seen.weight[0][0]) * x + T(seen.weight[1][0]) * y;
        residuals[1] = T(seen.weight[0][1]) * x + T(seen.weight[1][1]) * y;
        return true;
    }
};

struct PlacePrior {
    double per_shift;
    double per_scale;
    double per_angle;
    template <class T>
    bool operator()(const T* place, T* residuals) const {
        residuals[0] = T(per_shift) * place[0];
        residuals[1] = T(per_shift) * place[1];
        residuals[2] = T(per_scale) * place[2];
        residuals[3] = T(per_angle) * place[3];
        return true;
    }
};

using PlaceNumbers = std::array<double, 4>;

std::vector<Track> undo_placements_of(std::span<const Track> tracks, const std::vector<ImagePlacement>& places,
                                      const glm::dvec2& middle) {
    std::vector<Track> result(tracks.begin(), tracks.end());
    for (Track& track : result) {
        for (Observation& seen : track.seen) {
            seen.p = places[static_cast<std::size_t>(seen.view)].undone(seen.p, middle);
        }
    }
    return result;
}

// Refines model, points and placements; `bundle` holds observations with their placements undone.
bool adjust_places(Bundle& bundle, std::vector<ImagePlacement>& places, double loss_px, const KnownInputs& known) {
    TurntableModel& model = bundle.model;
    const glm::dvec2 middle(model.lens.width / 2.0, model.lens.height / 2.0);
    std::array<double, 5> lens{model.lens.f_px, model.lens.cx, model.lens.cy, model.lens.k1, model.lens.k2};
    std::array<double, 3> pose{model.pose.pan_rad, model.pose.tilt_rad, model.pose.roll_rad};
    double step = model.angles_rad.back() / static_cast<double>(model.angles_rad.size() - 1);
    std::vector<PlaceNumbers> numbers;
    for (std::size_t i = 0; i < places.size(); ++i) {
        numbers.push_back({places[i].shift_px.x, places[i].shift_px.y, std::log(places[i].scale),
                           model.angles_rad[i] - static_cast<double>(i) * step});
    }
    ceres::Problem::Options ownership;
    ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::CauchyLoss loss(loss_px);
    ceres::Problem problem(ownership);
    auto* const ordering = new ceres::ParameterBlockOrdering;
    for (std::size_t i = 0; i < bundle.tracks.size(); ++i) {
        for (Observation seen : bundle.tracks[i].seen) {
            const auto view = static_cast<std::size_t>(seen.view);
            seen.p = places[view].seen(seen.p, middle);
            problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PlacedReprojection, 2, 5, 3, 1, 3, 4>(
                                         new PlacedReprojection{seen, middle}),
                                     &loss, lens.data(), pose.data(), &step, &bundle.points[i].x, numbers[view].data());
            ordering->AddElementToGroup(numbers[view].data(), 1);
        }
        if (!bundle.tracks[i].seen.empty()) ordering->AddElementToGroup(&bundle.points[i].x, 0);
    }
    for (PlaceNumbers& place : numbers) {
        if (!problem.HasParameterBlock(place.data())) continue;
        problem.AddResidualBlock(
            new ceres::AutoDiffCostFunction<PlacePrior, 4, 4>(new PlacePrior{
                loss_px / (kPriorShift * model.lens.width), loss_px / kPriorScale, loss_px / kPriorAngle_rad}),
            nullptr, place.data());
    }
    if (problem.NumResidualBlocks() == 0) {
        delete ordering;
        return false;
    }
    ordering->AddElementToGroup(lens.data(), 1);
    ordering->AddElementToGroup(pose.data(), 1);
    ordering->AddElementToGroup(&step, 1);
    std::vector<int> held{1, 2, 3, 4};
    if (known.f_px) held.insert(held.begin(), 0);
    if (held.size() == 5) {
        problem.SetParameterBlockConstant(lens.data());
    } else {
        problem.SetManifold(lens.data(), new ceres::SubsetManifold(5, held));
        problem.SetParameterLowerBound(lens.data(), 0, 0.5 * model.lens.width);
        problem.SetParameterUpperBound(lens.data(), 0, std::max(kLongestLens_widths * model.lens.width, lens[0]));
    }
    // The pan is constant, because shifts are equivalent to it.
    problem.SetManifold(pose.data(), new ceres::SubsetManifold(3, {0}));
    if (known.step_rad || known.angles_rad) problem.SetParameterBlockConstant(&step);
    ceres::Solver::Options solver;
    solver.linear_solver_type = ceres::DENSE_SCHUR;
    solver.linear_solver_ordering.reset(ordering);
    solver.max_num_iterations = 30;
    solver.function_tolerance = 1e-6;
    solver.num_threads = 1;
    solver.logging_type = ceres::SILENT;
    silence_ceres();
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    if (!summary.IsSolutionUsable()) return false;
    model.lens.f_px = lens[0];
    model.pose = {pose[0], pose[1], pose[2]};
    for (std::size_t i = 0; i < model.angles_rad.size(); ++i) {
        model.angles_rad[i] = static_cast<double>(i) * step + numbers[i][3] - numbers[0][3];
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
        places[i] = {{numbers[i][0], numbers[i][1]}, std::exp(numbers[i][2])};
    }
    return true;
}

struct Attempt {
    TurntableModel model;
    std::vector<ImagePlacement> places;
    int agreeing = 0;
};

// Refines the attempt with inlier limits halved from first_px down to last_px.
bool improve(Attempt& attempt, std::span<const Track> tracks, double first_px, double last_px,
             const KnownInputs& known) {
    const glm::dvec2 middle(attempt.model.lens.width / 2.0, attempt.model.lens.height / 2.0);
    for (double limit = first_px; limit > 0.7 * last_px; limit *= 0.5) {
        Bundle bundle = make_robust_bundle(attempt.model, undo_placements_of(tracks, attempt.places, middle), limit);
        if (!adjust_places(bundle, attempt.places, 0.5 * limit, known)) return false;
        attempt.model = bundle.model;
    }
    attempt.agreeing = observation_count(
        make_robust_bundle(attempt.model, undo_placements_of(tracks, attempt.places, middle), last_px));
    return true;
}

// Equal steps in both directions, which differ little without perspective; several focal lengths and tilts.
std::vector<Attempt> initial_attempts(const Lens& lens, std::size_t views, const KnownInputs& known) {
    std::vector<Attempt> all;
    for (const bool counter_clockwise : {false, true}) {
        if (known.counter_clockwise && *known.counter_clockwise != counter_clockwise) continue;
        const double sense = counter_clockwise ? 1 : -1;
        for (const double fov_deg : kTriedFieldsOfView_deg) {
            for (const double tilt_deg : kTriedTilts_deg) {
                Attempt attempt;
                attempt.model.lens = lens;
                attempt.model.lens.f_px = known.f_px.value_or(0.5 * lens.width / std::tan(0.5 * radians(fov_deg)));
                attempt.model.pose = known.pose.value_or(CameraPose{0, radians(tilt_deg), 0});
                const double step = sense * std::abs(known.step_rad.value_or(2 * kPi / static_cast<double>(views)));
                for (std::size_t i = 0; i < views; ++i) {
                    attempt.model.angles_rad.push_back(static_cast<double>(i) * step);
                }
                attempt.places.resize(views);
                all.push_back(std::move(attempt));
                if (known.pose) break;
            }
            if (known.f_px) break;
        }
    }
    return all;
}

}  // namespace

std::optional<PlacementEstimate> estimate_placements(std::span<const Track> tracks, const Lens& lens, std::size_t views,
                                                     int reduction, const KnownInputs& known) {
    std::vector<Track> few;
    const std::size_t most = std::min(kTriedTracks, tracks.size());
    for (std::size_t i = 0; i < most; ++i) few.push_back(tracks[i * tracks.size() / most]);
    const double coarsest = kCoarsest * lens.width;
    const double finest = kFinestPlaces_px * reduction;
    std::vector<Attempt> tried = initial_attempts(lens, views, known);
    for_each_index(tried.size(), [&](std::size_t i) { improve(tried[i], few, coarsest, finest, known); });
    Attempt& best = *std::max_element(tried.begin(), tried.end(),
                                      [](const Attempt& a, const Attempt& b) { return a.agreeing < b.agreeing; });
    if (best.agreeing == 0 || !improve(best, tracks, 4 * finest, finest, known)) return std::nullopt;
    double offered = 0;
    for (const Track& track : tracks) offered += static_cast<double>(track.seen.size());
    return PlacementEstimate{std::move(best.places), std::move(best.model), best.agreeing / std::max(1.0, offered)};
}

std::optional<std::vector<ImagePlacement>> estimate_remaining_placements(const Bundle& bundle, double limit_px,
                                                                         const KnownInputs& known) {
    Bundle own = bundle;
    std::vector<ImagePlacement> places(bundle.model.angles_rad.size());
    if (!adjust_places(own, places, 0.5 * limit_px, known)) return std::nullopt;
    return places;
}

TurnImages undo_placements(const TurnImages& turn, std::span<const ImagePlacement> places) {
    TurnImages back = turn;
    const double reduction = turn.reduction;
    const glm::dvec2 middle = glm::dvec2(turn.width, turn.height) / (2 * reduction);
    for_each_index(places.size(), [&](std::size_t i) {
        const ImagePlacement place{places[i].shift_px / reduction, places[i].scale};
        const glm::dvec2 origin = place.seen({0.5, 0.5}, middle) - 0.5;  // position of the first pixel's centre
        const cv::Matx23d seen(place.scale, 0, origin.x, 0, place.scale, origin.y);
        const auto warp = [&](Image<std::uint8_t>& plane) {
            const Image<std::uint8_t> from = plane;
            cv::Mat1b out(plane.height(), plane.width(), plane.data());
            cv::warpAffine(mat_view(from), out, seen, out.size(), cv::INTER_CUBIC | cv::WARP_INVERSE_MAP);
        };
        warp(back.images[i].grey);
        warp(back.images[i].alpha);
    });
    return back;
}

}  // namespace rs::capture
