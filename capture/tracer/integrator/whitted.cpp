#include "capture/tracer/integrator/whitted.hpp"

#include <algorithm>

namespace rs::capture {

namespace {

constexpr float kLeastThroughput = 1.0F / 256;

}  // namespace

bool WhittedTracer::trace(const glm::vec3& origin, const glm::vec3& direction, float time, Sampler& sampler,
                          glm::vec3& radiance) const {
    radiance = glm::vec3(0.0F);
    return follow({LightTransport::camera_segment(origin, direction, time)}, sampler, radiance);
}

bool WhittedTracer::follow(const Ray& ray, Sampler& sampler, glm::vec3& radiance) const {
    using Met = LightTransport::Met;
    Ray here = ray;
    SurfacePoint point;
    const Met met = transport_.meet(here.segment, here.media, here.throughput, radiance, point);
    if (met != Met::kSurface) return here.depth > 0 || met != Met::kNothing;
    const LightTransport::Vertex vertex = transport_.vertex_at(point, here.segment.direction);
    glm::vec3 sent(0.0F);
    const bool goes_on = shade(vertex, here, sampler, sent);
    radiance += here.throughput * sent;
    if (goes_on) follow_mirrors(here, vertex, sampler, radiance);
    return true;
}

void WhittedTracer::follow_mirrors(const Ray& ray, const LightTransport::Vertex& vertex, Sampler& sampler,
                                   glm::vec3& radiance) const {
    if (ray.depth >= max_depth_) return;
    for (const SurfaceSample& way : vertex.surface.specular_ways()) {
        Ray next = ray;
        next.throughput *= way.weight;
        if (!(max_component(next.throughput) > kLeastThroughput)) continue;
        next.segment = transport_.segment_from(vertex, way);
        if (vertex.surface.passes(way)) {
            next.media.cross(transport_.material_of(vertex.point), vertex.point.front_side);
        }
        ++next.depth;
        next.behind += vertex.point.distance;
        follow(next, sampler, radiance);
    }
}

bool WhittedTracer::shade(const LightTransport::Vertex& vertex, const Ray& /*ray*/, Sampler& sampler,
                          glm::vec3& radiance) const {
    if (vertex.surface.is_specular()) return true;
    radiance += matte_light(vertex);
    for (std::size_t i = 0; i < transport_.lights().light_count(); ++i) {
        const auto shadow = shadow_of(i, vertex, sampler);
        if (!shadow) continue;
        const RayScene::Ray& to = shadow->ray;
        if (!transport_.rays().occluded(to.origin, to.direction, to.reach, to.time)) radiance += shadow->light;
    }
    return true;
}

std::optional<WhittedTracer::Shadow> WhittedTracer::shadow_of(std::size_t number, const LightTransport::Vertex& vertex,
                                                              Sampler& sampler) const {
    const LightSet& lights = transport_.lights();
    // As far as it is from where shadow rays start.
    const glm::vec3 place = vertex.start_of(vertex.point.geometric_normal, true);
    const auto light =
        soft_shadows_ ? lights.point(number, place, [&] { return sampler.next_2d(); }) : lights.middle(number, place);
    if (!light) return std::nullopt;
    if (!light->delta && is_metal(vertex)) return std::nullopt;
    const glm::vec3 wi = vertex.frame.to_local(light->direction);
    const glm::vec3 f_cos = vertex.surface.evaluate(wi).f_cos;
    if (!(max_component(f_cos) > 0.0F)) return std::nullopt;
    return Shadow{{vertex.start_of(light->direction, wi.z > 0.0F), light->direction, vertex.point.time,
                   light->distance * (1.0F - 1e-4F)},
                  f_cos * light->radiance / light->pdf};
}

bool WhittedTracer::is_metal(const LightTransport::Vertex& vertex) const {
    return transport_.model_of(vertex.point).kind == SurfaceKind::metal;
}

// What comes from everywhere: a surface reflects it by its colour, and where it is thin, lets some through.
glm::vec3 WhittedTracer::matte_light(const LightTransport::Vertex& vertex) const {
    if (is_metal(vertex)) return glm::vec3(0.0F);
    return vertex.surface.colour() *
           from_everywhere(vertex.frame.normal, transport_.model_of(vertex.point).translucency);
}

glm::vec3 WhittedTracer::from_everywhere(const glm::vec3& normal, float translucency) const {
    const glm::vec3 near = irradiance_.at(normal), far = irradiance_.at(-normal);
    return ambient_ + ((1.0F - translucency) * near + translucency * far) / kPiF;
}

}  // namespace rs::capture
