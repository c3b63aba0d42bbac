#pragma once
// Photos of a printed board, rendered through the turntable model, lens distortion included.

#include "capture/calibration/board/board_detection.hpp"
#include "rayspace/image/linear_light.hpp"
#include "tests/capture/calibration/board_turns.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <vector>

namespace rs::test {

// Value of the board at a point, in squares from the top left; 0 ink, 1 paper.
class PrintedBoard {
public:
    explicit PrintedBoard(const capture::BoardDesign& design)
        : design_(design), across_(capture::marker_cells_across(design)) {
        for (int y = 0; y < design.squares_y; ++y) {
            for (int x = 0; x < design.squares_x; ++x) {
                const int marker = capture::marker_of_square(design, x, y);
                if (marker >= 0) cells_[marker] = capture::black_marker_cells(design, marker);
            }
        }
    }
    [[nodiscard]] float paper(double u, double v) const {
        const int x = static_cast<int>(std::floor(u)), y = static_cast<int>(std::floor(v));
        if (!capture::square_is_printed(design_, x, y)) return 1;
        if (capture::square_is_black(x, y)) return 0;
        const double share = design_.marker_share;
        const double cu = (u - x - 0.5 * (1 - share)) / share * across_;
        const double cv = (v - y - 0.5 * (1 - share)) / share * across_;
        if (cu < 0 || cv < 0 || cu >= across_ || cv >= across_) return 1;
        const auto cell = static_cast<std::size_t>(static_cast<int>(cv) * across_ + static_cast<int>(cu));
        return cells_.at(capture::marker_of_square(design_, x, y))[cell] ? 0 : 1;
    }

private:
    capture::BoardDesign design_;
    int across_;
    std::map<int, std::vector<bool>> cells_;
};

// The turn of make_turn() with a smaller image.
inline capture::BoardTurn small_turn(const TurnOptions& options, std::uint32_t seed) {
    capture::BoardTurn turn = make_turn(options, seed);
    capture::Lens& lens = turn.model.lens;
    lens.width = 1024, lens.height = 768;
    lens.cx = 512, lens.cy = 384;
    lens.f_px *= 0.64;
    return turn;
}

// Paper and ink are grey, surrounded by table; an upright disc of radius `hidden_mm` at the centre hides the board
// behind it, as an object does.
inline Image<Rgba8> drawn(const capture::BoardTurn& turn, const capture::BoardDesign& design, std::size_t view,
                          double hidden_mm = 0) {
    constexpr int kSamples = 3;  // per pixel and direction
    const PrintedBoard printed(design);
    const capture::Lens& lens = turn.model.lens;
    std::mt19937 random(static_cast<std::uint32_t>(view) + 50);
    std::normal_distribution<float> noise(0, 1.5F);
    Image<Rgba8> image(lens.width, lens.height);
    const double angle = -turn.model.angles_rad[view];  // into the object frame
    const glm::dvec3 from = capture::turned({0, 0, 1}, angle);
    const capture::TableRays rays(lens, turn.model.pose, angle);
    for (int y = 0; y < lens.height; ++y) {
        for (int x = 0; x < lens.width; ++x) {
            float light = 0;
            for (int s = 0; s < kSamples * kSamples; ++s) {
                const glm::dvec2 p(x + (s % kSamples + 0.5) / kSamples, y + (s / kSamples + 0.5) / kSamples);
                const auto ray = rays.through(p);
                if (!ray) continue;
                const glm::dvec3& normal = turn.board.object_from_board[1];
                const double t = glm::dot(normal, turn.board.middle - from) / glm::dot(normal, *ray);
                const glm::dvec3 on_board = glm::transpose(turn.board.object_from_board) *
                                            (from + t * *ray - turn.board.middle) / turn.board.units_per_mm;
                const double u = on_board.x / design.square_mm + 0.5 * design.squares_x;
                const double v = on_board.z / design.square_mm + 0.5 * design.squares_y;
                const bool on_paper =
                    t > 0 && std::min(u, v) > -1 && u < design.squares_x + 1 && v < design.squares_y + 1;
                const bool hidden = hidden_mm > 0 && std::hypot(p.x - 0.5 * lens.width, p.y - 0.5 * lens.height) <
                                                         hidden_mm * turn.board.units_per_mm * lens.f_px;
                light += hidden ? 0.3F : on_paper ? 0.04F + 0.66F * printed.paper(u, v) : 0.2F;
            }
            const float grey = srgb8_from_linear(light / (kSamples * kSamples)) + noise(random);
            const auto code = static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
            image(x, y) = {code, code, code, 255};
        }
    }
    return image;
}

struct Found {
    double rms_px = 0, worst_px = 0;
    std::size_t count = 0;
};

inline Found compare(const capture::BoardCorners& seen, const capture::BoardTurn& turn,
                     const capture::BoardDesign& design, std::size_t view) {
    Found found;
    for (const capture::DetectedCorner& one : seen.corners) {
        const auto p =
            capture::project(turn.model.lens, turn.model.pose, corner_in_table(turn, design, one.corner, view));
        const double off = p ? glm::length(*p - one.p) : 1e9;
        found.rms_px += off * off;
        found.worst_px = std::max(found.worst_px, off);
        ++found.count;
    }
    found.rms_px = std::sqrt(found.rms_px / static_cast<double>(std::max<std::size_t>(1, found.count)));
    return found;
}

}  // namespace rs::test
