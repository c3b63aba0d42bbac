#pragma once
// Synthetic turns of a board with ground truth, for tests of board calibration.

#include "capture/calibration/board/board_detection.hpp"
#include "capture/calibration/board/board_initialization.hpp"
#include "rayspace/base/conventions.hpp"

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace rs::test {

struct TurnOptions {
    double elevation_deg = 20;
    double roll_rad = 0.01;
    int views = 36;
    double step_rad = 2 * kPi / 36;
    double step_jitter_rad = 0.02;
    double k1 = -0.12;
    double k2 = 0.02;
};

// 1600 x 1200 px; the board is off-centre, rotated and half a degree out of level.
inline capture::BoardTurn make_turn(const TurnOptions& options, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> either(-1, 1);
    capture::BoardTurn turn;
    turn.model.lens = {1600, 1200, 2100, 800, 600, options.k1, options.k2};
    const double down = radians(options.elevation_deg);
    turn.model.pose = {0.012, down + 0.01, options.roll_rad};
    for (int i = 0; i < options.views; ++i) {
        const double jitter = i == 0 ? 0 : options.step_jitter_rad * either(random);
        turn.model.angles_rad.push_back(i * options.step_rad + jitter);
    }
    turn.board.units_per_mm = 1 / (430 * std::cos(down));
    turn.board.middle = {0.02, -std::tan(down), -0.03};
    const double about = 0.4 + either(random), lean = radians(0.5);
    const glm::dmat3 leaning({1, 0, 0}, {0, std::cos(lean), std::sin(lean)}, {0, -std::sin(lean), std::cos(lean)});
    turn.board.object_from_board =
        leaning * glm::dmat3(capture::turned({1, 0, 0}, about), capture::turned({0, 1, 0}, about),
                             capture::turned({0, 0, 1}, about));
    return turn;
}

inline glm::dvec3 corner_in_table(const capture::BoardTurn& turn, const capture::BoardDesign& design, int corner,
                                  std::size_t view) {
    const glm::dvec2 at = capture::corner_mm(design, corner);
    const glm::dvec3 p =
        turn.board.units_per_mm * (turn.board.object_from_board * glm::dvec3(at.x, 0, at.y)) + turn.board.middle;
    return capture::turned(p, turn.model.angles_rad[view]);
}

// All corners inside the image with Gaussian noise; a share of them is dropped.
inline std::vector<capture::BoardCorners> corners_of(const capture::BoardTurn& turn, const capture::BoardDesign& design,
                                                     double noise_px, double unseen, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, noise_px);
    std::uniform_real_distribution<double> share(0, 1);
    std::vector<capture::BoardCorners> views(turn.model.angles_rad.size());
    for (std::size_t view = 0; view < views.size(); ++view) {
        for (int corner = 0; corner < capture::corner_count(design); ++corner) {
            if (!capture::corner_is_printed(design, corner) || share(random) < unseen) continue;
            const auto p =
                capture::project(turn.model.lens, turn.model.pose, corner_in_table(turn, design, corner, view));
            if (!p || p->x < 0 || p->y < 0 || p->x > turn.model.lens.width || p->y > turn.model.lens.height) continue;
            const double dx = noise_px > 0 ? noise(random) : 0;
            const double dy = noise_px > 0 ? noise(random) : 0;
            views[view].corners.push_back({corner, *p + glm::dvec2(dx, dy)});
        }
    }
    return views;
}

}  // namespace rs::test
