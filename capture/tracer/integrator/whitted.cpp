#include "capture/tracer/integrator/whitted.hpp"

#include <algorithm>

namespace rs::capture {

namespace {

constexpr float kMinThroughput = 1.0F / 256;

}  // namespace

bool WhittedTracer::trace(const glm::vec3& origin, const glm::vec3& direction, float time, Sampler& sampler,
                          glm::vec3& radiance) const {
    radiance = glm::vec3(0.0F);
    return follow({LightTransport::camera_segment(origin, direction, time)}, sampler, radiance);
}

bool WhittedTracer::follow(const Ray& ray, Sampler& sampler, glm::vec3& radiance) const {
    using SegmentEnd = LightTransport::SegmentEnd;
    Ray here = ray;
    SurfacePoint point;
    const SegmentEnd end = transport_.trace_segment(here.segment, here.media, here.throughput, radiance, point);
    if (end != SegmentEnd::kSurface) return here.depth > 0 || end != SegmentEnd::kNothing;
    const LightTransport::Vertex vertex = transport_.vertex_at(point, here.segment.direction);
    glm::vec3 reflected(0.0F);
    const bool has_specular_rays = shade(vertex, here, sampler, reflected);
    radiance += here.throughput * reflected;
    if (has_specular_rays) trace_specular(here, vertex, sampler, radiance);
    return true;
}

void WhittedTracer::trace_specular(const Ray& ray, const LightTransport::Vertex& vertex, Sampler& sampler,
                                   glm::vec3& radiance) const {
    if (ray.depth >= max_depth_) return;
    for (const SurfaceSample& direction : vertex.surface.specular_directions()) {
        Ray next = ray;
        next.throughput *= direction.weight;
        if (!(max_component(next.throughput) > kMinThroughput)) continue;
        next.segment = transport_.make_segment(vertex, direction);
        if (vertex.surface.is_transmission(direction)) {
            next.media.cross(transport_.material_of(vertex.point), vertex.point.front_side);
        }
        ++next.depth;
        next.previous_distance += vertex.point.distance;
        follow(next, sampler, radiance);
    }
}

bool WhittedTracer::shade(const LightTransport::Vertex& vertex, const Ray& /*ray*/, Sampler& sampler,
                          glm::vec3& radiance) const {
    if (vertex.surface.is_specular()) return true;
    radiance += ambient_light(vertex);
    for (std::size_t i = 0; i < transport_.lights().light_count(); ++i) {
        const auto shadow = make_shadow_ray(i, vertex, sampler);
        if (!shadow) continue;
        const RayScene::Ray& to = shadow->ray;
        if (!transport_.rays().occluded(to.origin, to.direction, to.reach, to.time, shadow->casters)) {
            radiance += shadow->light;
        }
    }
    return true;
}

std::optional<WhittedTracer::ShadowRay> WhittedTracer::make_shadow_ray(std::size_t index,
                                                                       const LightTransport::Vertex& vertex,
                                                                       Sampler& sampler) const {
    const LightSet& lights = transport_.lights();
    const LitPoint at = vertex.lit_point();
    const auto light = soft_shadows_ ? lights.sample_point(index, at, [&] { return sampler.next_2d(); })
                                     : lights.sample_centre(index, at);
    if (!light) return std::nullopt;
    if (!light->delta && is_metal(vertex)) return std::nullopt;
    const glm::vec3 wi = vertex.frame.to_local(light->direction);
    const glm::vec3 f_cos = vertex.surface.evaluate(wi).f_cos;
    if (!(max_component(f_cos) > 0.0F)) return std::nullopt;
    return ShadowRay{{vertex.ray_origin(light->direction, wi.z > 0.0F), light->direction, vertex.point.time,
                      light->distance * (1.0F - 1e-4F)},
                     f_cos * light->radiance / light->pdf,
                     light->casters};
}

bool WhittedTracer::is_metal(const LightTransport::Vertex& vertex) const {
    return transport_.model_of(vertex.point).kind == SurfaceKind::metal;
}

// Reflected and transmitted radiance of the environment and the ambient light.
glm::vec3 WhittedTracer::ambient_light(const LightTransport::Vertex& vertex) const {
    if (is_metal(vertex)) return glm::vec3(0.0F);
    return vertex.surface.colour() *
           (ambient_radiance(vertex.frame.normal, transport_.model_of(vertex.point).translucency) +
            transport_.scene().scopes.ambient(vertex.point.light_group));
}

glm::vec3 WhittedTracer::ambient_radiance(const glm::vec3& normal, float translucency) const {
    const glm::vec3 near = irradiance_.at(normal), far = irradiance_.at(-normal);
    return ambient_ + ((1.0F - translucency) * near + translucency * far) / kPiF;
}

}  // namespace rs::capture
