#include "datasets-synthetic/objects/porcelain_brush.hpp"

#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/shapes/portable_math.hpp"

#include <cmath>
#include <vector>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

vec2 polar(float angle_rad, float radius) {
    return {radius * portable::cos(angle_rad), radius * portable::sin(angle_rad)};
}

}  // namespace

vec2 Spot::operator()(vec2 p) const {
    const vec2 t = p * size_px;
    const float c = portable::cos(turn_rad);
    const float s = portable::sin(turn_rad);
    return centre_px + vec2{stretch * (t.x * c - t.y * s), t.x * s + t.y * c};
}

vec3 glaze_white() {
    return srgb(0xE4E8E8);
}

Ink PorcelainBrush::outline() {
    return {srgb(0x0F1A66), random_.uniform(0.85F, 0.98F), 0.22F, 0.0F, random_.next()};
}

Ink PorcelainBrush::wash(float density) {
    return {srgb(0x1B41B4), density * random_.uniform(0.85F, 1.2F), 0.32F, 0.45F, random_.next()};
}

void PorcelainBrush::stroke(const Spot& at, std::span<const vec2> controls, float width_px) {
    std::vector<vec2> path = smooth_curve<vec2>(controls, 10);
    std::vector<float> radii;
    const float lean = random_.uniform(0.3F, 0.6F);  // position of the highest pressure along the stroke
    for (std::size_t i = 0; i < path.size(); ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(path.size() - 1);
        const float press = t < lean ? t / lean : (1.0F - t) / (1.0F - lean);
        radii.push_back(0.5F * width_px * (0.35F + 0.65F * press * (2.0F - press)));
        path[i] = at(path[i]);
    }
    canvas_.stroke(path, radii, outline());
}

void PorcelainBrush::blade(const Spot& at, const Blade& blade) {
    const float w = 0.5F * blade.width;
    const float l = blade.length;
    const float sway = blade.sway;
    const std::vector<vec2> left{{0, 0}, {-0.8F * w, 0.3F * l}, {-w + 0.5F * sway, 0.62F * l}, {sway, l}};
    const std::vector<vec2> right{{0, 0}, {0.8F * w, 0.3F * l}, {w + 0.5F * sway, 0.62F * l}, {sway, l}};
    std::vector<vec2> edge = smooth_curve<vec2>(left, 8);
    const std::vector<vec2> back = smooth_curve<vec2>(right, 8);
    edge.insert(edge.end(), back.rbegin() + 1, back.rend() - 1);
    for (vec2& p : edge) p = at(p);
    canvas_.fill(edge, wash(blade.density));
    for (int k = 0; k < blade.veins; ++k) {
        const float side =
            blade.veins == 1 ? 0.0F : 2.0F * static_cast<float>(k) / static_cast<float>(blade.veins - 1) - 1.0F;
        const std::vector<vec2> vein{{0.1F * side * w, 0.06F * l},
                                     {0.5F * side * w + 0.2F * sway, 0.45F * l},
                                     {0.35F * side * w + 0.7F * sway, random_.uniform(0.72F, 0.86F) * l}};
        stroke(at, vein, 0.55F * blade.line_px);
    }
    stroke(at, left, blade.line_px);
    stroke(at, right, blade.line_px);
}

void PorcelainBrush::blade_ground(const Spot& at, float length, float width) {
    constexpr int kPoints = 20;
    std::vector<vec2> edge;
    for (int k = 0; k < kPoints; ++k) {
        const vec2 on_circle = polar(portable::kTwoPiF * static_cast<float>(k) / kPoints, 1.0F);
        edge.push_back(at({0.48F * width * on_circle.x, length * (0.55F + 0.42F * on_circle.y)}));
    }
    canvas_.fill(edge, {.colour = glaze_white()});
}

void PorcelainBrush::curl(const Spot& at, float handedness, float width_px) {
    std::vector<vec2> spiral;
    for (int k = 0; k <= 9; ++k) {
        const float t = static_cast<float>(k) / 9.0F;
        spiral.push_back(vec2{0.0F, 0.5F} +
                         polar(-0.25F * portable::kTwoPiF + handedness * t * 7.5F, 0.5F * (1.0F - 0.8F * t)));
    }
    stroke(at, spiral, width_px);
}

void PorcelainBrush::peony(const Spot& at) {
    struct Ring {
        int petals;
        float from, length, width, density;
    };
    constexpr Ring kRings[] = {
        {9, 0.28F, 0.78F, 0.72F, 0.30F}, {7, 0.16F, 0.62F, 0.62F, 0.58F}, {5, 0.06F, 0.42F, 0.42F, 0.90F}};
    for (const Ring& ring : kRings) {
        const float offset_rad = random_.uniform(0.0F, portable::kTwoPiF);
        for (int k = 0; k < ring.petals; ++k) {
            const float turns = (static_cast<float>(k) + 0.12F * random_.bell()) / static_cast<float>(ring.petals);
            const float angle_rad = offset_rad + portable::kTwoPiF * turns;
            Spot petal = at;
            petal.centre_px = at(polar(angle_rad, ring.from));
            petal.turn_rad = at.turn_rad + angle_rad - 0.25F * portable::kTwoPiF;
            blade_ground(petal, ring.length, ring.width);
            blade(petal, {.length = ring.length * random_.uniform(0.9F, 1.1F),
                          .width = ring.width,
                          .sway = 0.05F * random_.bell(),
                          .density = ring.density,
                          .veins = 3,
                          .line_px = 3.2F});
        }
    }
    constexpr int kStamens = 16;
    for (int k = 0; k < kStamens; ++k) {
        const float angle_rad = random_.uniform(0.0F, portable::kTwoPiF);
        const float radius = 0.17F * std::sqrt(random_.uniform());
        dot(at(polar(angle_rad, radius)), random_.uniform(2.0F, 3.6F), k % 3 == 0 ? srgb(0xC9962E) : srgb(0xB0402A));
    }
}

void PorcelainBrush::dot(vec2 centre_px, float radius_px, vec3 colour) {
    canvas_.stroke({&centre_px, 1}, {&radius_px, 1}, {colour, 0.93F, 0.15F, 0.3F, random_.next()});
}

}  // namespace rs::synthetic
