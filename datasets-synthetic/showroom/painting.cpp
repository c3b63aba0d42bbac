#include "datasets-synthetic/showroom/painting.hpp"

#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/shapes/noise.hpp"
#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/shapes/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

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

namespace {

vec3 mix(vec3 a, vec3 b, float share) {
    return a + (b - a) * std::clamp(share, 0.0F, 1.0F);
}

// Overlapping ridges, paler with distance.
vec3 hills(vec2 p, std::uint32_t seed) {
    vec3 colour = mix(srgb(0xF4D9A8), srgb(0x7FA3BC), smooth_step(0.45F, 1.0F, p.y));
    const float sun = glm::length(p - vec2{0.66F, 0.66F});
    colour = mix(colour, srgb(0xFFF2CF), 1.0F - smooth_step(0.05F, 0.065F, sun));
    colour = mix(colour, srgb(0xFBE3B4), 0.5F * (1.0F - smooth_step(0.06F, 0.3F, sun)));
    const std::array<vec3, 5> kRidges{srgb(0xA9B7BF), srgb(0x8AA0A6), srgb(0x64857F), srgb(0x46694F), srgb(0x2B4430)};
    for (std::size_t k = 0; k < kRidges.size(); ++k) {
        const auto depth = static_cast<float>(k);
        const float top =
            0.58F - 0.115F * depth + 0.09F * layered_noise({p.x * (2.2F + 0.5F * depth), depth * 7.0F, 0.0F}, 4, seed);
        if (p.y < top) {
            const float fade = smooth_step(0.0F, 0.22F, top - p.y);
            colour = mix(kRidges[k], mix(kRidges[k], srgb(0xE3CFA6), 0.35F), fade);
        }
    }
    return colour;
}

vec3 sea(vec2 p, std::uint32_t seed) {
    constexpr float kHorizon = 0.42F;
    const float cloud = layered_noise({p.x * 3.0F, p.y * 9.0F, 0.0F}, 5, seed);
    vec3 colour = mix(srgb(0xD9C9B8), srgb(0x5F7F9B), smooth_step(kHorizon, 1.0F, p.y));
    colour = mix(colour, srgb(0xF6EEE2), smooth_step(0.0F, 0.5F, cloud));
    if (p.y < kHorizon) {
        const float near = (kHorizon - p.y) / kHorizon;
        const float wave = layered_noise({p.x * 10.0F / (0.25F + near), 26.0F / (0.12F + near), 0.0F}, 3, seed + 1);
        colour = mix(srgb(0x4C7D8C), srgb(0x14384A), near);
        colour = mix(colour, srgb(0xDDEBE6), smooth_step(0.22F, 0.6F, wave));
    }
    // A boat with two sails.
    const vec2 q = (p - vec2{0.36F, 0.40F}) / 0.16F;
    const bool hull = q.y > -0.22F && q.y < 0.0F && std::abs(q.x) < 0.55F + 0.8F * q.y;
    const bool main_sail = q.y > 0.05F && q.x > 0.03F && q.x < 0.5F * (1.15F - q.y);
    const bool jib = q.y > 0.05F && q.x < -0.01F && q.x > -0.42F * (0.95F - q.y);
    if (hull) colour = srgb(0x3A2A22);
    if (main_sail || jib) colour = mix(srgb(0xF3E7CF), srgb(0xC9A66B), 0.6F * std::abs(q.x));
    return colour;
}

// Coloured squares resembling fields seen from above.
vec3 fields(vec2 p, std::uint32_t seed) {
    const std::array<vec3, 7> kColours{srgb(0xD8A441), srgb(0xB5532F), srgb(0x345B63), srgb(0xE7D7B1),
                                       srgb(0x7C9070), srgb(0x8C2F39), srgb(0x23303D)};
    vec2 low{0.0F};
    vec2 high{1.0F};
    std::uint32_t at = seed;
    for (int depth = 0; depth < 6; ++depth) {
        const float cut = 0.33F + 0.34F * static_cast<float>(lattice_hash(depth, 1, 0, at) % 1000U) / 1000.0F;
        const int axis = (high.x - low.x) >= (high.y - low.y) ? 0 : 1;
        if (depth >= 3 && lattice_hash(depth, 2, 0, at) % 3U == 0U) break;
        const float line = low[axis] + (high[axis] - low[axis]) * cut;
        const bool beyond = p[axis] > line;
        (beyond ? low : high)[axis] = line;
        at = lattice_hash(depth, beyond ? 5 : 9, 0, at);
    }
    const vec2 inside = glm::min(p - low, high - p);
    const vec3 colour = kColours[at % kColours.size()];
    const float brush = layered_noise({p.x * 40.0F, p.y * 6.0F, static_cast<float>(at % 31U)}, 3, seed);
    const float border = smooth_step(0.003F, 0.010F, std::min(inside.x, inside.y));
    return mix(srgb(0x2A2522), colour * (1.0F + 0.22F * brush), border);
}

vec3 circles(vec2 p, float aspect, std::uint32_t seed) {
    vec3 colour = srgb(0xE9DFC9) * (1.0F + 0.05F * layered_noise({p.x * 6.0F, p.y * 6.0F, 0.0F}, 4, seed));
    Random random(seed);
    for (int k = 0; k < 13; ++k) {
        const float x = random.uniform(0.08F, 0.92F);
        const float y = random.uniform(0.1F, 0.9F);
        const float radius = random.uniform(0.06F, 0.2F);
        const float hue = random.uniform();
        const float rings = 2.0F + std::floor(random.uniform(0.0F, 3.0F));
        const float d = glm::length((p - vec2{x, y}) * vec2{aspect, 1.0F}) / radius;
        if (d >= 1.0F) continue;
        const float ring = std::floor(d * rings);
        const vec3 paint = hue_colour(hue + 0.31F * ring, 0.55F, 0.4F + 0.16F * ring);
        colour = mix(colour, paint, 0.88F * (1.0F - smooth_step(0.97F, 1.0F, d)));
    }
    return colour;
}

vec3 birches(vec2 p, std::uint32_t seed) {
    const float mist = layered_noise({p.x * 4.0F, p.y * 3.0F, 0.0F}, 4, seed);
    vec3 colour = mix(srgb(0x8D9B6A), srgb(0xE8D59B), smooth_step(0.1F, 0.9F, p.y + 0.2F * mist));
    const float leaves = layered_noise({p.x * 22.0F, p.y * 22.0F, 2.0F}, 3, seed + 1);
    colour = mix(colour, srgb(0xC98A2B), smooth_step(0.05F, 0.4F, leaves) * smooth_step(0.35F, 0.8F, p.y));
    Random random(seed + 2);
    for (int k = 0; k < 11; ++k) {
        const float depth = static_cast<float>(k) / 10.0F;
        const float middle =
            random.uniform(0.02F, 0.98F) + 0.02F * gradient_noise({p.y * 2.5F, depth * 9.0F, 0.0F}, seed);
        const float half = 0.008F + 0.017F * depth;
        const float across = (p.x - middle) / half;
        if (std::abs(across) >= 1.0F || p.y < 0.22F - 0.2F * depth) continue;
        const float bark = layered_noise({p.x * 30.0F, p.y * 70.0F, depth * 5.0F}, 2, seed + 3);
        const vec3 white = mix(srgb(0xF2EEE4), srgb(0x8E8B86), 0.5F + 0.5F * across);
        const vec3 trunk = bark > 0.28F ? srgb(0x2C2926) : white;
        colour = mix(colour, trunk, 0.35F + 0.65F * depth);
    }
    const float grass = 0.16F + 0.05F * layered_noise({p.x * 14.0F, 0.0F, 4.0F}, 3, seed);
    if (p.y < grass) colour = mix(colour, srgb(0x5C6B35), 0.8F);
    return colour;
}

}  // namespace

vec3 painting_colour(Painting painting, vec2 share, float aspect, std::uint32_t seed) {
    // Displacement and shading by the canvas' weave and brush strokes.
    const vec3 place{share.x * aspect * 30.0F, share.y * 30.0F, 0.0F};
    const vec2 dragged = share + 0.004F * vec2{gradient_noise(place, seed + 40), gradient_noise(place, seed + 41)};
    const vec3 colour = [&] {
        switch (painting) {
            case Painting::hills:
                return hills(dragged, seed);
            case Painting::sea:
                return sea(dragged, seed);
            case Painting::fields:
                return fields(dragged, seed);
            case Painting::circles:
                return circles(dragged, aspect, seed);
            case Painting::birches:
                break;
        }
        return birches(dragged, seed);
    }();
    return colour * (1.0F + 0.09F * layered_noise(place * vec3{3.0F, 9.0F, 1.0F}, 2, seed + 42));
}

std::function<float(vec2)> lettering(const std::string& text, vec2 size_m, float letter_height_m, float pen_m) {
    constexpr float kGap = 0.28F;    // between letters, over their height
    constexpr float kSpace = 0.55F;  // width of a space over the letters' height
    std::vector<std::vector<vec2>> strokes;
    float x = 0.0F;
    for (const char c : text) {
        if (c < 'A' || c > 'Z') {
            x += kSpace;
            continue;
        }
        const Letter letter = pen_letter(c);
        for (const std::vector<vec2>& stroke : letter.strokes) {
            strokes.emplace_back();
            for (const vec2& p : stroke) strokes.back().push_back(p + vec2{x, 0.0F});
        }
        x += letter.width + kGap;
    }
    const float width = std::max(x - kGap, 0.1F);
    const float height_m = std::min(letter_height_m, 0.9F * size_m.x / width);
    const vec2 origin = 0.5F * (size_m - vec2{width, 1.0F} * height_m);
    return [strokes = std::move(strokes), origin, height_m, pen_m](vec2 place_m) {
        const vec2 p = (place_m - origin) / height_m;
        float nearest = 1e9F;
        for (const std::vector<vec2>& stroke : strokes) {
            for (std::size_t i = 1; i < stroke.size(); ++i) {
                const vec2 along = stroke[i] - stroke[i - 1];
                const float t = std::clamp(glm::dot(p - stroke[i - 1], along) / std::max(glm::dot(along, along), 1e-9F),
                                           0.0F, 1.0F);
                nearest = std::min(nearest, glm::length(p - stroke[i - 1] - along * t));
            }
        }
        return 1.0F - smooth_step(0.35F * pen_m, 0.65F * pen_m, nearest * height_m);
    };
}

}  // namespace rs::synthetic
