// Light from point, area and directional lights at sixteen positions.
#include "capture/tracer/packets/light_lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "capture/tracer/packets/light_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "capture/tracer/packets/float_lanes.inl"

HWY_BEFORE_NAMESPACE();
namespace rs::capture::HWY_NAMESPACE {

// Vector version of LightSet::estimate() for point sources. `way` goes from the light to the position.
HWY_INLINE Mask is_reached(const PointLight& light, const Floats3& way, Floats distance2, Floats distance) {
    const Floats zero = number(0.0F), one = number(1.0F);
    Mask none = hn::Not(hn::Gt(distance, zero));
    none = hn::Or(none, hn::Gt(distance, number(static_cast<float>(light.radius))));
    none = hn::Or(none, hn::Lt(dot(way, broadcast(light.towards)), number(light.min_cos) * distance));
    const Floats falloff =
        greater(dot(broadcast(light.attenuation), {one, distance, distance2}), number(light.least_attenuation));
    return hn::AndNot(none, hn::Gt(number(light.power) / falloff, zero));
}

bool cull(const PointLight& light, const SurfaceLanes& surfaces, const MaskLanes& active, MaskLanes& reached) {
    const Floats zero = number(0.0F);
    bool any_lit = false;
    for (std::size_t i = 0; i < kLanes; i += lanes_at_once()) {
        const Floats3 way = load(surfaces.near_start, i) - broadcast(glm::vec3(light.location));
        const Floats distance2 = dot(way, way);
        const Floats distance = hn::Sqrt(distance2);
        const Floats cosine = dot(negated(way) / distance, load(surfaces.normal, i));
        const Mask open = hn::Or(hn::Gt(cosine, zero), hn::Gt(load(surfaces.material.translucency, i), zero));
        const Mask there = hn::And(hn::And(load_mask(active, i), open), is_reached(light, way, distance2, distance));
        store_mask(there, reached, i);
        any_lit = any_lit || any(there);
    }
    return any_lit;
}

// Attenuated strength as computed by irradiance_at(), in double precision; 0 outside the light's radius.
HWY_INLINE void compute_strengths(const PointLight& light, const Lanes3& positions, Lanes& strengths) {
    using Tag = hn::CappedTag<double, kLanes / 2>;
    using Half = hn::Rebind<float, Tag>;
    const auto number = [](double value) { return hn::Set(Tag(), value); };
    const auto zero = number(0.0);
    for (std::size_t i = 0; i < kLanes; i += hn::Lanes(Tag())) {
        const auto wide = [&](const Lanes& lanes) {
            return hn::PromoteTo(Tag(), hn::Load(Half(), lanes.of.data() + i));
        };
        const auto x = wide(positions.x) - number(light.location.x);
        const auto y = wide(positions.y) - number(light.location.y);
        const auto z = wide(positions.z) - number(light.location.z);
        const auto distance2 = x * x + y * y + z * z;
        const auto d = hn::Sqrt(distance2);
        const auto attenuation = number(static_cast<double>(light.attenuation.x)) * number(1.0) +
                                 number(static_cast<double>(light.attenuation.y)) * d +
                                 number(static_cast<double>(light.attenuation.z)) * distance2;
        const auto least = number(static_cast<double>(light.least_attenuation));
        const auto strength = number(1.0) / hn::IfThenElse(hn::Lt(attenuation, least), least, attenuation);
        const auto lit = hn::AndNot(hn::Gt(d, number(light.radius)), hn::Gt(distance2, zero));
        hn::Store(hn::DemoteTo(Half(), hn::IfThenElseZero(lit, strength)), Half(), strengths.of.data() + i);
    }
}

bool from_point(const PointLight& light, const Lanes3& positions, const MaskLanes& active, LightLanes& incident) {
    Lanes strengths;
    compute_strengths(light, positions, strengths);
    bool any_lit = false;
    for (std::size_t i = 0; i < kLanes; i += lanes_at_once()) {
        const Floats3 way = load(positions, i) - broadcast(glm::vec3(light.location));
        const Floats distance2 = dot(way, way);
        const Floats distance = hn::Sqrt(distance2);
        const Floats3 irradiance = broadcast(light.colour) * load(strengths, i);
        const Mask reached = hn::And(load_mask(active, i), is_reached(light, way, distance2, distance));
        const Mask lit = hn::And(reached, hn::Gt(max_component(irradiance), number(0.0F)));
        store_mask(lit, incident.lit, i);
        store(negated(way) / distance, incident.direction, i);
        store(distance, incident.distance, i);
        store(irradiance, incident.radiance, i);
        any_lit = any_lit || any(lit);
    }
    incident.delta = true;
    return any_lit;
}

void from_direction(const glm::vec3& direction, const glm::vec3& irradiance, const MaskLanes& active,
                    LightLanes& incident) {
    for (std::size_t i = 0; i < kLanes; i += lanes_at_once()) {
        store_mask(load_mask(active, i), incident.lit, i);
        store(broadcast(direction), incident.direction, i);
        store(hn::Inf(FloatTag()), incident.distance, i);
        store(broadcast(irradiance), incident.radiance, i);
    }
    incident.delta = true;
}

bool from_area(const AreaLight& light, const Lanes3& positions, const MaskLanes& active, LightLanes& incident) {
    const Floats zero = number(0.0F), area = number(light.area);
    const Floats3 centre = broadcast(light.centre), normal = broadcast(light.normal);
    bool any_lit = false;
    for (std::size_t i = 0; i < kLanes; i += lanes_at_once()) {
        const Floats3 way = load(positions, i) - centre;
        const Floats distance2 = dot(way, way);
        // LightSet::estimate()
        const Mask before = hn::Gt(dot(way, normal), zero);
        const Mask reached = hn::And(before, hn::Gt(number(light.power) / greater(distance2, area), zero));
        // LightSet::sample_area()
        const Floats distance = hn::Sqrt(distance2);
        const Floats3 direction = negated(way) / distance;
        const Floats cos_light = hn::Neg(dot(direction, normal));
        const Mask visible = hn::AndNot(hn::Le(cos_light, number(1e-6F)), hn::Gt(distance2, zero));
        const Mask lit = hn::And(load_mask(active, i), hn::And(reached, visible));
        store_mask(lit, incident.lit, i);
        store(direction, incident.direction, i);
        store(distance, incident.distance, i);
        store(broadcast(light.radiance), incident.radiance, i);
        store(distance2 / (cos_light * area), incident.pdf, i);
        any_lit = any_lit || any(lit);
    }
    incident.delta = false;
    return any_lit;
}

}  // namespace rs::capture::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rs::capture {

HWY_EXPORT(from_direction);
HWY_EXPORT(cull);
HWY_EXPORT(from_point);
HWY_EXPORT(from_area);

void light_from_direction(const glm::vec3& direction, const glm::vec3& irradiance, const MaskLanes& active,
                          LightLanes& incident) {
    HWY_DYNAMIC_DISPATCH(from_direction)(direction, irradiance, active, incident);
}

bool cull_point_light(const PointLight& light, const SurfaceLanes& surfaces, const MaskLanes& active,
                      MaskLanes& reached) {
    return HWY_DYNAMIC_DISPATCH(cull)(light, surfaces, active, reached);
}

bool light_from_point(const PointLight& light, const Lanes3& positions, const MaskLanes& active, LightLanes& incident) {
    return HWY_DYNAMIC_DISPATCH(from_point)(light, positions, active, incident);
}

bool light_from_area(const AreaLight& light, const Lanes3& positions, const MaskLanes& active, LightLanes& incident) {
    return HWY_DYNAMIC_DISPATCH(from_area)(light, positions, active, incident);
}

}  // namespace rs::capture
#endif  // HWY_ONCE
