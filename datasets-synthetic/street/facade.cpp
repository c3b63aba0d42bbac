#include "datasets-synthetic/street/facade.hpp"

#include "datasets-synthetic/street/street_models.hpp"

#include <array>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

constexpr float kRecess_m = 0.17F;
constexpr float kOverlap_m = 0.001F;  // of adjoining sheets in one plane, against gaps

void reveals(Pen& pen, vec2 low, vec2 high) {
    const float z = -kRecess_m;
    pen.quad("reveal", {vec3{low.x, low.y, 0}, {low.x, low.y, z}, {low.x, high.y, z}, {low.x, high.y, 0}});
    pen.quad("reveal", {vec3{high.x, low.y, z}, {high.x, low.y, 0}, {high.x, high.y, 0}, {high.x, high.y, z}});
    pen.quad("reveal", {vec3{low.x, high.y, z}, {high.x, high.y, z}, {high.x, high.y, 0}, {low.x, high.y, 0}});
    pen.quad("reveal", {vec3{low.x, low.y, 0}, {high.x, low.y, 0}, {high.x, low.y, z}, {low.x, low.y, z}});
}

void balcony(Pen& pen, vec2 low, vec2 high) {
    const float left = low.x - 0.35F;
    const float right = high.x + 0.35F;
    const float y = low.y - 0.12F;
    const float out = 0.6F;
    pen.box("sill", {left, y - 0.14F, 0}, {right, y, out + 0.05F});
    const float turns = right - left;
    const auto rail = [&](vec3 a, vec3 b, float length) {
        const vec3 up{0, 0.95F, 0};
        pen.quad("railing", {a, b, b + up, a + up}, {vec2{0, 0}, {length, 0}, {length, 1}, {0, 1}});
    };
    rail({left, y, out}, {right, y, out}, turns);
    rail({left, y, 0}, {left, y, out}, out);
    rail({right, y, out}, {right, y, 0}, out);
}

void dress(Pen& pen, const FacadeOpening& opening, vec2 low, vec2 high) {
    if (opening.balcony) {
        balcony(pen, low, high);
    } else {
        pen.box("sill", {low.x - 0.09F, low.y - 0.09F, -kRecess_m}, {high.x + 0.09F, low.y, 0.13F});
    }
    if (opening.surround) {
        pen.box("sill", {low.x - 0.15F, low.y, 0}, {low.x, high.y, 0.045F});
        pen.box("sill", {high.x, low.y, 0}, {high.x + 0.15F, high.y, 0.045F});
        pen.box("sill", {low.x - 0.15F, high.y, 0}, {high.x + 0.15F, high.y + 0.16F, 0.055F});
        pen.box("sill", {low.x - 0.22F, high.y + 0.16F, 0}, {high.x + 0.22F, high.y + 0.24F, 0.16F});
    } else {
        pen.box("sill", {low.x - 0.12F, high.y, 0}, {high.x + 0.12F, high.y + 0.2F, 0.02F});
    }
}

}  // namespace

void wall_with_openings(Pen& pen, const WallBand& band, std::span<const FacadeOpening> openings) {
    const auto wall = [&](vec2 low, vec2 high) {
        pen.wall(band.wall, low - kOverlap_m, high + kOverlap_m, 0, kWallTile_m);
    };
    if (openings.empty()) {
        wall({band.left, band.low}, {band.right, band.high});
        return;
    }
    if (band.sill > band.low) wall({band.left, band.low}, {band.right, band.sill});
    if (band.head < band.high) wall({band.left, band.head}, {band.right, band.high});
    float at = band.left;
    for (const FacadeOpening& opening : openings) {
        wall({at, band.sill}, {opening.left, band.head});
        const vec2 low{opening.left, band.sill};
        const vec2 high{opening.left + opening.width, band.head};
        reveals(pen, low, high);
        const float z = -kRecess_m;
        pen.quad(opening.look, {vec3{low, z}, {high.x, low.y, z}, vec3{high, z}, {low.x, high.y, z}});
        dress(pen, opening, low, high);
        at = high.x;
    }
    wall({at, band.sill}, {band.right, band.head});
}

void cornice(Pen& pen, float left, float right, float top, float depth_m) {
    for (int step = 0; step < 3; ++step) {
        const float share = static_cast<float>(3 - step) / 3;
        const float y = top - 0.13F * static_cast<float>(step);
        pen.box("cornice", {left - 0.02F, y - 0.13F, 0}, {right + 0.02F, y, share * depth_m});
    }
}

void awning(Pen& pen, float left, float right, float head) {
    const float out = 1.0F;
    const float low = head - 0.34F;
    const float width = right - left;
    pen.quad("awning", {vec3{left, low, out}, {right, low, out}, {right, head, 0.06F}, {left, head, 0.06F}},
             {vec2{0, 0}, {width, 0}, {width, 1}, {0, 1}});
    pen.quad(
        "awning",
        {vec3{left, low - 0.2F, out + 0.01F}, {right, low - 0.2F, out + 0.01F}, {right, low, out}, {left, low, out}},
        {vec2{0, 0}, {width, 0}, {width, 0.2F}, {0, 0.2F}});
    for (const float x : {left, right}) {
        pen.cylinder("gutter", {.foot = {x, low, out - 0.02F},
                                .axis = glm::normalize(vec3{0, head - 0.05F - low, 0.06F - out}),
                                .radius = 0.015F,
                                .length = glm::length(vec2{head - 0.05F - low, out - 0.06F}),
                                .segments = 5});
    }
}

}  // namespace rs::synthetic
