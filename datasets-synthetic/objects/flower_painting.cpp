#include "datasets-synthetic/objects/flower_painting.hpp"

#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/shapes/noise.hpp"
#include "datasets-synthetic/shapes/paint.hpp"

#include <cmath>
#include <utility>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

constexpr int kSide_px = 256;

}  // namespace

capture::Texture paint_petal(float hue_turns, std::uint32_t seed) {
    Canvas canvas(kSide_px, kSide_px, vec3{0.0F});
    const vec3 throat = hue_colour(hue_turns + 0.02F, 0.92F, 0.50F);
    const vec3 middle = hue_colour(hue_turns, 0.72F, 0.93F);
    const vec3 edge = hue_colour(hue_turns - 0.015F, 0.38F, 0.98F);
    canvas.shade({0, 0}, vec2{kSide_px}, [&](vec2 p, vec3) {
        const float across = 2.0F * p.x / kSide_px - 1.0F;
        const float along = p.y / kSide_px;
        const float fibre = layered_noise({across * 14.0F, along * 1.6F, 0.0F}, 3, seed);
        const float cloud = layered_noise({across * 2.0F, along * 3.0F, 7.0F}, 3, seed + 9U);
        vec3 colour = glm::mix(throat, middle, smooth_step(0.02F, 0.55F, along + 0.18F * fibre));
        colour = glm::mix(colour, edge, smooth_step(0.45F, 1.1F, along + 0.3F * std::abs(across) + 0.25F * cloud));
        const float vein = smooth_step(0.12F, 0.34F, fibre) * (1.0F - 0.75F * along);
        return glm::mix(colour, throat, 0.55F * vein);
    });
    return std::move(canvas).texture("petal");
}

capture::Texture paint_leaf(std::uint32_t seed) {
    Canvas canvas(kSide_px, kSide_px, vec3{0.0F});
    canvas.shade({0, 0}, vec2{kSide_px}, [&](vec2 p, vec3) {
        const float across = std::abs(2.0F * p.x / kSide_px - 1.0F);
        const float along = p.y / kSide_px;
        const float cloud = layered_noise({p.x / 40.0F, p.y / 40.0F, 3.0F}, 4, seed);
        vec3 colour = glm::mix(srgb(0x2C5B22), srgb(0x5E8F35), 0.45F + 0.6F * cloud);
        colour = glm::mix(colour, srgb(0x8AA845), 0.35F * smooth_step(0.75F, 1.0F, across));
        // Side veins leave the midrib at 45 degrees.
        const float side = (along - 0.42F * across) * 9.0F;
        const float off = std::abs(side - std::floor(side) - 0.5F);
        const float vein = smooth_step(0.38F, 0.5F, off) * (1.0F - across);
        const float midrib = 1.0F - smooth_step(0.02F, 0.075F, across);
        return glm::mix(colour, srgb(0xA3BC66), std::fmax(0.6F * vein, 0.85F * midrib));
    });
    return std::move(canvas).texture("leaf");
}

capture::Texture paint_terracotta(std::uint32_t seed) {
    constexpr int kAround_px = 1024;
    constexpr int kUp_px = 384;
    Canvas canvas(kAround_px, kUp_px, vec3{0.0F});
    canvas.shade({0, 0}, {kAround_px, kUp_px}, [&](vec2 p, vec3) {
        const float turn = p.x / kAround_px;
        const float cloud = layered_noise({turn * 8.0F, p.y / 90.0F, 0.0F}, 5, seed, 8);
        const float groove = layered_noise({turn * 6.0F, p.y / 2.5F, 5.0F}, 2, seed + 3U, 6);
        const float speck = gradient_noise({turn * 220.0F, p.y / 4.6F, 1.0F}, seed + 5U, 220);
        vec3 colour = glm::mix(srgb(0x9A4A2B), srgb(0xC9744A), 0.5F + 0.8F * cloud);
        colour *= 1.0F + 0.16F * groove;
        const float lime =
            smooth_step(0.12F, 0.42F, layered_noise({turn * 10.0F, p.y / 70.0F, 20.0F}, 5, seed + 7U, 10));
        colour = glm::mix(colour, srgb(0xD9C2AC), 0.55F * lime);
        return glm::mix(colour, srgb(0x5A2A1A), 0.6F * smooth_step(0.45F, 0.7F, speck));
    });
    return std::move(canvas).texture("terracotta");
}

}  // namespace rs::synthetic
