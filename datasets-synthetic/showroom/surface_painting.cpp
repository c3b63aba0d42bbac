#include "datasets-synthetic/showroom/surface_painting.hpp"

#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/shapes/noise.hpp"
#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/shapes/random.hpp"

#include <algorithm>
#include <cmath>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

float part(float x) {
    return x - std::floor(x);
}

int whole(float x) {
    return static_cast<int>(std::floor(x));
}

// Random number 0..1 per cell.
float chance(int x, int y, std::uint32_t seed) {
    return static_cast<float>(lattice_hash(x, y, 0, seed) >> 8U) * (1.0F / 16777216.0F);
}

// Brightness: 1 inside a board, darker in the joint at its edge.
float joint(float distance_m, float width_m) {
    return 0.55F + 0.45F * smooth_step(0.0F, width_m, distance_m);
}

}  // namespace

vec3 wood(vec2 place_m, const WoodTone& tone, std::uint32_t seed) {
    // Growth rings cut nearly lengthwise: long stretched waves, and pores along the grain.
    const float bend = layered_noise({place_m.x * 1.3F, place_m.y * 5.0F, 0.0F}, 3, seed);
    const float rings = part(place_m.y * 30.0F + bend * 2.2F);
    const float late = smooth_step(0.2F, 0.95F, rings) * (1.0F - smooth_step(0.95F, 1.0F, rings));
    const float pores = layered_noise({place_m.x * 9.0F, place_m.y * 260.0F, 3.0F}, 2, seed + 1);
    const float share = std::clamp(0.32F + 0.24F * late + 0.2F * bend + 0.2F * pores, 0.0F, 1.0F);
    return tone.light + (tone.dark - tone.light) * share;
}

vec3 planks(vec2 place_m, float width_m, float length_m, const WoodTone& tone, std::uint32_t seed) {
    const int column = whole(place_m.x / width_m);
    const float along = place_m.y / length_m + chance(column, 77, seed);
    const int board = whole(along);
    const float across_m = part(place_m.x / width_m) * width_m;
    const float along_m = part(along) * length_m;
    const float edge_m = std::min({across_m, width_m - across_m, along_m, length_m - along_m});
    const float tint = 0.82F + 0.3F * chance(column, board, seed);
    const vec2 sawn{place_m.y + 7.3F * chance(column, board, seed + 1),
                    across_m + 0.9F * chance(column, board, seed + 2)};
    return wood(sawn, tone, seed) * tint * joint(edge_m, 0.004F);
}

vec3 chevron(vec2 place_m, float column_m, float board_m, const WoodTone& tone, std::uint32_t seed) {
    const int column = whole(place_m.x / column_m);
    const float across_m = part(place_m.x / column_m) * column_m;
    const bool rises = column % 2 == 0;
    const float slant_m = place_m.y + (rises ? across_m : column_m - across_m);
    const int board = whole(slant_m / board_m);
    const float in_board_m = part(slant_m / board_m) * board_m;
    const float edge_m = std::min({in_board_m, board_m - in_board_m, across_m, column_m - across_m});
    const float tint = 0.84F + 0.28F * chance(column, board, seed);
    const vec2 sawn{across_m * 1.4F + 5.1F * chance(column, board, seed + 1),
                    in_board_m * 0.7F + 0.9F * chance(column, board, seed + 2)};
    return wood(sawn, tone, seed) * tint * joint(edge_m, 0.004F);
}

vec3 plaster(vec2 place_m, vec3 colour, std::uint32_t seed) {
    const vec3 p{place_m.x, place_m.y, 0.0F};
    return colour * (1.0F + 0.035F * layered_noise(p * 1.1F, 3, seed) + 0.02F * gradient_noise(p * 60.0F, seed + 1));
}

vec3 wicker(vec2 place_m, float strand_m, const WoodTone& tone, std::uint32_t seed) {
    const int x = whole(place_m.x / strand_m);
    const int y = whole(place_m.y / strand_m);
    const bool over = (x + y) % 2 == 0;
    const float across = std::abs(part((over ? place_m.y : place_m.x) / strand_m) - 0.5F) * 2.0F;
    const float along = std::abs(part((over ? place_m.x : place_m.y) / strand_m) - 0.5F) * 2.0F;
    const float light = (1.0F - 0.7F * across * across) * (1.0F - 0.35F * along * along);
    return (tone.dark + (tone.light - tone.dark) * light) * (0.85F + 0.25F * chance(x, y, seed));
}

vec3 rug(vec2 place_m, vec2 size_m, std::uint32_t seed) {
    const vec3 kRed = srgb(0x8A3B2C);
    const vec3 kDeep = srgb(0x5B2A2A);
    const vec3 kSand = srgb(0xD9B98A);
    const vec3 kBlue = srgb(0x33495C);
    const vec2 inside = glm::min(place_m, size_m - place_m);
    const float edge_m = std::min(inside.x, inside.y);
    vec3 colour = kRed;
    // NOLINTBEGIN(bugprone-branch-clone): stripes, one after the other
    if (edge_m < 0.03F) {
        colour = kSand;
    } else if (edge_m < 0.10F) {
        colour = kBlue;
    } else if (edge_m < 0.13F) {
        colour = kSand;
    } else if (edge_m < 0.24F) {
        // Teeth along the nearer border.
        const float run_m = inside.x < inside.y ? place_m.y : place_m.x;
        const float tooth = std::abs(part(run_m / 0.11F) - 0.5F) * 2.0F;
        colour = (edge_m - 0.13F) / 0.11F < tooth ? kDeep : kSand;
    } else if (edge_m < 0.26F) {
        colour = kBlue;
    } else {
        const vec2 cell = (place_m - 0.5F * size_m) / vec2{0.36F, 0.36F};
        const float lozenge = std::abs(part(cell.x) - 0.5F) + std::abs(part(cell.y) - 0.5F);
        colour = lozenge < 0.12F   ? kSand
                 : lozenge < 0.2F  ? kBlue
                 : lozenge < 0.36F ? kDeep
                 : lozenge < 0.42F ? kSand
                                   : kRed;
    }
    // NOLINTEND(bugprone-branch-clone)
    const float knots = gradient_noise({place_m.x * 240.0F, place_m.y * 240.0F, 0.0F}, seed);
    const float worn = layered_noise({place_m.x * 2.0F, place_m.y * 9.0F, 1.0F}, 2, seed + 1);
    return colour * (1.0F + 0.14F * knots + 0.1F * worn);
}

float contact_shadow(vec2 place_m, std::span<const Footprint> footprints) {
    float light = 1.0F;
    for (const Footprint& print : footprints) {
        float distance_m = 0.0F;
        if (print.round) {
            const vec2 half = 0.5F * (print.high - print.low);
            const vec2 off = (place_m - 0.5F * (print.low + print.high)) / half;
            distance_m = std::max(0.0F, glm::length(off) - 1.0F) * std::min(half.x, half.y);
        } else {
            distance_m = glm::length(glm::max(glm::max(print.low - place_m, place_m - print.high), vec2{0.0F}));
        }
        light *= corner_shadow(distance_m, print.reach_m, print.strength);
    }
    return light;
}

float corner_shadow(float distance_m, float reach_m, float strength) {
    const float t = std::max(distance_m, 0.0F) / reach_m;
    return 1.0F - strength / (1.0F + 3.0F * t + 6.0F * t * t);
}

}  // namespace rs::synthetic
