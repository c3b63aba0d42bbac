#include "capture/tracer/integrator/whitted.hpp"

namespace rs::capture {

namespace {

constexpr float kLeastThroughput = 1.0F / 256;

}  // namespace

bool WhittedTracer::trace(const glm::vec3& origin, const glm::vec3& direction, float time, Sampler& sampler,
                          glm::vec3& radiance) const {
    radiance = glm::vec3(0.0F);
    return follow({LightTransport::camera_segment(origin, direction, time)}, sampler, radiance);
}

bool WhittedTracer::follow(Ray ray, Sampler& sampler, glm::vec3& radiance) const {
    using Met = LightTransport::Met;
    SurfacePoint point;
    const Met met = transport_.meet(ray.segment, ray.media, ray.throughput, radiance, point);
    if (met != Met::kSurface) return ray.depth > 0 || met != Met::kNothing;
    const LightTransport::Vertex vertex = transport_.vertex_at(point, ray.segment.direction);
    glm::vec3 sent(0.0F);
    const bool goes_on = shade(vertex, ray.segment.direction, sampler, sent);
    radiance += ray.throughput * sent;
    if (!goes_on || ray.depth >= max_depth_) return true;
    for (const SurfaceSample& way : vertex.surface.specular_ways()) {
        Ray next = ray;
        next.throughput *= way.weight;
        if (!(max_component(next.throughput) > kLeastThroughput)) continue;
        next.segment = transport_.segment_from(vertex, way);
        if (vertex.surface.passes(way)) next.media.cross(transport_.material_of(point), point.front_side);
        ++next.depth;
        follow(next, sampler, radiance);
    }
    return true;
}

bool WhittedTracer::shade(const LightTransport::Vertex& vertex, const glm::vec3& /*direction*/, Sampler& sampler,
                          glm::vec3& radiance) const {
    if (vertex.surface.is_specular()) return true;
    const bool metal = transport_.model_of(vertex.point).kind == SurfaceKind::metal;
    if (!metal) radiance += matte_light(vertex);
    // As far as it is from where shadow rays start.
    const glm::vec3 place = vertex.start_of(vertex.point.geometric_normal, true);
    const auto add = [&](const LightSample& light) {
        if (!metal || light.delta) radiance += light_of(vertex, light);
    };
    if (soft_shadows_) {
        transport_.lights().visit_points(
            place, [&] { return sampler.next_2d(); }, add);
    } else {
        transport_.lights().visit_middles(place, add);
    }
    return true;
}

// What comes from everywhere: a surface reflects it by its colour, and where it is thin, lets some through.
glm::vec3 WhittedTracer::matte_light(const LightTransport::Vertex& vertex) const {
    const glm::vec3 colour = vertex.surface.colour();
    const float through = transport_.model_of(vertex.point).translucency;
    const glm::vec3 near = irradiance_.at(vertex.frame.normal), far = irradiance_.at(-vertex.frame.normal);
    return colour * (ambient_ + ((1.0F - through) * near + through * far) / kPiF);
}

glm::vec3 WhittedTracer::light_of(const LightTransport::Vertex& vertex, const LightSample& light) const {
    const glm::vec3 wi = vertex.frame.to_local(light.direction);
    const glm::vec3 f_cos = vertex.surface.evaluate(wi).f_cos;
    if (!(max_component(f_cos) > 0.0F)) return glm::vec3(0.0F);
    const glm::vec3 start = vertex.start_of(light.direction, wi.z > 0.0F);
    const float reach = light.distance * (1.0F - 1e-4F);
    if (transport_.rays().occluded(start, light.direction, reach, vertex.point.time)) return glm::vec3(0.0F);
    return f_cos * light.radiance / light.pdf;
}

}  // namespace rs::capture
