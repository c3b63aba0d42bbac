#include "capture/tracer/light/light_set.hpp"

#include "capture/tracer/scene/scene_transform.hpp"
#include "capture/tracer/scene/texture_lookup.hpp"
#include "rayspace/light/directions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rs::capture {

namespace {

// Uses the texture's mean, so that mostly dark materials get few samples. A zero mean implies zero look-ups.
float mean_emission(const Material& material, const std::vector<Texture>& textures) {
    if (material.emission_texture < 0) return luminance(material.emission);
    return luminance(material.emission * mean_colour(textures[static_cast<std::size_t>(material.emission_texture)]));
}

}  // namespace

LightSet::LightSet(const Scene& scene, Environment environment, const Extent& extent)
    : scene_(scene),
      environment_turn_rad_(environment.turn_rad),
      environment_(std::move(environment)),
      extent_{extent.centre, std::max(extent.radius, 1e-6F)} {
    for (const Material& material : scene_.materials) {
        brightness_.push_back(mean_emission(material, scene_.textures));
    }
    gather_emitters();
    set_lights();
}

void LightSet::update_instances(const Extent& extent) {
    extent_ = {extent.centre, std::max(extent.radius, 1e-6F)};
    if (has_emissive_instances_) gather_emitters();
    if (emitter_source_.has_value() != (emitter_power_ > 0)) {
        const float turned = turn_rad_;
        set_lights();
        turn(turned);
        return;
    }
    if (emitter_source_) sources_[*emitter_source_].power = emitters_irradiance();
    find_scope_extents();
    sum_flux();
}

void LightSet::find_scope_extents() {
    scope_extents_.clear();
    for (const Source& source : sources_) {
        const std::uint32_t light = source.casters.scoped_light;
        if (light == kUnscoped || source.kind != SourceKind::distant) continue;
        const ScopeBounds bounds = bounds_of_scope(scene_, light);
        scope_extents_[light] = bounds.empty()
                                    ? extent_
                                    : Extent{0.5F * (bounds.lower + bounds.upper),
                                             std::max(0.5F * glm::distance(bounds.lower, bounds.upper), 1e-6F)};
    }
}

const LightSet::Extent& LightSet::extent_of(const Source& source) const {
    const auto scoped = scope_extents_.find(source.casters.scoped_light);
    return scoped != scope_extents_.end() ? scoped->second : extent_;
}

float LightSet::emitters_irradiance() const {
    return static_cast<float>(emitter_power_) / (extent_.radius * extent_.radius);
}

void LightSet::set_lights() {
    sources_.clear();
    areas_.clear();
    initial_lights_.clear();
    points_.clear();
    environment_source_.reset();
    emitter_source_.reset();
    if (!environment_.is_black()) {
        environment_source_ = sources_.size();
        sources_.push_back({SourceKind::environment, 0, kPiF * environment_.mean_luminance()});
    }
    if (emitter_power_ > 0) {
        emitter_source_ = sources_.size();
        sources_.push_back({SourceKind::emitters, 0, emitters_irradiance()});
    }
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) add_light(i);
    lights_ = initial_lights_;
    turn_rad_ = 0.0F;
    place_lights(0.0F);
    find_scope_extents();
    sum_flux();
}

void LightSet::set_environment(Environment environment) {
    environment_turn_rad_ = environment.turn_rad;
    environment_ = EnvironmentMap(std::move(environment));
}

void LightSet::set_environment(float scale, float turn_rad) {
    environment_turn_rad_ = turn_rad;
    environment_.set_scale(scale);
    environment_.set_turn(turn_rad);
}

void LightSet::add_light(std::size_t index_in_scene) {
    const Light& light = scene_.lights[index_in_scene];
    const ShadowCasters casters{
        .any = light.casts_shadows,
        .scoped_light = light.everywhere ? kUnscoped : static_cast<std::uint32_t>(index_in_scene)};
    const LightModel& model = model_of(light);
    const float power = luminance(light.colour) * static_cast<float>(model.strength(light));
    if (!(power > 0.0F)) return;
    const std::size_t index = initial_lights_.size();
    initial_lights_.push_back(light);
    const LightReach reach = model.reach(light);
    points_.push_back({.radius = reach.radius,
                       .attenuation = reach.attenuation,
                       .least_attenuation = reach.least_attenuation,
                       .colour = kPiF * light.colour,
                       .power = power,
                       .min_cos = reach.min_cos});
    switch (model.form) {
        case LightForm::kDistant:
            sources_.push_back({SourceKind::distant, index, power, casters});
            break;
        case LightForm::kPoint:
            sources_.push_back({SourceKind::local, index, power, casters});
            break;
        case LightForm::kArea:
            areas_.push_back({.light = index, .source = sources_.size(), .model = &model});
            sources_.push_back({SourceKind::area, areas_.size() - 1, power, casters});
            break;
    }
}

void LightSet::turn(float angle_rad) {
    turn_rad_ = angle_rad;
    environment_.set_turn(environment_turn_rad_ + angle_rad);
    place_lights(angle_rad);
}

void LightSet::place_lights(float turn_rad) {
    for (std::size_t i = 0; i < initial_lights_.size(); ++i) {
        lights_[i] = rotate_about_y(initial_lights_[i], static_cast<double>(turn_rad));
        points_[i].location = lights_[i].location;
        points_[i].towards = glm::vec3(model_of(lights_[i]).axis(lights_[i]));
    }
    for (Area& area : areas_) {
        const Light& light = lights_[area.light];
        area.centre = light.location;
        area.half_u = light.half_u;
        area.half_v = light.half_v;
        const glm::vec3 cross = glm::cross(area.half_u, area.half_v);
        area.parallelogram = glm::length(cross);
        area.normal = cross / area.parallelogram;
        area.radiance = light.colour;
        area.area = static_cast<float>(area.model->strength(light));
    }
}

float LightSet::estimate(const Source& source, const LitPoint& at) const {
    if (!illuminates(source, at.light_group)) return 0.0F;
    const glm::vec3& position = at.position;
    if (source.kind == SourceKind::area) {
        const Area& area = areas_[source.index];
        const glm::vec3 way = position - area.centre;
        // Area lights are one-sided.
        if (!(glm::dot(way, area.normal) > 0.0F)) return 0.0F;
        return source.power / std::max(glm::dot(way, way), area.area);
    }
    if (source.kind != SourceKind::local) return source.power;
    const PointLight& light = points_[source.index];
    const glm::vec3 way = position - glm::vec3(light.location);
    const float distance2 = glm::dot(way, way);
    const float d = std::sqrt(distance2);
    if (!(d > 0.0F) || d > static_cast<float>(light.radius)) return 0.0F;
    if (glm::dot(way, light.towards) < light.min_cos * d) return 0.0F;
    return light.power / std::max(glm::dot(light.attenuation, glm::vec3(1.0F, d, distance2)), light.least_attenuation);
}

LightSet::Selection LightSet::select(const LitPoint& at) const {
    Selection selection{at};
    int reaching = 0;
    for (const Source& source : sources_) {
        const float estimated = estimate(source, at);
        selection.total += estimated;
        reaching += estimated > 0.0F;
    }
    if (reaching > 0) selection.uniform = 1.0F / static_cast<float>(reaching);
    return selection;
}

LightSet::Selection LightSet::select_all(const LitPoint& at) {
    return {at, std::numeric_limits<float>::infinity(), 2.0F};
}

std::optional<LightSample> LightSet::sample_sky(const glm::vec2& u) const {
    if (!environment_source_) return std::nullopt;
    return sample_environment(1.0F, u);
}

void LightSet::gather_emitters() {
    placed_.clear();
    emitters_.clear();
    proxies_.clear();
    emitter_power_ = 0;
    for (const Mesh& mesh : scene_.meshes) gather_emitter(mesh);
    for (const Instance& instance : scene_.instances) {
        for (const Mesh& mesh : scene_.parts[instance.part].meshes) {
            if (!(brightness_[static_cast<std::size_t>(mesh.material)] > 0.0F)) continue;
            has_emissive_instances_ = true;
            if (instance.at_close) continue;
            placed_.push_back(std::make_unique<const Mesh>(transform_mesh(mesh, instance.world_from_part)));
            gather_emitter(*placed_.back());
        }
    }
    for (Emitter& emitter : emitters_) emitter.cumulative /= static_cast<float>(emitter_power_);
}

void LightSet::gather_emitter(const Mesh& mesh) {
    const float brightness = brightness_[static_cast<std::size_t>(mesh.material)];
    if (!(brightness > 0.0F)) return;
    add_proxy(mesh);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3& t = mesh.triangles[i];
        const glm::vec3 corner = mesh.positions[t.x];
        const float area = 0.5F * glm::length(glm::cross(mesh.positions[t.y] - corner, mesh.positions[t.z] - corner));
        if (!(area > 0.0F)) continue;
        emitter_power_ += static_cast<double>(area * brightness);
        emitters_.push_back({&mesh, i, static_cast<float>(emitter_power_)});
    }
}

std::optional<LightSample> LightSet::sample(const Selection& selection, float u_source, const glm::vec2& u) const {
    if (!(selection.uniform > 0.0F)) return std::nullopt;
    const Source* chosen = nullptr;
    float probability = 0.0F;
    for (const Source& source : sources_) {
        const float source_probability = selection_probability(selection, estimate(source, selection.at));
        if (!(source_probability > 0.0F)) continue;
        // The last source that reaches the position takes the rounding remainder.
        if (chosen != nullptr) u_source -= probability;
        chosen = &source;
        probability = source_probability;
        if (u_source < source_probability) break;
    }
    switch (chosen->kind) {
        case SourceKind::environment:
            return sample_environment(probability, u);
        case SourceKind::distant:
        case SourceKind::local:
            return sample_light(*chosen, selection.at.position, probability);
        case SourceKind::area:
            return sample_area(*chosen, selection.at.position, probability, areas_[chosen->index].model->point(u));
        case SourceKind::emitters:
            return sample_emitter(selection, std::min(u_source / probability, 0x1.fffffep-1F), u);
    }
    return std::nullopt;
}

std::optional<LightSample> LightSet::sample_light(const Source& source, const glm::vec3& position,
                                                  float probability) const {
    const Light& light = lights_[source.index];
    const glm::vec3 irradiance = irradiance_at(light, position);
    if (!(max_component(irradiance) > 0.0F)) return std::nullopt;
    if (model_of(light).form == LightForm::kDistant) {
        return LightSample{-glm::vec3(light.towards),
                           std::numeric_limits<float>::infinity(),
                           irradiance,
                           probability,
                           true,
                           source.casters};
    }
    const glm::vec3 to_light = glm::vec3(light.location) - position;
    const float distance = glm::length(to_light);
    return LightSample{to_light / distance, distance, irradiance, probability, true, source.casters};
}

std::optional<LightSample> LightSet::sample_environment(float probability, const glm::vec2& u) const {
    const EnvironmentMap::Sample drawn = environment_.sample(u);
    if (!(drawn.pdf > 0.0F)) return std::nullopt;
    return LightSample{drawn.direction, std::numeric_limits<float>::infinity(), environment_.radiance(drawn.direction),
                       probability * drawn.pdf, false};
}

std::optional<LightSample> LightSet::sample_area(const Source& source, const glm::vec3& position, float probability,
                                                 const glm::vec2& at) const {
    const Area& area = areas_[source.index];
    const glm::vec3 to_light = area.centre + area.half_u * at.x + area.half_v * at.y - position;
    const float distance2 = glm::dot(to_light, to_light);
    if (!(distance2 > 0.0F)) return std::nullopt;
    const float distance = std::sqrt(distance2);
    const glm::vec3 direction = to_light / distance;
    const float cos_light = -glm::dot(direction, area.normal);
    if (cos_light <= 1e-6F) return std::nullopt;
    return LightSample{direction, distance,      area.radiance, probability * distance2 / (cos_light * area.area),
                       false,     source.casters};
}

std::optional<LightSample> LightSet::sample_emitter(const Selection& selection, float u_emitter,
                                                    const glm::vec2& u) const {
    const auto found = std::ranges::upper_bound(emitters_, u_emitter, {}, &Emitter::cumulative);
    const Emitter& emitter = found == emitters_.end() ? emitters_.back() : *found;
    const EmitterPoint point = emitter_point(emitter, u);
    if (point.hole) return std::nullopt;
    const int material = emitter.mesh->material;
    const glm::vec3 to_light = point.position - selection.at.position;
    const float distance2 = glm::dot(to_light, to_light);
    if (!(distance2 > 0.0F)) return std::nullopt;
    const float distance = std::sqrt(distance2);
    const glm::vec3 direction = to_light / distance;
    float cos_light = -glm::dot(direction, point.normal);
    if (scene_.materials[static_cast<std::size_t>(material)].two_sided) cos_light = std::abs(cos_light);
    if (cos_light <= 1e-6F) return std::nullopt;
    return LightSample{direction, distance, emission(material, point.uv),
                       emitter_pdf(selection, material, distance, cos_light), false};
}

LightSet::EmitterPoint LightSet::emitter_point(const Emitter& emitter, const glm::vec2& u) const {
    const Mesh& mesh = *emitter.mesh;
    const Material& material = scene_.materials[static_cast<std::size_t>(mesh.material)];
    const glm::uvec3& t = mesh.triangles[emitter.triangle];
    const glm::vec3 corner = mesh.positions[t.x];
    const glm::vec3 edge_u = mesh.positions[t.y] - corner;
    const glm::vec3 edge_v = mesh.positions[t.z] - corner;
    const float root = std::sqrt(u.x);  // uniform over the triangle
    const float along_u = root * (1.0F - u.y);
    const float along_v = root * u.y;
    const glm::vec2 uv = interpolate_uv(mesh, emitter.triangle, along_u, along_v);
    const bool hole =
        material.texture >= 0 && !mesh.uvs.empty() &&
        sample_texture_alpha(scene_.textures[static_cast<std::size_t>(material.texture)], uv) < kHoleAlpha;
    return {corner + edge_u * along_u + edge_v * along_v, glm::normalize(glm::cross(edge_u, edge_v)), uv, hole};
}

glm::vec3 LightSet::emission(int material, const glm::vec2& uv) const {
    const Material& of = scene_.materials[static_cast<std::size_t>(material)];
    if (of.emission_texture < 0) return of.emission;
    const RgbaF texel = sample_texture(scene_.textures[static_cast<std::size_t>(of.emission_texture)], uv);
    return of.emission * glm::vec3(texel.r, texel.g, texel.b);
}

float LightSet::environment_pdf(const Selection& selection, const glm::vec3& direction) const {
    if (!environment_source_) return 0.0F;
    return selection_probability(selection, sources_[*environment_source_].power) * environment_.pdf(direction);
}

float LightSet::emitter_pdf(const Selection& selection, int material, float distance, float cos_light) const {
    // Emitters are selected in proportion to area * brightness, so the density per area is brightness over the sum.
    const float per_area = brightness_[static_cast<std::size_t>(material)] / static_cast<float>(emitter_power_);
    return selection_probability(selection, sources_[*emitter_source_].power) * per_area * distance * distance /
           cos_light;
}

std::optional<LightSet::Crossing> LightSet::cross_area(std::size_t index, const Selection& selection,
                                                       const glm::vec3& origin, const glm::vec3& direction,
                                                       float max_distance) const {
    const Area& area = areas_[index];
    const float cos_light = -glm::dot(direction, area.normal);
    if (cos_light <= 1e-6F) return std::nullopt;
    const glm::vec3 from_centre = origin - area.centre;
    const float distance = glm::dot(from_centre, area.normal) / cos_light;
    if (!(distance > 0.0F && distance < max_distance)) return std::nullopt;
    const glm::vec3 p = from_centre + direction * distance;
    // Coordinates along half_u and half_v, which need not be perpendicular.
    const float s = glm::dot(glm::cross(p, area.half_v), area.normal) / area.parallelogram;
    const float t = glm::dot(glm::cross(area.half_u, p), area.normal) / area.parallelogram;
    if (!area.model->covers({s, t})) return std::nullopt;
    const float probability = selection_probability(selection, estimate(sources_[area.source], selection.at));
    return Crossing{area.radiance, probability * distance * distance / (cos_light * area.area)};
}

}  // namespace rs::capture
