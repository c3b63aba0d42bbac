#include "capture/turns/turn_registration.hpp"

#include "capture/turns/hull_search.hpp"
#include "capture/turns/joint_bundle.hpp"
#include "capture/turns/joint_silhouettes.hpp"
#include "capture/turns/turn_points.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/printable.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace rs::capture {
namespace {

constexpr int kSearchMask_px = 112;
constexpr int kCheckMask_px = 256;
constexpr double kLeastOverlap = 0.75;       // of a turn that shows the object in the same pose
constexpr double kAmbiguousOverlap = 0.004;  // gain of the best azimuth over others of a body of revolution

// Groups of equal points.
class PointClasses {
public:
    explicit PointClasses(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }
    [[nodiscard]] std::size_t find(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void unite(std::size_t a, std::size_t b) { parent_[find(a)] = find(b); }

private:
    std::vector<std::size_t> parent_;
};

class TurnRegistration {
public:
    TurnRegistration(std::span<const TurnToRegister> turns, Progress* progress)
        : turns_(turns), progress_(progress), points_(turns.size()), found_(turns.size()) {}

    Result<std::vector<RegisteredTurn>> run() {
        start_progress();
        RS_TRY(find_points());
        RS_ASSIGN_OR_RETURN(const std::size_t reference, choose_reference());
        RS_TRY(place_all(reference));
        // The first turn's axis is the common one. A turn that is not upright has points, so that it may be the
        // reference.
        if (!found_.front().turn.placement.is_upright()) {
            start_progress();
            RS_TRY(place_all(0));
        }
        RS_TRY(refine());
        RS_TRY(check_overlaps());
        if (progress_ != nullptr) progress_->advance();
        return std::move(found_);
    }

private:
    void start_progress() {
        if (progress_ == nullptr) return;
        progress_->start("registering the turns", static_cast<std::int64_t>(turns_.size()) + 1);
    }

    [[nodiscard]] bool is_placed(std::size_t t) const { return std::ranges::find(placed_, t) != placed_.end(); }

    // Points of the turns whose calibration is accurate enough for guided matching.
    Status find_points() {
        for (std::size_t t = 0; t < turns_.size(); ++t) {
            const auto& calibration = turns_[t].calibration;
            if (!calibration || calibration->method == CalibrationMethod::kSilhouettes) continue;
            RS_ASSIGN_OR_RETURN(points_[t], find_turn_points(turns_[t].images, calibration->model));
        }
        return {};
    }

    // The reference: the calibrated turn with the most points; of those without, the first.
    [[nodiscard]] Result<std::size_t> choose_reference() const {
        std::optional<std::size_t> best;
        for (std::size_t t = 0; t < turns_.size(); ++t) {
            if (!turns_[t].calibration) continue;
            if (!best || points_[t].points.size() > points_[*best].points.size()) best = t;
        }
        if (!best) {
            return Error{turns_.front().name +
                         ": no turn can be calibrated alone; take one with more photos (36) at a low height, give "
                         "--fov, or an object with more texture"};
        }
        return *best;
    }

    Status place_all(std::size_t reference) {
        found_.assign(turns_.size(), {});
        found_[reference].turn.model = turns_[reference].calibration->model;
        placed_ = {reference};
        while (placed_.size() < turns_.size()) {
            if (!place_by_points()) {
                RS_TRY(place_by_silhouettes());
            }
            if (progress_ != nullptr) progress_->advance();
        }
        return {};
    }

    // Places the turn that shares the most points with one that is already placed.
    bool place_by_points() {
        std::optional<PointRegistration> best;
        std::size_t to = 0;
        for (std::size_t t = 0; t < turns_.size(); ++t) {
            if (is_placed(t) || points_[t].points.empty()) continue;
            for (const std::size_t reference : placed_) {
                auto found = register_pair(reference, t);
                if (!found || (best && found->pairs.size() <= best->pairs.size())) continue;
                best = std::move(found);
                to = t;
            }
        }
        if (!best) return false;
        found_[to].turn = {turns_[to].calibration->model, best->placement};
        found_[to].method = RegistrationMethod::kPoints;
        found_[to].pairs = best->pairs.size();
        placed_.push_back(to);
        return true;
    }

    // As upright, unless far more pairs agree with another orientation of the object: near a wrong axis some agree,
    // too.
    std::optional<PointRegistration> register_pair(std::size_t reference, std::size_t t) {
        const std::vector<glm::dvec3> common = common_points(reference);
        const std::vector<PointPair>& pairs = pairs_of(reference, t);
        auto upright = register_points(common, points_[t].points, pairs);
        auto reoriented = register_reoriented_points(common, points_[t].points, pairs);
        if (!reoriented || (upright && 2 * upright->pairs.size() > reoriented->pairs.size())) return upright;
        return reoriented;
    }

    const std::vector<PointPair>& pairs_of(std::size_t first, std::size_t second) {
        const auto [at, is_new] = pairs_.try_emplace({first, second});
        if (is_new) at->second = match_points(points_[first], points_[second]);
        return at->second;
    }

    [[nodiscard]] std::vector<glm::dvec3> common_points(std::size_t t) const {
        std::vector<glm::dvec3> points = points_[t].points;
        for (glm::dvec3& p : points) p = found_[t].turn.placement.common_from_turn(p);
        return points;
    }

    // Surface of the hull of some placed turns.
    [[nodiscard]] Result<std::vector<glm::dvec3>> placed_surface(int side_px, std::span<const std::size_t> of) const {
        std::vector<HullView> views;
        for (const std::size_t t : of) {
            for (HullView& view : hull_views(found_[t].turn, turn_masks(turns_[t].images, side_px))) {
                views.push_back(std::move(view));
            }
        }
        Result<std::vector<glm::dvec3>> surface = hull_surface(views);
        if (!surface) return Error{turns_[placed_.front()].name + ": " + surface.error().message};
        return surface;
    }

    // Model of a turn for the search: its own calibration, else the reference's lens if the photos have one size.
    [[nodiscard]] TurntableModel model_to_search(std::size_t t) const {
        if (turns_[t].calibration) return turns_[t].calibration->model;
        TurntableModel model = turns_[t].nominal;
        const TurntableModel& reference = found_[placed_.front()].turn.model;
        if (reference.lens.width == model.lens.width && reference.lens.height == model.lens.height) {
            const auto column = axis_column(model.lens, model.pose, model.lens.cy);
            model.lens = reference.lens;
            if (column) model.pose.pan_rad = std::atan((model.lens.cx - *column) / model.lens.f_px);
        }
        if ((reference.angles_rad.back() < 0) != (model.angles_rad.back() < 0)) {  // one turntable, one direction
            for (double& angle : model.angles_rad) angle = -angle;
        }
        return model;
    }

    // Best match of a turn that is not placed, and which turn it is.
    [[nodiscard]] std::pair<HullMatch, std::size_t> best_hull_match(std::span<const glm::dvec3> surface) const {
        std::optional<HullMatch> best;
        std::size_t best_turn = 0;
        double middle = 0;
        for (const glm::dvec3& p : surface) middle += p.y / static_cast<double>(surface.size());
        const PlacedTurn& reference = found_[placed_.front()].turn;
        for (std::size_t t = 0; t < turns_.size(); ++t) {
            if (is_placed(t)) continue;
            const TurnMasks masks = turn_masks(turns_[t].images, kSearchMask_px);
            const TurntableModel model = model_to_search(t);
            HullSearch search{surface, masks, model, !turns_[t].calibration, 0};
            if (search.is_tilt_free && model.lens.f_px == reference.model.lens.f_px) {
                search.expected_slant = aim_of(reference, middle).slant;
            }
            const HullMatch match = search_by_hull(search);
            if (best && match.score <= best->score) continue;
            best = match;
            best_turn = t;
        }
        return {*best, best_turn};
    }

    // Against the reference's hull if it is alone sufficient: errors of other placements would add up.
    Status place_by_silhouettes() {
        RS_ASSIGN_OR_RETURN(const std::vector<glm::dvec3> surface,
                            placed_surface(kSearchMask_px, std::span(placed_).first(1)));
        auto [best, turn] = best_hull_match(surface);
        if (best.overlap < kLeastOverlap && placed_.size() > 1) {
            RS_ASSIGN_OR_RETURN(const std::vector<glm::dvec3> all, placed_surface(kSearchMask_px, placed_));
            std::tie(best, turn) = best_hull_match(all);
        }
        const std::string& name = turns_[turn].name;
        if (best.overlap < kLeastOverlap) return no_placement(name, best.overlap);
        if (best.score - best.runner_up < kAmbiguousOverlap) {
            return Error{name + ": the silhouettes fit " + turns_[placed_.front()].name +
                         " at several azimuths equally, and too few points of the object are in both turns; take a "
                         "turn with the camera's height between them, or an object with more texture"};
        }
        found_[turn].turn = best.turn;
        found_[turn].method = RegistrationMethod::kSilhouettes;
        placed_.push_back(turn);
        return {};
    }

    [[nodiscard]] static Error no_placement(const std::string& name, double overlap) {
        return Error{
            name + ": its silhouettes do not fit the other turns at any azimuth and height (" +
            format_fixed(100 * overlap, 0) +
            " % overlap); check that it is of the same object, standing as in the other turns, in equal steps; "
            "only an object with texture may be laid down otherwise"};
    }

    // Tracks of the points that turns share, by the pairs that agree with the placements.
    [[nodiscard]] JointBundle joint_bundle() {
        JointBundle bundle;
        std::vector<std::size_t> first_point;
        std::size_t count = 0;
        for (std::size_t t = 0; t < turns_.size(); ++t) {
            bundle.turns.push_back(found_[t].turn);
            bundle.deviations.push_back(turns_[t].calibration ? turns_[t].calibration->deviations : ModelDeviations{});
            first_point.push_back(count);
            count += points_[t].points.size();
        }
        PointClasses classes(count);
        std::vector<char> is_shared(count, 0);
        for (std::size_t a = 0; a < turns_.size(); ++a) {
            for (std::size_t b = a + 1; b < turns_.size(); ++b) {
                if (points_[a].points.empty() || points_[b].points.empty()) continue;
                for (const PointPair& pair : agreeing_pairs(a, b)) {
                    classes.unite(first_point[a] + pair.first, first_point[b] + pair.second);
                    is_shared[first_point[a] + pair.first] = is_shared[first_point[b] + pair.second] = 1;
                }
            }
        }
        std::map<std::size_t, JointTrack> tracks;
        for (std::size_t t = 0; t < turns_.size(); ++t) {
            for (std::size_t i = 0; i < points_[t].points.size(); ++i) {
                if (is_shared[first_point[t] + i] == 0) continue;
                JointTrack& track = tracks[classes.find(first_point[t] + i)];
                track.point = found_[t].turn.placement.common_from_turn(points_[t].points[i]);
                for (const Observation& seen : points_[t].tracks[i].seen) {
                    track.seen.push_back({t, static_cast<std::size_t>(seen.view), seen.p});
                }
            }
        }
        for (auto& [root, track] : tracks) bundle.tracks.push_back(std::move(track));
        return bundle;
    }

    // Pairs of two placed turns whose points are near each other.
    std::vector<PointPair> agreeing_pairs(std::size_t a, std::size_t b) {
        return pairs_near(common_points(a), common_points(b), pairs_of(a, b));
    }

    Status refine() {
        JointBundle bundle = joint_bundle();
        if (!bundle.tracks.empty()) {
            RS_ASSIGN_OR_RETURN(const std::vector<JointFit> fits, adjust_jointly(bundle, placed_.front()));
            for (std::size_t t = 0; t < turns_.size(); ++t) {
                found_[t].turn = bundle.turns[t];
                found_[t].observations = fits[t].observations;
                found_[t].rms_px = fits[t].rms_px;
            }
        }
        return refine_by_silhouettes();
    }

    // Cameras of turns that share points stay.
    Status refine_by_silhouettes() {
        std::vector<SilhouettesToFit> fitted;
        bool has_free = false;
        for (std::size_t t = 0; t < turns_.size(); ++t) {
            const bool is_reference = t == placed_.front();
            const auto& calibration = turns_[t].calibration;
            const bool has_camera = calibration && calibration->method != CalibrationMethod::kSilhouettes;
            SilhouetteFreedom freedom = SilhouetteFreedom::kFixed;
            if (found_[t].method == RegistrationMethod::kSilhouettes) {
                freedom = has_camera ? SilhouetteFreedom::kPlacement : SilhouetteFreedom::kAll;
            } else if (is_reference && !has_camera) {
                freedom = SilhouetteFreedom::kCamera;
            }
            has_free = has_free || freedom != SilhouetteFreedom::kFixed;
            fitted.push_back({&turns_[t].images, found_[t].turn, freedom, 0});
        }
        if (!has_free) return {};
        RS_TRY(fit_jointly(fitted));
        for (std::size_t t = 0; t < turns_.size(); ++t) {
            found_[t].turn = fitted[t].turn;
            if (found_[t].observations == 0) found_[t].rms_px = fitted[t].rms_px;
        }
        return {};
    }

    Status check_overlaps() {
        RS_ASSIGN_OR_RETURN(const std::vector<glm::dvec3> surface, placed_surface(kCheckMask_px, placed_));
        for (std::size_t t = 0; t < turns_.size(); ++t) {
            RegisteredTurn& turn = found_[t];
            turn.overlap = silhouette_overlap(surface, turn.turn, turn_masks(turns_[t].images, kSearchMask_px));
            if (turn.overlap < kLeastOverlap) return no_placement(turns_[t].name, turn.overlap);
        }
        return {};
    }

    std::span<const TurnToRegister> turns_;
    Progress* progress_;
    std::vector<TurnPoints> points_;                                               // [turn]
    std::map<std::pair<std::size_t, std::size_t>, std::vector<PointPair>> pairs_;  // of two turns
    std::vector<RegisteredTurn> found_;                                            // [turn]
    std::vector<std::size_t> placed_;                                              // in the order they were placed
};

}  // namespace

std::string to_string(RegistrationMethod method) {
    switch (method) {
        case RegistrationMethod::kReference:
            return "reference";
        case RegistrationMethod::kPoints:
            return "points";
        case RegistrationMethod::kSilhouettes:
            return "silhouettes";
    }
    return "?";
}

Result<std::vector<RegisteredTurn>> register_turns(std::span<const TurnToRegister> turns, Progress* progress) {
    return TurnRegistration(turns, progress).run();
}

}  // namespace rs::capture
