#include "capture/tracer/integrator/transport.hpp"

#include "capture/tracer/scene/texture_lookup.hpp"
#include "rayspace/light/directions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace rs::capture {

namespace {

// Interpolated normals may face away from the viewer near silhouettes: the normal is bent just far enough to face them.
glm::vec3 facing_normal(const glm::vec3& normal, const glm::vec3& to_viewer) {
    constexpr float kLeastCos = 0.01F;
    const float cos_viewer = glm::dot(normal, to_viewer);
    if (cos_viewer >= kLeastCos) return normal;
    return glm::normalize(normal + to_viewer * (kLeastCos - cos_viewer));
}

glm::vec3 surface_colour(const Scene& scene, const Material& material, const SurfacePoint& point) {
    if (material.texture < 0) return material.colour * point.colour;
    const RgbaF texel = sample_texture(scene.textures[static_cast<std::size_t>(material.texture)], point.uv);
    return material.colour * point.colour * glm::vec3(texel.r, texel.g, texel.b);
}

}  // namespace

glm::vec3 LightTransport::normal_in_relief(const SurfacePoint& point) const {
    const Material& material = material_of(point);
    const glm::vec3 even = point.shading_normal;
    if (material.relief < 0) return even;
    const RgbaF texel = sample_texture(scene_.reliefs[static_cast<std::size_t>(material.relief)], point.uv);
    if (texel.r == 0.0F && texel.g == 0.0F) return even;
    const float side = point.front_side ? 1.0F : -1.0F;
    const glm::vec3 n = even * side;
    const glm::vec3 u = point.along_u - n * glm::dot(n, point.along_u);
    const glm::vec3 v = point.along_v - n * glm::dot(n, point.along_v);
    const float u_length = glm::length(u), v_length = glm::length(v);
    if (!(u_length > 0.0F && v_length > 0.0F)) return even;
    const glm::vec3 sum = u * (texel.r / u_length) + v * (texel.g / v_length) + n * texel.b;
    const float length = glm::length(sum);
    return length > 1e-6F ? sum * (side / length) : even;
}

LightTransport::Vertex LightTransport::vertex_at(const SurfacePoint& point, const glm::vec3& direction) const {
    const Material& material = material_of(point);
    const glm::vec3 to_viewer = -direction;
    const Frame frame(facing_normal(normal_in_relief(point), to_viewer));
    return {
        point, frame,
        Surface(model_of(point), surface_colour(scene_, material, point), frame.to_local(to_viewer), !point.front_side),
        model_of(point).translucency > 0.0F, rays_.step_off()};
}

LightTransport::Met LightTransport::meet(const Segment& segment, const MediumStack& media, glm::vec3& throughput,
                                         glm::vec3& radiance, SurfacePoint& point) const {
    const bool hit = segment.of_camera ? rays_.intersect_seen(segment.origin, segment.direction, segment.time, point)
                                       : rays_.intersect(segment.origin, segment.direction, segment.time, point);
    return arrive(segment, hit, media, throughput, radiance, point);
}

LightTransport::Met LightTransport::arrive(const Segment& segment, bool hit, const MediumStack& media,
                                           glm::vec3& throughput, glm::vec3& radiance,
                                           const SurfacePoint& point) const {
    const float reach = hit ? point.distance : std::numeric_limits<float>::infinity();
    if (!segment.of_camera) {
        if (const auto shown = rays_.ask_primitives(segment.origin, segment.direction, reach)) {
            // It is drawn by no light sample, so it counts in full; of the light that passes before it, too.
            radiance += throughput * (shown->radiance + areas_on_the_way(segment, shown->distance));
            return Met::kLight;
        }
    }
    if (hit) throughput *= media.passed(point.distance);
    if (!segment.of_camera || seen_.areas) radiance += throughput * areas_on_the_way(segment, reach);
    if (!hit) {
        if (!segment.of_camera || seen_.environment) radiance += throughput * environment_behind(segment);
        return max_component(radiance) > 0.0F ? Met::kLight : Met::kNothing;
    }
    radiance += throughput * emission_of(point, segment);
    return !point.front_side && material_of(point).is_one_sided() ? Met::kLight : Met::kSurface;
}

glm::vec3 LightTransport::areas_on_the_way(const Segment& segment, float distance) const {
    glm::vec3 sum(0.0F);
    for (std::size_t i = 0; i < lights_.area_count(); ++i) {
        const auto crossing = lights_.cross_area(i, segment.selection, segment.origin, segment.direction, distance);
        if (crossing) sum += crossing->radiance * (segment.specular ? 1.0F : weight_of(segment, crossing->pdf));
    }
    return sum;
}

glm::vec3 LightTransport::environment_behind(const Segment& segment) const {
    if (lights_.environment().is_black()) return glm::vec3(0.0F);
    const float pdf = lights_.environment_pdf(segment.selection, segment.direction);
    return lights_.environment().radiance(segment.direction) * (segment.specular ? 1.0F : weight_of(segment, pdf));
}

glm::vec3 LightTransport::emission_of(const SurfacePoint& point, const Segment& segment) const {
    const Material& material = material_of(point);
    if (max_component(material.emission) <= 0.0F || (!point.front_side && !material.two_sided)) return glm::vec3(0.0F);
    const glm::vec3 emission = lights_.emission(point.material, point.uv);
    if (segment.specular || !point.light_drawn || max_component(emission) <= 0.0F) return emission;
    const float cos_light = std::max(-glm::dot(point.geometric_normal, segment.direction), 1e-6F);
    return emission *
           weight_of(segment, lights_.emitter_pdf(segment.selection, point.material, point.distance, cos_light));
}

glm::vec3 LightTransport::light_sample(const Vertex& vertex, float u_source, const glm::vec2& u) const {
    const auto light = lights_.sample(vertex.selection, u_source, u);
    return light ? light_from(*light, vertex) : glm::vec3(0.0F);
}

glm::vec3 LightTransport::light_from(const LightSample& light, const Vertex& vertex) const {
    const glm::vec3 dark(0.0F);
    const glm::vec3 wi = vertex.frame.to_local(light.direction);
    const Surface::Value value = vertex.surface.evaluate(wi);
    if (max_component(value.f_cos) <= 0.0F) return dark;
    const glm::vec3 start = vertex.start_of(light.direction, wi.z > 0.0F);
    // Just short of the light, which may be a surface itself.
    const float reach = light.distance * (1.0F - 1e-4F);
    if (rays_.occluded(start, light.direction, reach, vertex.point.time)) return dark;
    const float weight = light.delta ? 1.0F : mis_weight(light.pdf, value.pdf);
    return value.f_cos * light.radiance * (weight / light.pdf);
}

LightTransport::Segment LightTransport::segment_from(const Vertex& vertex, const SurfaceSample& drawn) const {
    Segment segment;
    segment.time = vertex.point.time;
    segment.direction = glm::normalize(vertex.frame.to_world(drawn.direction));
    segment.pdf = drawn.pdf;
    segment.specular = drawn.specular;
    segment.selection = vertex.selection;
    const bool near_side = drawn.direction.z > 0.0F;
    if (drawn.specular) {
        // A reflection must leave the facet and a refraction must enter it; interpolated normals may say otherwise near
        // silhouettes, where the direction is mirrored at the facet.
        const float cos_facet = glm::dot(vertex.point.geometric_normal, segment.direction);
        if ((cos_facet > 0.0F) != near_side) segment.direction -= 2.0F * cos_facet * vertex.point.geometric_normal;
    }
    segment.origin = vertex.start_of(segment.direction, near_side);
    return segment;
}

}  // namespace rs::capture
