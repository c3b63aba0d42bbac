// Positions and normals of triangle hits.
#include "capture/tracer/packets/surface_lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "capture/tracer/packets/place_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "capture/tracer/packets/float_lanes.inl"

HWY_BEFORE_NAMESPACE();
namespace rs::capture::HWY_NAMESPACE {

void place(const TriangleLanes& triangles, const Lanes3& directions, float step_off, SurfaceLanes& surfaces) {
    const Floats zero = number(0.0F), one = number(1.0F);
    for (std::size_t i = 0; i < kLanes; i += lanes_at_once()) {
        const Floats u = load(triangles.u, i), v = load(triangles.v, i);
        const Floats weights[3] = {one - u - v, u, v};
        const Floats3 corners[3] = {load(triangles.corner[0], i), load(triangles.corner[1], i),
                                    load(triangles.corner[2], i)};
        const Floats3 normals[3] = {load(triangles.normal[0], i), load(triangles.normal[1], i),
                                    load(triangles.normal[2], i)};
        const Floats3 position = corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
        const Floats3 direction = load(directions, i);

        const Floats3 across = cross(corners[1] - corners[0], corners[2] - corners[0]) * load(triangles.winding, i);
        const Floats across_length = length(across);
        Floats3 facet = either(hn::Gt(across_length, zero), across / across_length, negated(direction));
        const Mask front = hn::Lt(dot(facet, direction), zero);
        facet = either(front, facet, negated(facet));

        const Floats3 blended = normals[0] * weights[0] + normals[1] * weights[1] + normals[2] * weights[2];
        const Floats blended_length = length(blended);
        const Mask curved = hn::Gt(blended_length, number(1e-6F));
        const Floats side = hn::IfThenElse(hn::Lt(dot(blended, facet), zero), number(-1.0F), one);
        Floats3 lifted = position;
        for (int corner = 0; corner < 3; ++corner) {
            const Floats3 normal = normals[corner] * side;
            const Floats below = lesser(zero, dot(position - corners[corner], normal));
            lifted = lifted - normal * (weights[corner] * below);
        }
        const Mask thin = hn::Gt(load(surfaces.material.translucency, i), zero);
        const Floats3 step = facet * number(step_off);

        store(position, surfaces.position, i);
        store_mask(front, surfaces.front_side, i);
        store(facet, surfaces.geometric_normal, i);
        store(either(curved, blended * (side / blended_length), facet), surfaces.normal, i);
        store(either(hn::AndNot(thin, curved), lifted, position) + step, surfaces.near_start, i);
        store(position - step, surfaces.far_start, i);
        for (const bool of_x : {true, false}) {
            const auto at = [&](int corner) {
                const Lanes2& uv = triangles.uv[static_cast<std::size_t>(corner)];
                return load(of_x ? uv.x : uv.y, i);
            };
            store(at(0) * weights[0] + at(1) * weights[1] + at(2) * weights[2], of_x ? surfaces.uv.x : surfaces.uv.y,
                  i);
        }
    }
}

}  // namespace rs::capture::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rs::capture {

HWY_EXPORT(place);

void place_surfaces(const TriangleLanes& triangles, const Lanes3& direction, float step_off, SurfaceLanes& surfaces) {
    HWY_DYNAMIC_DISPATCH(place)(triangles, direction, step_off, surfaces);
}

}  // namespace rs::capture
#endif  // HWY_ONCE
