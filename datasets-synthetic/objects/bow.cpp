#include "datasets-synthetic/objects/bow.hpp"

#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/shapes/ellipsoid.hpp"
#include "datasets-synthetic/shapes/grid_surface.hpp"
#include "datasets-synthetic/shapes/sweep.hpp"

#include <utility>
#include <vector>

namespace rs::synthetic {
namespace {

using capture::Mesh;
using glm::vec3;

constexpr vec3 kKnot{0.0F, 1.00F, 0.475F};

void append_collar(Mesh& mesh) {
    std::vector<vec3> path;
    constexpr int kPoints = 96;
    for (int k = 0; k < kPoints; ++k) {
        const float angle_rad = 2.0F * static_cast<float>(kPi) * static_cast<float>(k) / kPoints;
        path.push_back({0.42F * portable::sin(angle_rad), 1.01F - 0.01F * portable::cos(angle_rad),
                        0.03F + 0.40F * portable::cos(angle_rad)});
    }
    const float half_width = 0.055F;
    append_tube(mesh, path, {&half_width, 1}, {.sides = 20, .closed = true, .facing = {0, 0, 1}, .thickness = 0.35F});
}

// A sheet of ribbon along a path; its width runs along `across` and changes along the path. Folds run lengthwise.
void append_ribbon(Mesh& mesh, const std::vector<vec3>& path, const std::vector<float>& half_widths, vec3 across) {
    constexpr int kAcross = 16;
    Grid grid(kAcross, static_cast<int>(path.size()) - 1);
    for (int j = 0; j <= grid.rows; ++j) {
        const auto k = static_cast<std::size_t>(j);
        const vec3 along = glm::normalize(path[std::min(k + 1, path.size() - 1)] - path[k == 0 ? 0 : k - 1]);
        const vec3 side = glm::normalize(across - along * glm::dot(across, along));
        const vec3 face = glm::cross(side, along);
        const float gathered = 1.0F - smooth_step(0.03F, 0.16F, half_widths[k]);  // folds gather at the knot
        for (int i = 0; i <= kAcross; ++i) {
            const float x = 2.0F * static_cast<float>(i) / kAcross - 1.0F;
            const float fold = half_widths[k] * (0.03F + 0.14F * gathered) * portable::cos(9.0F * x + 0.4F);
            grid.positions[grid.index(i, j)] = path[k] + side * (x * half_widths[k]) + face * fold;
            grid.uvs[grid.index(i, j)] = {0.5F * (x + 1.0F), static_cast<float>(j) / static_cast<float>(grid.rows)};
        }
    }
    append_grid(mesh, std::move(grid));
}

void append_loop(Mesh& mesh, float side) {
    const std::vector<vec3> controls{
        kKnot + vec3{side * 0.01F, 0.0F, 0.015F},    kKnot + vec3{side * 0.13F, 0.035F, 0.075F},
        kKnot + vec3{side * 0.27F, 0.05F, 0.065F},   kKnot + vec3{side * 0.325F, 0.045F, 0.015F},
        kKnot + vec3{side * 0.26F, 0.035F, -0.025F}, kKnot + vec3{side * 0.13F, 0.015F, -0.015F},
        kKnot + vec3{side * 0.01F, 0.0F, -0.005F}};
    const std::vector<vec3> path = smooth_curve<vec3>(controls, 8);
    std::vector<float> widths;
    for (std::size_t k = 0; k < path.size(); ++k) {
        const float t = static_cast<float>(k) / static_cast<float>(path.size() - 1);
        widths.push_back(0.032F + 0.10F * portable::sin(static_cast<float>(kPi) * t));
    }
    append_ribbon(mesh, path, widths, {side * 0.25F, 1.0F, 0.0F});
}

void append_tail(Mesh& mesh, float side) {
    const std::vector<vec3> controls{
        kKnot + vec3{side * 0.01F, -0.01F, 0.0F}, kKnot + vec3{side * 0.05F, -0.12F, 0.05F},
        kKnot + vec3{side * 0.11F, -0.23F, 0.06F}, kKnot + vec3{side * 0.15F, -0.36F, 0.10F}};
    const std::vector<vec3> path = smooth_curve<vec3>(controls, 10);
    std::vector<float> widths;
    for (std::size_t k = 0; k < path.size(); ++k) {
        const float t = static_cast<float>(k) / static_cast<float>(path.size() - 1);
        widths.push_back(0.03F + 0.055F * smooth_step(0.0F, 0.7F, t));
    }
    append_ribbon(mesh, path, widths, {1.0F, 0.25F * side, 0.0F});
}

}  // namespace

void append_bow(Mesh& mesh) {
    append_collar(mesh);
    for (const float side : {-1.0F, 1.0F}) {
        append_loop(mesh, side);
        append_tail(mesh, side);
    }
    append_ellipsoid(mesh, {{kKnot + vec3{0.0F, 0.0F, 0.02F}, glm::mat3{1.0F}}, {0.058F, 0.062F, 0.05F}}, 32, 16);
}

}  // namespace rs::synthetic
