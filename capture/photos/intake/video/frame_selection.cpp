#include "capture/photos/intake/video/frame_selection.hpp"

#include "capture/photos/intake/video/turning_speed.hpp"
#include "rayspace/api/types/check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rs::capture {
namespace {

constexpr double kUnevenCost = 0.6;  // of a step that is off by a whole step
constexpr double kBlurCost = 20;     // of a frame without any sharpness
constexpr double kMaxStep = 2.6;     // between frames if blurred ones are skipped

// Frame of the turn.
struct Candidate {
    std::size_t frame = 0;
    double angle = 0;      // in steps
    double sharpness = 0;  // relative to the sharpest frame nearby
    [[nodiscard]] long step() const { return std::lround(angle); }
};

// Mean detail of the moving region.
double mean_detail(const FrameCopy& copy, const Image<std::uint8_t>& moving) {
    double sum = 0, weight = 0;
    for (int y = 0; y < copy.detail.height(); ++y) {
        for (int x = 0; x < copy.detail.width(); ++x) {
            const int u = std::min(moving.width() - 1, x * kDetailCell_px + kDetailCell_px / 2);
            const int v = std::min(moving.height() - 1, y * kDetailCell_px + kDetailCell_px / 2);
            if (moving(u, v) == 0) continue;
            sum += copy.detail(x, y);
            weight += 1;
        }
    }
    return weight > 0 ? sum / weight : 0;
}

// Angles in steps, 0 at the first frame.
std::vector<Candidate> make_candidates(const TurnRange& turn, const std::vector<double>& speed, int count) {
    std::vector<Candidate> candidates;
    double angle = 0;
    for (std::size_t frame = turn.begin; frame < turn.end; ++frame) {
        candidates.push_back({frame, angle, 0});
        angle += speed[frame];
    }
    // In an open range the last frame is the last step.
    const double whole = turn.is_closed ? angle : candidates.back().angle;
    const double steps = turn.is_closed ? count : count - 1;
    for (Candidate& candidate : candidates) candidate.angle *= whole > 0 ? steps / whole : 0;
    return candidates;
}

void set_relative_sharpness(std::vector<Candidate>& candidates, const std::vector<FrameCopy>& copies,
                            const Image<std::uint8_t>& moving, double half_window_steps) {
    std::vector<double> values;
    for (const Candidate& candidate : candidates) values.push_back(mean_detail(copies[candidate.frame], moving));
    std::size_t begin = 0, end = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        while (candidates[i].angle - candidates[begin].angle > half_window_steps) ++begin;
        while (end < candidates.size() && candidates[end].angle - candidates[i].angle <= half_window_steps) ++end;
        const double sharpest = *std::max_element(values.begin() + static_cast<std::ptrdiff_t>(begin),
                                                  values.begin() + static_cast<std::ptrdiff_t>(end));
        candidates[i].sharpness = sharpest > 0 ? values[i] / sharpest : 1;
    }
}

double uneven_cost(double step) {
    return kUnevenCost * (step - 1) * (step - 1);
}

double blur_cost(double sharpness) {
    return kBlurCost * (1 - sharpness) * (1 - sharpness);
}

// Selects at most one candidate per step so that the sum of costs is minimal (dynamic programming over candidates).
std::vector<std::size_t> select_candidates(const std::vector<Candidate>& candidates, int steps, bool is_closed,
                                           bool may_skip_blurred) {
    struct Best {
        double cost = std::numeric_limits<double>::max();
        std::size_t previous = 0;  // its own index if it is the first
        double first_angle = 0;
    };
    std::vector<Best> best(candidates.size());
    std::size_t previous_begin = 0, previous_end = 0;  // candidates of the last step that is not empty
    std::size_t older_begin = 0;                       // and of the step before that
    long previous_step = -1;
    for (std::size_t begin = 0; begin < candidates.size();) {
        const long step = candidates[begin].step();
        std::size_t end = begin;
        while (end < candidates.size() && candidates[end].step() == step) ++end;
        if (step >= steps) break;
        const bool may_skip = may_skip_blurred && step - previous_step == 1;
        for (std::size_t i = begin; i < end; ++i) {
            const double own_cost = blur_cost(candidates[i].sharpness);
            if (previous_end == 0 || (is_closed && may_skip && older_begin == previous_begin)) {
                best[i] = {own_cost, i, candidates[i].angle};
            }
            for (std::size_t j = previous_end; j-- > 0;) {
                const double gap = candidates[i].angle - candidates[j].angle;
                if (j < previous_begin && !(may_skip_blurred && gap < kMaxStep)) break;
                const double cost = best[j].cost + own_cost + uneven_cost(gap);
                if (cost < best[i].cost) best[i] = {cost, j, best[j].first_angle};
            }
        }
        older_begin = previous_end == 0 ? begin : previous_begin;
        previous_begin = begin;
        previous_end = end;
        previous_step = step;
        begin = end;
    }
    // Adds the step from the last frame to the first.
    const auto total_cost = [&](std::size_t i) {
        return best[i].cost + (is_closed ? uneven_cost(steps - candidates[i].angle + best[i].first_angle) : 0);
    };
    std::size_t last = previous_end - 1;
    for (std::size_t i = is_closed && may_skip_blurred ? older_begin : previous_begin; i < previous_end; ++i) {
        if (total_cost(i) < total_cost(last)) last = i;
    }
    std::vector<std::size_t> chosen;
    while (true) {
        chosen.push_back(candidates[last].frame);
        if (best[last].previous == last) break;
        last = best[last].previous;
    }
    std::ranges::reverse(chosen);
    return chosen;
}

}  // namespace

FrameSelection select_frames(std::vector<FrameCopy>& copies, const FrameRequest& request, Progress* progress) {
    RS_CHECK(!copies.empty() && request.count >= 2);
    normalize_exposure(copies);
    FrameSelection selection;
    selection.moving = moving_region(copies);
    const TurningSpeed speed = turning_speed(copies, selection.moving, progress);
    selection.is_speed_measured = speed.is_measured;
    selection.turn = find_turn(copies, selection.moving, speed.per_frame);
    std::vector<Candidate> candidates = make_candidates(selection.turn, speed.per_frame, request.count);
    constexpr double kSharpnessWindow = 1 / 48.0;  // of the turn, to either side
    set_relative_sharpness(candidates, copies, selection.moving, kSharpnessWindow * request.count);
    selection.frames = select_candidates(candidates, request.count, selection.turn.is_closed, request.may_skip_blurred);
    return selection;
}

std::string selection_note(const std::string& name, const std::string& images, std::size_t count,
                           const FrameSelection& selection) {
    const TurnRange& turn = selection.turn;
    const std::string range = std::to_string(turn.begin + 1) + ".." + std::to_string(turn.end);
    const std::string what = turn.is_closed ? ", one turn is " + images + " " + range
                                            : ", of which " + range + " turn and none repeats the first";
    return name + ": " + std::to_string(count) + " " + images + what + ", " + std::to_string(selection.frames.size()) +
           " chosen";
}

}  // namespace rs::capture
