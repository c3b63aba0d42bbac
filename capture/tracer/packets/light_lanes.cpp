// What of a light arrives at sixteen places.
#include "capture/tracer/packets/light_lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "capture/tracer/packets/light_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "capture/tracer/packets/float_lanes.inl"

HWY_BEFORE_NAMESPACE();
namespace rs::capture::HWY_NAMESPACE {

// The twin of LightSet::estimate(), of its sources that are points. `way` goes from the light to the place.
HWY_INLINE Mask reached_by(const PointLight& light, const Floats3& way, Floats distance2, Floats distance) {
    const Floats zero = number(0.0F), one = number(1.0F);
    Mask none = hn::Not(hn::Gt(distance, zero));
    none = hn::Or(none, hn::Gt(distance, number(static_cast<float>(light.radius))));
    none = hn::Or(none, hn::Lt(dot(way, broadcast(light.towards)), number(light.least_cos) * distance));
    const Floats falloff =
        greater(dot(broadcast(light.attenuation), {one, distance, distance2}), number(light.least_attenuation));
    return hn::AndNot(none, hn::Gt(number(light.power) / falloff, zero));
}

bool reach(const PointLight& light, const SurfaceLanes& surfaces, const MaskLanes& wanted, MaskLanes& reached) {
    const Floats zero = number(0.0F);
    bool some = false;
    for (std::size_t i = 0; i < kLanes; i += lanes_at_once()) {
        const Floats3 way = load(surfaces.near_start, i) - broadcast(glm::vec3(light.location));
        const Floats distance2 = dot(way, way);
        const Floats distance = hn::Sqrt(distance2);
        const Floats cosine = dot(negated(way) / distance, load(surfaces.normal, i));
        const Mask open = hn::Or(hn::Gt(cosine, zero), hn::Gt(load(surfaces.material.translucency, i), zero));
        const Mask there = hn::And(hn::And(load_mask(wanted, i), open), reached_by(light, way, distance2, distance));
        store_mask(there, reached, i);
        some = some || any(there);
    }
    return some;
}

// The strength of irradiance_at(), which counts in doubles; 0 where there is none.
HWY_INLINE void find_strengths(const PointLight& light, const Lanes3& places, Lanes& strengths) {
    using Tag = hn::CappedTag<double, kLanes / 2>;
    using Half = hn::Rebind<float, Tag>;
    const auto number = [](double value) { return hn::Set(Tag(), value); };
    const auto zero = number(0.0);
    for (std::size_t i = 0; i < kLanes; i += hn::Lanes(Tag())) {
        const auto wide = [&](const Lanes& lanes) {
            return hn::PromoteTo(Tag(), hn::Load(Half(), lanes.of.data() + i));
        };
        const auto x = wide(places.x) - number(light.location.x);
        const auto y = wide(places.y) - number(light.location.y);
        const auto z = wide(places.z) - number(light.location.z);
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

bool from_point(const PointLight& light, const Lanes3& places, const MaskLanes& wanted, LightLanes& arrives) {
    Lanes strengths;
    find_strengths(light, places, strengths);
    bool some = false;
    for (std::size_t i = 0; i < kLanes; i += lanes_at_once()) {
        const Floats3 way = load(places, i) - broadcast(glm::vec3(light.location));
        const Floats distance2 = dot(way, way);
        const Floats distance = hn::Sqrt(distance2);
        const Floats3 irradiance = broadcast(light.colour) * load(strengths, i);
        const Mask reached = hn::And(load_mask(wanted, i), reached_by(light, way, distance2, distance));
        const Mask lit = hn::And(reached, hn::Gt(max_component(irradiance), number(0.0F)));
        store_mask(lit, arrives.lit, i);
        store(negated(way) / distance, arrives.direction, i);
        store(distance, arrives.distance, i);
        store(irradiance, arrives.radiance, i);
        some = some || any(lit);
    }
    arrives.delta = true;
    return some;
}

void from_afar(const glm::vec3& direction, const glm::vec3& irradiance, const MaskLanes& wanted, LightLanes& arrives) {
    for (std::size_t i = 0; i < kLanes; i += lanes_at_once()) {
        store_mask(load_mask(wanted, i), arrives.lit, i);
        store(broadcast(direction), arrives.direction, i);
        store(hn::Inf(FloatTag()), arrives.distance, i);
        store(broadcast(irradiance), arrives.radiance, i);
    }
    arrives.delta = true;
}

bool from_area(const AreaLight& light, const Lanes3& places, const MaskLanes& wanted, LightLanes& arrives) {
    const Floats zero = number(0.0F), area = number(light.area);
    const Floats3 middle = broadcast(light.middle), normal = broadcast(light.normal);
    bool some = false;
    for (std::size_t i = 0; i < kLanes; i += lanes_at_once()) {
        const Floats3 way = load(places, i) - middle;
        const Floats distance2 = dot(way, way);
        // LightSet::estimate()
        const Mask before = hn::Gt(dot(way, normal), zero);
        const Mask reached = hn::And(before, hn::Gt(number(light.power) / greater(distance2, area), zero));
        // LightSet::sample_area()
        const Floats distance = hn::Sqrt(distance2);
        const Floats3 direction = negated(way) / distance;
        const Floats cos_light = hn::Neg(dot(direction, normal));
        const Mask seen = hn::AndNot(hn::Le(cos_light, number(1e-6F)), hn::Gt(distance2, zero));
        const Mask lit = hn::And(load_mask(wanted, i), hn::And(reached, seen));
        store_mask(lit, arrives.lit, i);
        store(direction, arrives.direction, i);
        store(distance, arrives.distance, i);
        store(broadcast(light.radiance), arrives.radiance, i);
        store(distance2 / (cos_light * area), arrives.pdf, i);
        some = some || any(lit);
    }
    arrives.delta = false;
    return some;
}

}  // namespace rs::capture::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rs::capture {

HWY_EXPORT(from_afar);
HWY_EXPORT(reach);
HWY_EXPORT(from_point);
HWY_EXPORT(from_area);

void light_from_afar(const glm::vec3& direction, const glm::vec3& irradiance, const MaskLanes& wanted,
                     LightLanes& arrives) {
    HWY_DYNAMIC_DISPATCH(from_afar)(direction, irradiance, wanted, arrives);
}

bool reach_of_point(const PointLight& light, const SurfaceLanes& surfaces, const MaskLanes& wanted,
                    MaskLanes& reached) {
    return HWY_DYNAMIC_DISPATCH(reach)(light, surfaces, wanted, reached);
}

bool light_from_point(const PointLight& light, const Lanes3& places, const MaskLanes& wanted, LightLanes& arrives) {
    return HWY_DYNAMIC_DISPATCH(from_point)(light, places, wanted, arrives);
}

bool light_from_area(const AreaLight& light, const Lanes3& places, const MaskLanes& wanted, LightLanes& arrives) {
    return HWY_DYNAMIC_DISPATCH(from_area)(light, places, wanted, arrives);
}

}  // namespace rs::capture
#endif  // HWY_ONCE
