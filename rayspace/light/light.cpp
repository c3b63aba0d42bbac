#include "rayspace/light/light.hpp"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace rs {
namespace {

constexpr float kPiF = static_cast<float>(kPi);

bool is_area(const Light& light) {
    return light.kind == LightKind::kRectangle || light.kind == LightKind::kDisc;
}

template <class Vector>
bool finite(const Vector& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

Light directional_light(const glm::dvec3& towards, const glm::vec3& irradiance) {
    Light light;
    light.towards = glm::normalize(towards);
    light.colour = irradiance / kPiF;
    return light;
}

Light point_light(const glm::dvec3& location, const glm::vec3& intensity) {
    Light light;
    light.kind = LightKind::kPoint;
    light.location = location;
    light.colour = intensity / kPiF;
    light.attenuation = {0, 0, 1};
    light.least_attenuation = 0;
    light.radius = std::numeric_limits<double>::infinity();
    return light;
}

Light rectangle_light(const glm::dvec3& corner, const glm::dvec3& side_u, const glm::dvec3& side_v,
                      const glm::vec3& radiance) {
    Light light;
    light.kind = LightKind::kRectangle;
    light.location = corner + 0.5 * (side_u + side_v);
    light.half_u = 0.5 * side_u;
    light.half_v = 0.5 * side_v;
    light.colour = radiance;
    return light;
}

double area_of(const Light& light) {
    if (!is_area(light)) return 0;
    return glm::length(glm::cross(light.half_u, light.half_v)) * (light.kind == LightKind::kDisc ? kPi : 4.0);
}

bool is_inverse_square(const Light& light) {
    return (light.kind == LightKind::kPoint || light.kind == LightKind::kSpot) &&
           light.attenuation == glm::vec3(0, 0, 1) && light.least_attenuation == 0;
}

glm::vec3 irradiance_at(const Light& light, const glm::dvec3& position) {
    if (light.kind == LightKind::kDirectional) return kPiF * light.colour;
    const glm::dvec3 way = position - light.location;
    const double distance2 = glm::dot(way, way);
    if (!(distance2 > 0) || is_area(light)) return glm::vec3(0);
    if (light.kind == LightKind::kLuminaire) {
        const double candela = light.luminaire->web.candela(glm::transpose(light.world_from_luminaire) * way);
        return light.colour * static_cast<float>(candela / (kLumensPerWatt * distance2));
    }
    const double d = std::sqrt(distance2);
    if (d > light.radius) return glm::vec3(0);
    const double attenuation = glm::dot(glm::dvec3(light.attenuation), glm::dvec3(1, d, distance2));
    double strength = 1 / std::max(attenuation, static_cast<double>(light.least_attenuation));
    if (light.kind == LightKind::kSpot) {
        const double angle = std::acos(std::clamp(glm::dot(way, light.towards) / d, -1.0, 1.0));
        if (angle > light.cut_off_rad) return glm::vec3(0);
        if (angle > light.beam_width_rad) {
            strength *= (light.cut_off_rad - angle) / (light.cut_off_rad - light.beam_width_rad);
        }
    }
    return kPiF * light.colour * static_cast<float>(strength);
}

Light punctual_of(const Light& light) {
    if (!is_area(light) && light.kind != LightKind::kLuminaire) return light;
    Light spot = point_light(light.location, light.colour);
    spot.kind = LightKind::kSpot;
    spot.everywhere = light.everywhere;
    spot.name = light.name;
    if (is_area(light)) {
        spot.towards = glm::normalize(glm::cross(light.half_u, light.half_v));
        // A cosine, by a straight line from the axis to the plane of the area.
        spot.beam_width_rad = 0;
        spot.cut_off_rad = kPi / 2;
        spot.colour = light.colour * static_cast<float>(area_of(light) / kPi);
        spot.least_attenuation = static_cast<float>(area_of(light) / kPi);
        return spot;
    }
    const PhotometricWeb& web = light.luminaire->web;
    spot.towards = light.world_from_luminaire * glm::dvec3(0, -1, 0);
    const BeamSpread across = beam_spread(web, 0);
    const BeamSpread along = beam_spread(web, 90);
    // Half the intensity is left half-way from the axis to the cut-off.
    const double half_beam = std::clamp(0.25 * (across.beam_rad + along.beam_rad), 0.01, kPi / 4);
    spot.beam_width_rad = 0;
    spot.cut_off_rad = 2 * half_beam;
    spot.colour = light.colour * static_cast<float>(web.peak_candela() / (kLumensPerWatt * kPi));
    return spot;
}

Light turned_about_y(const Light& light, double angle_rad) {
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), angle_rad, glm::dvec3(0, 1, 0)));
    Light turned = light;
    turned.towards = turn * light.towards;
    turned.location = turn * light.location;
    turned.half_u = turn * light.half_u;
    turned.half_v = turn * light.half_v;
    turned.world_from_luminaire = turn * light.world_from_luminaire;
    return turned;
}

Status check_light(const Light& light) {
    if (!finite(light.colour) || std::min({light.colour.x, light.colour.y, light.colour.z}) < 0) {
        return Error{"its colour must be finite and not negative"};
    }
    const bool directed = light.kind == LightKind::kDirectional || light.kind == LightKind::kSpot;
    if (directed && !(finite(light.towards) && std::abs(glm::length(light.towards) - 1) < 1e-6)) {
        return Error{"its direction must not be zero"};
    }
    if (light.kind != LightKind::kDirectional && !finite(light.location)) return Error{"its place must be finite"};
    if (is_area(light) && !(area_of(light) > 0 && std::isfinite(area_of(light)))) {
        return Error{"its edges must be finite and span an area"};
    }
    if (light.kind == LightKind::kLuminaire && light.luminaire == nullptr) return Error{"it has no photometric file"};
    return {};
}

}  // namespace rs
