#include "datasets-synthetic/shapes/noise.hpp"

#include "datasets-synthetic/shapes/random.hpp"

namespace rs::synthetic {
namespace {

// The dot product of `d` with one of the twelve directions to a cube's edges.
float edge_gradient(std::uint32_t hash, glm::vec3 d) {
    static constexpr float kEdges[12][3] = {{1, 1, 0},  {-1, 1, 0},  {1, -1, 0}, {-1, -1, 0}, {1, 0, 1},  {-1, 0, 1},
                                            {1, 0, -1}, {-1, 0, -1}, {0, 1, 1},  {0, -1, 1},  {0, 1, -1}, {0, -1, -1}};
    // Selects by the high bits: a multiplication instead of a division by 12.
    const float* edge = kEdges[(static_cast<std::uint64_t>(hash) * 12U) >> 32U];
    return edge[0] * d.x + edge[1] * d.y + edge[2] * d.z;
}

// Avoids std::floor, which is a function call without the processor's rounding instruction.
int floor_to_int(float x) {
    const int truncated = static_cast<int>(x);
    return truncated - (static_cast<float>(truncated) > x ? 1 : 0);
}

float fade(float t) {
    return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F);
}

int wrapped(int x, int period) {
    if (period <= 0) return x;
    const int rest = x % period;
    return rest < 0 ? rest + period : rest;
}

}  // namespace

float gradient_noise(glm::vec3 p, std::uint32_t seed, int period_x) {
    const glm::ivec3 c{floor_to_int(p.x), floor_to_int(p.y), floor_to_int(p.z)};
    const glm::vec3 d = p - glm::vec3{c};
    const glm::vec3 weight{fade(d.x), fade(d.y), fade(d.z)};
    const int x0 = wrapped(c.x, period_x);
    const int x1 = wrapped(c.x + 1, period_x);
    float plane[2];
    for (int k = 0; k < 2; ++k) {
        float line[2];
        for (int j = 0; j < 2; ++j) {
            const glm::vec3 corner = d - glm::vec3{0.0F, static_cast<float>(j), static_cast<float>(k)};
            const float left = edge_gradient(lattice_hash(x0, c.y + j, c.z + k, seed), corner);
            const float right =
                edge_gradient(lattice_hash(x1, c.y + j, c.z + k, seed), corner - glm::vec3{1.0F, 0.0F, 0.0F});
            line[j] = left + (right - left) * weight.x;
        }
        plane[k] = line[0] + (line[1] - line[0]) * weight.y;
    }
    return plane[0] + (plane[1] - plane[0]) * weight.z;
}

float layered_noise(glm::vec3 p, int octaves, std::uint32_t seed, int period_x) {
    float sum = 0.0F;
    float strength = 0.5F;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += strength * gradient_noise(p, seed + static_cast<std::uint32_t>(octave), period_x);
        p *= 2.0F;
        period_x *= 2;
        strength *= 0.5F;
    }
    return sum;
}

glm::vec3 vector_noise(glm::vec3 p, std::uint32_t seed) {
    return {gradient_noise(p, seed), gradient_noise(p, seed + 101U), gradient_noise(p, seed + 202U)};
}

}  // namespace rs::synthetic
