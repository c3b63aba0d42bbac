#include "datasets-synthetic/street/surface_patterns.hpp"

#include "datasets-synthetic/shapes/noise.hpp"
#include "datasets-synthetic/shapes/random.hpp"

#include <algorithm>
#include <cmath>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

constexpr float kRepeat_m = 4;

// Cell of a staggered bond, and the position in it.
struct BondCell {
    int column;
    int row;
    vec2 within;
};

BondCell bond_cell(vec2 p, vec2 size) {
    const float row = std::floor(p.y / size.y);
    const float across = p.x / size.x + (static_cast<int>(row) % 2 == 0 ? 0.0F : 0.5F);
    const float column = std::floor(across);
    const int columns = static_cast<int>(std::lround(kRepeat_m / size.x));
    const int rows = static_cast<int>(std::lround(kRepeat_m / size.y));
    return {static_cast<int>(column) % columns,
            static_cast<int>(row) % rows,
            {(across - column) * size.x, p.y - row * size.y}};
}

}  // namespace

float hash_share(int x, int y, std::uint32_t seed) {
    return static_cast<float>(lattice_hash(x, y, 0, seed) >> 8U) / 16777216.0F;
}

float tiling_noise(vec2 place_m, float tile_m, int features_per_m, int octaves, std::uint32_t seed) {
    const auto f = static_cast<float>(features_per_m);
    const int period = static_cast<int>(std::lround(tile_m * f));
    const auto noise = [&](float y) { return layered_noise({place_m.x * f, y * f, 0.37F}, octaves, seed, period); };
    // Along y, cross-fades into the noise of one tile below.
    const float share = place_m.y / tile_m;
    return noise(place_m.y) * (1 - share) + noise(place_m.y - tile_m) * share;
}

vec3 brick_colour(vec2 p, vec3 colour, std::uint32_t seed) {
    const BondCell cell = bond_cell(p, {0.25F, kRepeat_m / 48});
    const float rough = tiling_noise(p, kRepeat_m, 20, 2, seed + 3);
    const float joint = 0.009F + 0.006F * rough;
    const vec3 mortar = vec3(0.37F, 0.35F, 0.31F) * (1 + 0.3F * rough);
    if (cell.within.x < joint || cell.within.y < joint) return mortar * 0.85F;
    const float tone = 0.7F + 0.5F * hash_share(cell.column, cell.row, seed);
    const float burnt = hash_share(cell.column, cell.row, seed + 1) < 0.08F ? 0.55F : 1.0F;
    const float lower = cell.within.y < joint + 0.008F ? 0.75F : 1.0F;  // shaded edge
    return colour * tone * burnt * lower * (1 + 0.35F * rough);
}

vec3 block_colour(vec2 p, vec2 size, float joint_m, vec3 colour, float variation, std::uint32_t seed) {
    const BondCell cell = bond_cell(p, size);
    const float rough = tiling_noise(p, kRepeat_m, 16, 3, seed + 3);
    const float edge = std::min(cell.within.x, cell.within.y);
    if (edge < joint_m) return colour * 0.38F * (1 + 0.4F * rough);
    const float tone = 1 + variation * (2 * hash_share(cell.column, cell.row, seed) - 1);
    const float bevel = edge < joint_m + 0.01F ? 0.85F : 1.0F;
    return colour * tone * bevel * (1 + 0.28F * rough);
}

}  // namespace rs::synthetic
