#include "datasets-synthetic/objects/bear_body.hpp"

#include "datasets-synthetic/shapes/curve.hpp"

#include <utility>

namespace rs::synthetic {
namespace {

using capture::Mesh;
using glm::vec3;

Ellipsoid upright(vec3 centre, vec3 radii) {
    return {{centre, glm::mat3{1.0F}}, radii};
}

// Ellipsoid with Y axis `along`.
Ellipsoid pointing(vec3 centre, vec3 along, vec3 radii) {
    return {frame_facing(centre, along, {0, 0, 1}), radii};
}

vec3 mirrored(vec3 v, float side) {
    return {side * v.x, v.y, v.z};
}

}  // namespace

std::vector<BearPart> bear_parts() {
    std::vector<BearPart> parts;
    parts.push_back({upright({0.0F, 0.56F, 0.0F}, {0.50F, 0.55F, 0.44F}), BearRegion::coat, 1.0F, {0, -1, 0}});
    parts.push_back({upright({0.0F, 1.34F, 0.06F}, {0.45F, 0.40F, 0.40F}), BearRegion::coat, 0.72F, {0, -0.5F, -1}});
    parts.push_back(
        {upright({0.0F, 1.24F, 0.40F}, {0.20F, 0.155F, 0.16F}), BearRegion::pale, 0.36F, {0, -0.8F, -0.6F}});
    parts.push_back({upright({0.0F, 0.22F, -0.44F}, {0.13F, 0.12F, 0.12F}), BearRegion::coat, 0.9F, {0, -1, -1}});
    for (const float side : {-1.0F, 1.0F}) {
        parts.push_back({pointing(mirrored({0.34F, 1.68F, 0.02F}, side), mirrored({0.6F, 1.0F, 0.0F}, side),
                                  {0.165F, 0.16F, 0.085F}),
                         BearRegion::coat, 0.7F, mirrored({0.5F, 0.8F, -0.3F}, side)});
        const vec3 arm = mirrored({0.42F, -0.85F, 0.42F}, side);
        parts.push_back({pointing(mirrored({0.54F, 0.72F, 0.17F}, side), arm, {0.155F, 0.37F, 0.155F}),
                         BearRegion::coat, 0.9F, arm});
        const vec3 leg = mirrored({0.36F, -0.12F, 0.92F}, side);
        parts.push_back({pointing(mirrored({0.36F, 0.19F, 0.36F}, side), leg, {0.19F, 0.40F, 0.185F}), BearRegion::coat,
                         0.9F, leg});
        const vec3 foot = mirrored({0.50F, 0.24F, 0.70F}, side);
        parts.push_back({upright(foot, {0.175F, 0.225F, 0.115F}), BearRegion::coat, 0.75F, {0, 1, -0.4F}});
    }
    return parts;
}

std::vector<Ellipsoid> bear_foot_pads() {
    std::vector<Ellipsoid> pads;
    for (const float side : {-1.0F, 1.0F}) {
        pads.push_back(upright(mirrored({0.505F, 0.235F, 0.765F}, side), {0.125F, 0.165F, 0.07F}));
    }
    return pads;
}

std::vector<Ellipsoid> bear_bare_regions() {
    std::vector<Ellipsoid> places = bear_foot_pads();
    for (Ellipsoid& pad : places) pad.radii *= 1.12F;
    for (const float side : {-1.0F, 1.0F}) places.push_back(upright({side * 0.165F, 1.425F, 0.42F}, vec3{0.095F}));
    places.push_back(upright({0.0F, 1.315F, 0.56F}, {0.105F, 0.075F, 0.07F}));
    return places;
}

BearRegion region_at(const BearPart& part, vec3 normal, vec3 position) {
    const bool is_body = part.shape.radii.y > 0.5F;
    if (is_body) {
        const vec3 p = (position - vec3{0.0F, 0.50F, 0.44F}) / vec3{0.30F, 0.34F, 1.0F};
        return normal.z > 0.2F && p.x * p.x + p.y * p.y < 1.0F ? BearRegion::pale : BearRegion::coat;
    }
    const bool is_ear = part.shape.radii.z < 0.1F;
    if (is_ear) return normal.z > 0.80F ? BearRegion::pale : BearRegion::coat;
    return part.region;
}

namespace {

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
