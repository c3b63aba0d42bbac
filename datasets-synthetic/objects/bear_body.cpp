#include "datasets-synthetic/objects/bear_body.hpp"

namespace rs::synthetic {
namespace {

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

}  // namespace rs::synthetic
