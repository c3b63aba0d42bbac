#include "capture/tracer/light/light_set.hpp"

#include "capture/tracer/light/directions.hpp"
#include "capture/tracer/scene/texture_lookup.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rs::capture {

namespace {

// By the mean of the texture, so that a mostly dark one draws few samples. Bilinear look-ups are 0 where the mean is.
float brightness_of(const Material& material, const std::vector<Texture>& textures) {
    if (material.emission_texture < 0) return luminance(material.emission);
    return luminance(material.emission * mean_colour(textures[static_cast<std::size_t>(material.emission_texture)]));
}

}  // namespace

LightSet::LightSet(const Scene& scene, Environment environment, const glm::vec3& centre, float radius)
    : scene_(scene), environment_turn_rad_(environment.turn_rad), environment_(std::move(environment)) {
    const float floor_distance2 = std::max(radius * radius, 1e-12F);
    const auto distance2 = [&](const glm::vec3& p) {
        return std::max(glm::dot(p - centre, p - centre), floor_distance2);
    };
    const auto add = [&](SourceKind kind, std::size_t index, float irradiance) {
        if (irradiance > 0.0F) sources_.push_back({kind, index, irradiance});
    };

    if (!environment_.is_black()) add(SourceKind::environment, 0, kPiF * environment_.mean_luminance());
    directional_ = scene.directional_lights;
    for (DirectionalLight& light : directional_) light.direction = glm::normalize(light.direction);
    for (std::size_t i = 0; i < directional_.size(); ++i) {
        add(SourceKind::directional, i, luminance(directional_[i].irradiance));
    }
    points_ = scene.point_lights;
    for (std::size_t i = 0; i < points_.size(); ++i) {
        add(SourceKind::point, i, luminance(points_[i].intensity) / distance2(points_[i].position));
    }
    for (std::size_t i = 0; i < scene.rectangle_lights.size(); ++i) {
        const RectangleLight& light = scene.rectangle_lights[i];
        const glm::vec3 cross = glm::cross(light.edge_u, light.edge_v);
        const float area = glm::length(cross);
        if (!(area > 0.0F)) continue;
        const glm::vec3 middle = light.corner + 0.5F * (light.edge_u + light.edge_v);
        rectangles_.push_back({light, cross / area, area, i});
        add(SourceKind::rectangle, rectangles_.size() - 1, luminance(light.radiance) * area / distance2(middle));
    }
    gather_emitters();
    add(SourceKind::emitters, 0, static_cast<float>(emitter_power_) / floor_distance2);

    float total = 0.0F;
    for (const Source& source : sources_) total += source.probability;
    const float even = 1.0F / static_cast<float>(std::max<std::size_t>(sources_.size(), 1));
    for (Source& source : sources_) {
        source.probability = 0.5F * (even + source.probability / total);
        if (source.kind == SourceKind::environment) environment_probability_ = source.probability;
        if (source.kind == SourceKind::emitters) emitter_probability_ = source.probability;
        if (source.kind == SourceKind::rectangle) rectangles_[source.index].probability = source.probability;
    }
}

void LightSet::turn(float angle_rad) {
    const float c = std::cos(angle_rad);
    const float s = std::sin(angle_rad);
    const auto turned = [&](const glm::vec3& v) { return glm::vec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x); };
    environment_.set_turn(environment_turn_rad_ + angle_rad);
    for (std::size_t i = 0; i < directional_.size(); ++i) {
        directional_[i].direction = turned(glm::normalize(scene_.directional_lights[i].direction));
    }
    for (std::size_t i = 0; i < points_.size(); ++i) points_[i].position = turned(scene_.point_lights[i].position);
    for (Rectangle& rectangle : rectangles_) {
        const RectangleLight& from = scene_.rectangle_lights[rectangle.index];
        rectangle.light.corner = turned(from.corner);
        rectangle.light.edge_u = turned(from.edge_u);
        rectangle.light.edge_v = turned(from.edge_v);
        rectangle.normal = glm::normalize(glm::cross(rectangle.light.edge_u, rectangle.light.edge_v));
    }
}

void LightSet::gather_emitters() {
    for (const Material& material : scene_.materials) {
        brightness_.push_back(brightness_of(material, scene_.textures));
    }
    for (const Mesh& mesh : scene_.meshes) {
        const float brightness = brightness_[static_cast<std::size_t>(mesh.material)];
        if (!(brightness > 0.0F)) continue;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            const glm::uvec3& t = mesh.triangles[i];
            const glm::vec3 corner = mesh.positions[t.x];
            const float area =
                0.5F * glm::length(glm::cross(mesh.positions[t.y] - corner, mesh.positions[t.z] - corner));
            if (!(area > 0.0F)) continue;
            emitter_power_ += static_cast<double>(area * brightness);
            emitters_.push_back({&mesh, i, static_cast<float>(emitter_power_)});
        }
    }
    for (Emitter& emitter : emitters_) emitter.cumulative /= static_cast<float>(emitter_power_);
}

std::optional<LightSample> LightSet::sample(const glm::vec3& position, float u_source, const glm::vec2& u) const {
    if (sources_.empty()) return std::nullopt;
    const Source* source = &sources_.front();
    while (u_source >= source->probability && source != &sources_.back()) u_source -= (source++)->probability;
    switch (source->kind) {
        case SourceKind::environment:
            return sample_environment(source->probability, u);
        case SourceKind::directional: {
            const DirectionalLight& light = directional_[source->index];
            return LightSample{-light.direction, std::numeric_limits<float>::infinity(), light.irradiance,
                               source->probability, true};
        }
        case SourceKind::point: {
            const PointLight& light = points_[source->index];
            const glm::vec3 to_light = light.position - position;
            const float distance2 = glm::dot(to_light, to_light);
            if (!(distance2 > 0.0F)) return std::nullopt;
            const float distance = std::sqrt(distance2);
            return LightSample{to_light / distance, distance, light.intensity / distance2, source->probability, true};
        }
        case SourceKind::rectangle:
            return sample_rectangle(rectangles_[source->index], position, u);
        case SourceKind::emitters:
            return sample_emitter(position, std::min(u_source / source->probability, 0x1.fffffep-1F), u);
    }
    return std::nullopt;
}

std::optional<LightSample> LightSet::sample_environment(float probability, const glm::vec2& u) const {
    const EnvironmentMap::Sample drawn = environment_.sample(u);
    if (!(drawn.pdf > 0.0F)) return std::nullopt;
    return LightSample{drawn.direction, std::numeric_limits<float>::infinity(), environment_.radiance(drawn.direction),
                       probability * drawn.pdf, false};
}

std::optional<LightSample> LightSet::sample_rectangle(const Rectangle& rectangle, const glm::vec3& position,
                                                      const glm::vec2& u) const {
    const glm::vec3 to_light =
        rectangle.light.corner + rectangle.light.edge_u * u.x + rectangle.light.edge_v * u.y - position;
    const float distance2 = glm::dot(to_light, to_light);
    if (!(distance2 > 0.0F)) return std::nullopt;
    const float distance = std::sqrt(distance2);
    const glm::vec3 direction = to_light / distance;
    const float cos_light = -glm::dot(direction, rectangle.normal);
    if (cos_light <= 1e-6F) return std::nullopt;
    return LightSample{direction, distance, rectangle.light.radiance,
                       rectangle.probability * distance2 / (cos_light * rectangle.area), false};
}

std::optional<LightSample> LightSet::sample_emitter(const glm::vec3& position, float u_emitter,
                                                    const glm::vec2& u) const {
    const auto found = std::ranges::upper_bound(emitters_, u_emitter, {}, &Emitter::cumulative);
    const Emitter& emitter = found == emitters_.end() ? emitters_.back() : *found;
    const Mesh& mesh = *emitter.mesh;
    const Material& material = scene_.materials[static_cast<std::size_t>(mesh.material)];
    const glm::uvec3& t = mesh.triangles[emitter.triangle];
    const glm::vec3 corner = mesh.positions[t.x];
    const glm::vec3 edge_u = mesh.positions[t.y] - corner;
    const glm::vec3 edge_v = mesh.positions[t.z] - corner;
    const float root = std::sqrt(u.x);  // even over the triangle
    const float along_u = root * (1.0F - u.y);
    const float along_v = root * u.y;
    const glm::vec3 to_light = corner + edge_u * along_u + edge_v * along_v - position;
    const float distance2 = glm::dot(to_light, to_light);
    if (!(distance2 > 0.0F)) return std::nullopt;
    const float distance = std::sqrt(distance2);
    const glm::vec3 direction = to_light / distance;
    float cos_light = -glm::dot(direction, glm::normalize(glm::cross(edge_u, edge_v)));
    if (material.two_sided) cos_light = std::abs(cos_light);
    if (cos_light <= 1e-6F) return std::nullopt;
    const glm::vec2 uv = interpolate_uv(mesh, emitter.triangle, along_u, along_v);
    if (material.texture >= 0 && !mesh.uvs.empty() &&
        sample_texture_alpha(scene_.textures[static_cast<std::size_t>(material.texture)], uv) < kHoleAlpha) {
        return std::nullopt;
    }
    return LightSample{direction, distance, emission(mesh.material, uv),
                       emitter_pdf(mesh.material, distance, cos_light), false};
}

glm::vec3 LightSet::emission(int material, const glm::vec2& uv) const {
    const Material& of = scene_.materials[static_cast<std::size_t>(material)];
    if (of.emission_texture < 0) return of.emission;
    const RgbaF texel = sample_texture(scene_.textures[static_cast<std::size_t>(of.emission_texture)], uv);
    return of.emission * glm::vec3(texel.r, texel.g, texel.b);
}

float LightSet::emitter_pdf(int material, float distance, float cos_light) const {
    // An emitter is drawn by area times brightness, so the density per area is brightness over the sum of them.
    const float per_area = brightness_[static_cast<std::size_t>(material)] / static_cast<float>(emitter_power_);
    return emitter_probability_ * per_area * distance * distance / cos_light;
}

std::optional<LightSet::Crossing> LightSet::cross_rectangle(std::size_t index, const glm::vec3& origin,
                                                            const glm::vec3& direction, float max_distance) const {
    const Rectangle& rectangle = rectangles_[index];
    const float cos_light = -glm::dot(direction, rectangle.normal);
    if (cos_light <= 1e-6F) return std::nullopt;
    const glm::vec3 from_corner = origin - rectangle.light.corner;
    const float distance = glm::dot(from_corner, rectangle.normal) / cos_light;
    if (!(distance > 0.0F && distance < max_distance)) return std::nullopt;
    const glm::vec3 p = from_corner + direction * distance;
    // Coordinates along the edges, which need not be perpendicular.
    const float s = glm::dot(glm::cross(p, rectangle.light.edge_v), rectangle.normal) / rectangle.area;
    const float t = glm::dot(glm::cross(rectangle.light.edge_u, p), rectangle.normal) / rectangle.area;
    if (!(s >= 0.0F && s <= 1.0F && t >= 0.0F && t <= 1.0F)) return std::nullopt;
    return Crossing{rectangle.light.radiance,
                    rectangle.probability * distance * distance / (cos_light * rectangle.area)};
}

}  // namespace rs::capture
