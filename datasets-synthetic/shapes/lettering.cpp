#include "datasets-synthetic/shapes/paint.hpp"

#include "datasets-synthetic/shapes/portable_math.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace rs::synthetic {
namespace {

using glm::vec2;

class LetterPen {
public:
    // Lifts the pen and draws straight lines through the points.
    LetterPen& lines(std::initializer_list<vec2> points) {
        strokes_.emplace_back();
        return on(points);
    }
    // Continues from the pen's position.
    LetterPen& on(std::initializer_list<vec2> points) {
        strokes_.back().insert(strokes_.back().end(), points);
        return *this;
    }
    // Continues along an elliptic arc; 0 degrees is +x, counter-clockwise is positive.
    LetterPen& arc(vec2 centre, vec2 radii, double from_deg, double to_deg) {
        constexpr int kSteps = 20;
        for (int k = 0; k <= kSteps; ++k) {
            const double angle_rad = radians(from_deg + (to_deg - from_deg) * k / kSteps);
            on({centre + radii * vec2{static_cast<float>(portable::cos(angle_rad)),
                                      static_cast<float>(portable::sin(angle_rad))}});
        }
        return *this;
    }
    // The belly of B, D, P, R between two heights, from the stem at x = 0 to `x`.
    LetterPen& bowl(float low, float high, float x) {
        const float half = 0.5F * (high - low);
        lines({{0.0F, high}});
        arc({x - 0.9F * half, low + half}, {0.9F * half, half}, 90, -90);
        return on({{0.0F, low}});
    }
    Letter lift() {
        float width = 0.0F;
        for (const auto& stroke : strokes_) {
            for (const vec2& p : stroke) width = std::max(width, p.x);
        }
        return {std::move(strokes_), width};
    }

private:
    std::vector<std::vector<vec2>> strokes_;
};

}  // namespace

Letter pen_letter(char letter) {
    constexpr float kW = 0.66F;  // the usual width
    LetterPen pen;
    switch (letter) {
        case 'A':
            return pen.lines({{0, 0}, {0.38F, 1}, {0.76F, 0}}).lines({{0.13F, 0.34F}, {0.63F, 0.34F}}).lift();
        case 'B':
            return pen.lines({{0, 0}, {0, 1}}).bowl(0.52F, 1, 0.56F).bowl(0, 0.52F, 0.64F).lift();
        case 'C':
            return pen.lines({}).arc({0.42F, 0.5F}, {0.42F, 0.5F}, 48, 312).lift();
        case 'D':
            return pen.lines({{0, 0}, {0, 1}}).bowl(0, 1, 0.7F).lift();
        case 'E':
            return pen.lines({{0.6F, 1}, {0, 1}, {0, 0}, {0.6F, 0}}).lines({{0, 0.52F}, {0.5F, 0.52F}}).lift();
        case 'F':
            return pen.lines({{0.6F, 1}, {0, 1}, {0, 0}}).lines({{0, 0.52F}, {0.5F, 0.52F}}).lift();
        case 'G':
            return pen.lines({}).arc({0.42F, 0.5F}, {0.42F, 0.5F}, 48, 360).on({{0.5F, 0.5F}}).lift();
        case 'H':
            return pen.lines({{0, 0}, {0, 1}}).lines({{kW, 0}, {kW, 1}}).lines({{0, 0.52F}, {kW, 0.52F}}).lift();
        case 'I':
            return pen.lines({{0.2F, 0}, {0.2F, 1}}).lines({{0, 0}, {0.4F, 0}}).lines({{0, 1}, {0.4F, 1}}).lift();
        case 'J':
            return pen.lines({{0.54F, 1}}).arc({0.27F, 0.27F}, {0.27F, 0.27F}, 0, -180).lift();
        case 'K':
            return pen.lines({{0, 0}, {0, 1}}).lines({{0.62F, 1}, {0, 0.42F}}).lines({{0.2F, 0.6F}, {kW, 0}}).lift();
        case 'L':
            return pen.lines({{0, 1}, {0, 0}, {0.58F, 0}}).lift();
        case 'M':
            return pen.lines({{0, 0}, {0, 1}, {0.42F, 0.3F}, {0.84F, 1}, {0.84F, 0}}).lift();
        case 'N':
            return pen.lines({{0, 0}, {0, 1}, {0.7F, 0}, {0.7F, 1}}).lift();
        case 'O':
            return pen.lines({}).arc({0.44F, 0.5F}, {0.44F, 0.5F}, 0, 360).lift();
        case 'P':
            return pen.lines({{0, 0}, {0, 1}}).bowl(0.45F, 1, 0.62F).lift();
        case 'Q':
            return pen.lines({})
                .arc({0.44F, 0.5F}, {0.44F, 0.5F}, 0, 360)
                .lines({{0.52F, 0.26F}, {0.86F, -0.06F}})
                .lift();
        case 'R':
            return pen.lines({{0, 0}, {0, 1}}).bowl(0.46F, 1, 0.62F).lines({{0.3F, 0.46F}, {kW, 0}}).lift();
        case 'S':
            return pen.lines({})
                .arc({0.31F, 0.745F}, {0.29F, 0.255F}, 25, 262)
                .arc({0.31F, 0.245F}, {0.31F, 0.245F}, 82, -155)
                .lift();
        case 'T':
            return pen.lines({{0, 1}, {0.7F, 1}}).lines({{0.35F, 1}, {0.35F, 0}}).lift();
        case 'U':
            return pen.lines({{0, 1}}).arc({0.33F, 0.33F}, {0.33F, 0.33F}, 180, 360).on({{kW, 1}}).lift();
        case 'V':
            return pen.lines({{0, 1}, {0.37F, 0}, {0.74F, 1}}).lift();
        case 'W':
            return pen.lines({{0, 1}, {0.24F, 0}, {0.48F, 0.75F}, {0.72F, 0}, {0.96F, 1}}).lift();
        case 'X':
            return pen.lines({{0, 0}, {0.68F, 1}}).lines({{0, 1}, {0.68F, 0}}).lift();
        case 'Y':
            return pen.lines({{0, 1}, {0.36F, 0.48F}, {0.72F, 1}}).lines({{0.36F, 0.48F}, {0.36F, 0}}).lift();
        case 'Z':
            return pen.lines({{0, 1}, {kW, 1}, {0, 0}, {kW, 0}}).lift();
        default:
            break;
    }
    RS_CHECK(letter >= 'A' && letter <= 'Z');
    return {};
}

}  // namespace rs::synthetic
