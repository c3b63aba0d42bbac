#include "compositor/scene/light/light_entry.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rs::compositor {
namespace {

constexpr double kLuxOfWhite = kPi * kLumensPerWatt;  // on white matter that shows radiance 1

// One rounding, so that entry_of() finds the numbers that give back the same ones.
glm::vec3 rounded(double factor, const glm::dvec3& colour) {
    return glm::vec3(factor * colour);
}

// Full angles in degrees of which radians(_) / 2 is exactly the half angle, where there is one.
double full_degrees(double half_rad) {
    const double nearest = degrees(2 * half_rad);
    double down = nearest;
    double up = nearest;
    for (int i = 0; i < 4; ++i) {
        if (radians(down) / 2 == half_rad) return down;
        if (radians(up) / 2 == half_rad) return up;
        down = std::nextafter(down, 0.0);
        up = std::nextafter(up, 360.0);
    }
    return nearest;
}

double half_angle(double full_deg) {
    return radians(full_deg) / 2;
}

void set_colour(LightEntry& entry, const glm::vec3& colour, double unit) {
    const glm::dvec3 exact(colour);
    const double most = std::max({exact.x, exact.y, exact.z});
    entry.power = most * unit;
    entry.colour = most > 0 ? exact / most : glm::dvec3(1);
}

// The turn that brings `across` of axes_of(aim, 0) here.
double turn_of(const glm::dvec3& aim, const glm::dvec3& across) {
    const AimedAxes at_rest = axes_of(aim, 0);
    return degrees(std::atan2(glm::dot(across, at_rest.along), glm::dot(across, at_rest.across)));
}

}  // namespace

glm::dvec3 unit_of(const glm::dvec3& v) {
    return std::abs(glm::dot(v, v) - 1) < 1e-15 ? v : glm::normalize(v);
}

AimedAxes axes_of(const glm::dvec3& aim, double turn_rad) {
    const glm::dvec3 towards = std::abs(aim.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 across = glm::normalize(towards - glm::dot(towards, aim) * aim);
    const glm::dvec3 quarter = glm::cross(-aim, across);  // counter-clockwise, seen from behind the light
    return {std::cos(turn_rad) * across + std::sin(turn_rad) * quarter,
            std::cos(turn_rad) * quarter - std::sin(turn_rad) * across};
}

const char* name_of(LightKind kind) {
    switch (kind) {
        case LightKind::kDirectional:
            return "directional";
        case LightKind::kPoint:
            return "point";
        case LightKind::kSpot:
            return "spot";
        case LightKind::kRectangle:
            return "rectangle";
        case LightKind::kDisc:
            return "disc";
        case LightKind::kLuminaire:
            break;
    }
    return "luminaire";
}

const char* unit_of(const LightEntry& entry) {
    switch (entry.kind) {
        case LightKind::kDirectional:
            return "lux";
        case LightKind::kPoint:
        case LightKind::kSpot:
            return entry.radiance ? "intensity" : "candela";
        case LightKind::kRectangle:
        case LightKind::kDisc:
            return entry.radiance ? "radiance" : "lumens";
        case LightKind::kLuminaire:
            break;
    }
    return "dimmer";
}

Light light_of(const LightEntry& entry) {
    Light light;
    light.kind = entry.kind;
    light.name = entry.name;
    light.ambient = glm::vec3(entry.ambient);
    light.everywhere = !entry.scope;
    light.location = entry.location;
    const glm::dvec3 aim = unit_of(entry.aim);
    const AimedAxes axes = axes_of(aim, radians(entry.turn_deg));
    switch (entry.kind) {
        case LightKind::kDirectional:
            light.colour = rounded(entry.power / kLuxOfWhite, entry.colour);
            light.towards = aim;
            break;
        case LightKind::kPoint:
        case LightKind::kSpot:
            light.colour = entry.radiance ? rounded(1, *entry.radiance * entry.colour)
                                          : rounded(entry.power / kLuxOfWhite, entry.colour);
            light.attenuation = entry.radiance ? glm::vec3(entry.attenuation) : glm::vec3(0, 0, 1);
            light.least_attenuation = entry.radiance ? 1 : 0;
            light.radius = entry.reach;
            if (entry.kind == LightKind::kPoint) break;
            light.towards = aim;
            light.cut_off_rad = half_angle(entry.cut_off_deg);
            light.beam_width_rad = half_angle(entry.beam_deg);
            break;
        case LightKind::kRectangle:
        case LightKind::kDisc:
            light.half_u = 0.5 * entry.size.y * axes.along;
            light.half_v = 0.5 * entry.size.x * axes.across;
            light.colour = entry.radiance ? rounded(1, *entry.radiance * entry.colour)
                                          : rounded(entry.power / (kLuxOfWhite * area_of(light)), entry.colour);
            break;
        case LightKind::kLuminaire:
            light.colour = rounded(entry.power, entry.colour);
            light.luminaire = entry.luminaire;
            // Its X, -Z and aim: planes C0 and C90, and the nadir.
            light.world_from_luminaire = glm::dmat3(axes.across, -aim, -axes.along);
            break;
    }
    return light;
}

LightEntry entry_of(const Light& light) {
    LightEntry entry;
    entry.kind = light.kind;
    entry.name = light.name;
    entry.ambient = glm::dvec3(light.ambient);
    entry.location = light.kind == LightKind::kDirectional ? glm::dvec3(0) : light.location;
    switch (light.kind) {
        case LightKind::kDirectional:
            set_colour(entry, light.colour, kLuxOfWhite);
            entry.aim = light.towards;
            break;
        case LightKind::kPoint:
        case LightKind::kSpot:
            if (is_inverse_square(light)) {
                set_colour(entry, light.colour, kLuxOfWhite);
            } else {
                entry.radiance = glm::dvec3(light.colour);
                entry.attenuation = glm::dvec3(light.attenuation);
            }
            if (light.radius <= kMostDistant) entry.reach = std::max(light.radius, kShortest);
            if (light.kind == LightKind::kPoint) break;
            entry.aim = light.towards;
            entry.cut_off_deg = std::max(full_degrees(light.cut_off_rad), kLeastCutOff_deg);
            entry.beam_deg = std::min(full_degrees(light.beam_width_rad), entry.cut_off_deg);
            break;
        case LightKind::kRectangle:
        case LightKind::kDisc: {
            set_colour(entry, light.colour, kLuxOfWhite * area_of(light));
            entry.aim = glm::normalize(glm::cross(light.half_u, light.half_v));
            entry.size = {2 * glm::length(light.half_v), 2 * glm::length(light.half_u)};
            if (light.kind == LightKind::kDisc) entry.size = glm::dvec2(entry.size.x);
            entry.turn_deg = turn_of(entry.aim, glm::normalize(light.half_v));
            break;
        }
        case LightKind::kLuminaire:
            set_colour(entry, light.colour, 1);
            entry.luminaire = light.luminaire;
            entry.aim = light.world_from_luminaire * glm::dvec3(0, -1, 0);
            entry.turn_deg = turn_of(entry.aim, light.world_from_luminaire[0]);
            break;
    }
    return entry;
}

}  // namespace rs::compositor
