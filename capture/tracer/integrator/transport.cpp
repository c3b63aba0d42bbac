#include "capture/tracer/integrator/transport.hpp"

#include "capture/tracer/scene/texture_lookup.hpp"
#include "rayspace/light/directions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace rs::capture {

namespace {

// Bends a normal until it faces the viewer. Interpolated normals may face away near silhouettes.
glm::vec3 facing_normal(const glm::vec3& normal, const glm::vec3& to_viewer) {
    constexpr float kMinViewerCos = 0.01F;
    const float cos_viewer = glm::dot(normal, to_viewer);
    if (cos_viewer >= kMinViewerCos) return normal;
    return glm::normalize(normal + to_viewer * (kMinViewerCos - cos_viewer));
}

glm::vec3 surface_colour(const Scene& scene, const Material& material, const SurfacePoint& point) {
    if (material.texture < 0) return material.colour * point.colour;
    const RgbaF texel = sample_texture(scene.textures[static_cast<std::size_t>(material.texture)], point.uv);
    return material.colour * point.colour * glm::vec3(texel.r, texel.g, texel.b);
}

}  // namespace

glm::vec3 LightTransport::mapped_normal(const SurfacePoint& point) const {
    const Material& material = material_of(point);
    const glm::vec3 normal = point.shading_normal;
    if (material.relief < 0) return normal;
    const RgbaF texel = sample_texture(scene_.reliefs[static_cast<std::size_t>(material.relief)], point.uv);
    if (texel.r == 0.0F && texel.g == 0.0F) return normal;
    const float side = point.front_side ? 1.0F : -1.0F;
    const glm::vec3 n = normal * side;
    const glm::vec3 u = point.along_u - n * glm::dot(n, point.along_u);
    const glm::vec3 v = point.along_v - n * glm::dot(n, point.along_v);
    const float u_length = glm::length(u), v_length = glm::length(v);
    if (!(u_length > 0.0F && v_length > 0.0F)) return normal;
    const glm::vec3 sum = u * (texel.r / u_length) + v * (texel.g / v_length) + n * texel.b;
    const float length = glm::length(sum);
    return length > 1e-6F ? sum * (side / length) : normal;
}

LightTransport::Vertex LightTransport::vertex_at(const SurfacePoint& point, const glm::vec3& direction) const {
    const Material& material = material_of(point);
    const glm::vec3 to_viewer = -direction;
    const Frame frame(facing_normal(mapped_normal(point), to_viewer));
    return {
        point, frame,
        Surface(model_of(point), surface_colour(scene_, material, point), frame.to_local(to_viewer), !point.front_side),
        model_of(point).translucency > 0.0F, rays_.step_off()};
}

LightTransport::SegmentEnd LightTransport::trace_segment(const Segment& segment, const MediumStack& media,
                                                         glm::vec3& throughput, glm::vec3& radiance,
                                                         SurfacePoint& point) const {
    const bool hit = segment.of_camera ? rays_.intersect_visible(segment.origin, segment.direction, segment.time, point)
                                       : rays_.intersect(segment.origin, segment.direction, segment.time, point);
    return finish_segment(segment, hit, media, throughput, radiance, point);
}

LightTransport::SegmentEnd LightTransport::finish_segment(const Segment& segment, bool hit, const MediumStack& media,
                                                          glm::vec3& throughput, glm::vec3& radiance,
                                                          const SurfacePoint& point) const {
    const float reach = hit ? point.distance : std::numeric_limits<float>::infinity();
    if (!segment.of_camera) {
        if (const auto primitive = rays_.intersect_primitives(segment.origin, segment.direction, reach)) {
            // Light sampling does not generate primitives, so they have weight 1.
            radiance += throughput * (primitive->radiance + area_radiance(segment, primitive->distance));
            return SegmentEnd::kLight;
        }
    }
    if (hit) throughput *= media.transmittance(point.distance);
    if (!segment.of_camera || visibility_.areas) radiance += throughput * area_radiance(segment, reach);
    if (!hit) {
        if (!segment.of_camera || visibility_.environment) radiance += throughput * environment_radiance(segment);
        return max_component(radiance) > 0.0F ? SegmentEnd::kLight : SegmentEnd::kNothing;
    }
    radiance += throughput * emission_of(point, segment);
    return !point.front_side && material_of(point).is_one_sided() ? SegmentEnd::kLight : SegmentEnd::kSurface;
}

glm::vec3 LightTransport::area_radiance(const Segment& segment, float distance) const {
    glm::vec3 sum(0.0F);
    for (std::size_t i = 0; i < lights_.area_count(); ++i) {
        const auto crossing = lights_.cross_area(i, segment.selection, segment.origin, segment.direction, distance);
        if (crossing) sum += crossing->radiance * (segment.specular ? 1.0F : light_weight(segment, crossing->pdf));
    }
    return sum;
}

glm::vec3 LightTransport::environment_radiance(const Segment& segment) const {
    if (lights_.environment().is_black()) return glm::vec3(0.0F);
    const float pdf = lights_.environment_pdf(segment.selection, segment.direction);
    return lights_.environment().radiance(segment.direction) * (segment.specular ? 1.0F : light_weight(segment, pdf));
}

glm::vec3 LightTransport::emission_of(const SurfacePoint& point, const Segment& segment) const {
    const Material& material = material_of(point);
    if (max_component(material.emission) <= 0.0F || (!point.front_side && !material.two_sided)) return glm::vec3(0.0F);
    const glm::vec3 emission = lights_.emission(point.material, point.uv);
    if (segment.specular || !point.is_light_sampled || max_component(emission) <= 0.0F) return emission;
    const float cos_light = std::max(-glm::dot(point.geometric_normal, segment.direction), 1e-6F);
    return emission *
           light_weight(segment, lights_.emitter_pdf(segment.selection, point.material, point.distance, cos_light));
}

glm::vec3 LightTransport::sample_light(const Vertex& vertex, float u_source, const glm::vec2& u) const {
    const auto light = lights_.sample(vertex.selection, u_source, u);
    return light ? reflect_light(*light, vertex) : glm::vec3(0.0F);
}

glm::vec3 LightTransport::reflect_light(const LightSample& light, const Vertex& vertex) const {
    const glm::vec3 black(0.0F);
    const glm::vec3 wi = vertex.frame.to_local(light.direction);
    const Surface::Value value = vertex.surface.evaluate(wi);
    if (max_component(value.f_cos) <= 0.0F) return black;
    const glm::vec3 start = vertex.ray_origin(light.direction, wi.z > 0.0F);
    // Ends just before the light, which may be a surface itself.
    const float reach = light.distance * (1.0F - 1e-4F);
    if (rays_.occluded(start, light.direction, reach, vertex.point.time, light.casters)) return black;
    const float weight = light.delta ? 1.0F : mis_weight(light.pdf, value.pdf);
    return value.f_cos * light.radiance * (weight / light.pdf);
}

LightTransport::Segment LightTransport::make_segment(const Vertex& vertex, const SurfaceSample& drawn) const {
    Segment segment;
    segment.time = vertex.point.time;
    segment.direction = glm::normalize(vertex.frame.to_world(drawn.direction));
    segment.pdf = drawn.pdf;
    segment.specular = drawn.specular;
    segment.selection = vertex.selection;
    const bool near_side = drawn.direction.z > 0.0F;
    if (drawn.specular) {
        // A reflection must leave the facet and a refraction must enter it. Interpolated normals may violate this near
        // silhouettes; the direction is then mirrored at the facet.
        const float cos_facet = glm::dot(vertex.point.geometric_normal, segment.direction);
        if ((cos_facet > 0.0F) != near_side) segment.direction -= 2.0F * cos_facet * vertex.point.geometric_normal;
    }
    segment.origin = vertex.ray_origin(segment.direction, near_side);
    return segment;
}

}  // namespace rs::capture
