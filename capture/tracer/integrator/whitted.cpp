#include "capture/tracer/integrator/whitted.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace rs::capture {

namespace {

constexpr float kLeastThroughput = 1.0F / 256;

}  // namespace

bool WhittedTracer::trace(const glm::vec3& origin, const glm::vec3& direction, float time, Sampler& /*sampler*/,
                          glm::vec3& radiance) const {
    radiance = glm::vec3(0.0F);
    return follow({LightTransport::camera_segment(origin, direction, time)}, radiance);
}

template <class Visit>
void WhittedTracer::visit_lights(const Ray& ray, const LightTransport::Vertex& vertex, glm::vec3& radiance,
                                 const Visit& visit) const {
    if (vertex.surface.is_specular()) return;
    const bool metal = transport_.model_of(vertex.point).kind == SurfaceKind::metal;
    if (!metal) radiance += ray.throughput * matte_light(vertex);
    // As far as it is from where shadow rays start.
    const glm::vec3 place = vertex.start_of(vertex.point.geometric_normal, true);
    transport_.lights().visit_middles(place, [&](const LightSample& light) {
        if (metal && !light.delta) return;
        if (const auto shadow = shadow_of(vertex, light)) visit(*shadow);
    });
}

bool WhittedTracer::follow(Ray ray, glm::vec3& radiance) const {
    using Met = LightTransport::Met;
    SurfacePoint point;
    const Met met = transport_.meet(ray.segment, ray.media, ray.throughput, radiance, point);
    if (met != Met::kSurface) return ray.depth > 0 || met != Met::kNothing;
    const LightTransport::Vertex vertex = transport_.vertex_at(point, ray.segment.direction);
    visit_lights(ray, vertex, radiance, [&](const Shadow& shadow) {
        const RayScene::Ray& to = shadow.ray;
        if (transport_.rays().occluded(to.origin, to.direction, to.reach, to.time)) return;
        radiance += ray.throughput * shadow.light;
    });
    follow_mirrors(ray, vertex, radiance);
    return true;
}

void WhittedTracer::follow_mirrors(const Ray& ray, const LightTransport::Vertex& vertex, glm::vec3& radiance) const {
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
        follow(next, radiance);
    }
}

void WhittedTracer::trace_many(std::span<CameraRay> rays, std::span<Arrived> arrived) const {
    using Met = LightTransport::Met;
    constexpr float kFar = std::numeric_limits<float>::infinity();
    std::vector<RayScene::Ray> queries;
    queries.reserve(rays.size());
    for (const CameraRay& ray : rays) queries.push_back({ray.origin, ray.direction, ray.time, kFar});
    std::vector<RayScene::Hit> hits(rays.size());
    transport_.rays().intersect_many(queries, hits);

    struct Lit {
        std::size_t ray;
        Ray followed;
        LightTransport::Vertex vertex;
    };
    std::vector<Lit> surfaces;
    surfaces.reserve(rays.size());
    std::vector<Shadow> shadows;
    int sources = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        Ray ray{LightTransport::camera_segment(rays[i].origin, rays[i].direction, rays[i].time)};
        arrived[i] = {};
        SurfacePoint point;
        if (hits[i].met()) transport_.rays().surface_at(hits[i], rays[i].direction, rays[i].time, point);
        const Met met =
            transport_.arrive(ray.segment, hits[i].met(), ray.media, ray.throughput, arrived[i].radiance, point);
        arrived[i].met = met != Met::kNothing;
        if (met != Met::kSurface) continue;
        surfaces.push_back({i, ray, transport_.vertex_at(point, rays[i].direction)});
        visit_lights(ray, surfaces.back().vertex, arrived[i].radiance, [&](Shadow shadow) {
            shadow.vertex = surfaces.size() - 1;
            sources = std::max(sources, shadow.source + 1);
            shadows.push_back(shadow);
        });
    }

    // Light by light, so that the rays of a packet go the same way.
    std::vector<std::size_t> begins(static_cast<std::size_t>(sources) + 1, 0);
    for (const Shadow& shadow : shadows) ++begins[static_cast<std::size_t>(shadow.source) + 1];
    for (std::size_t i = 1; i < begins.size(); ++i) begins[i] += begins[i - 1];
    std::vector<std::size_t> places(shadows.size());
    queries.resize(shadows.size());
    for (std::size_t i = 0; i < shadows.size(); ++i) {
        places[i] = begins[static_cast<std::size_t>(shadows[i].source)]++;
        queries[places[i]] = shadows[i].ray;
    }
    std::vector<std::uint8_t> hidden(shadows.size());
    transport_.rays().occluded_many(queries, hidden);

    // Summed in the order of single rays.
    for (std::size_t i = 0; i < shadows.size(); ++i) {
        if (hidden[places[i]] != 0) continue;
        const Lit& lit = surfaces[shadows[i].vertex];
        arrived[lit.ray].radiance += lit.followed.throughput * shadows[i].light;
    }
    for (const Lit& lit : surfaces) follow_mirrors(lit.followed, lit.vertex, arrived[lit.ray].radiance);
}

// What comes from everywhere: a surface reflects it by its colour, and where it is thin, lets some through.
glm::vec3 WhittedTracer::matte_light(const LightTransport::Vertex& vertex) const {
    const glm::vec3 colour = vertex.surface.colour();
    const float through = transport_.model_of(vertex.point).translucency;
    const glm::vec3 near = irradiance_.at(vertex.frame.normal), far = irradiance_.at(-vertex.frame.normal);
    return colour * (ambient_ + ((1.0F - through) * near + through * far) / kPiF);
}

std::optional<WhittedTracer::Shadow> WhittedTracer::shadow_of(const LightTransport::Vertex& vertex,
                                                              const LightSample& light) {
    const glm::vec3 wi = vertex.frame.to_local(light.direction);
    const glm::vec3 f_cos = vertex.surface.evaluate(wi).f_cos;
    if (!(max_component(f_cos) > 0.0F)) return std::nullopt;
    const glm::vec3 start = vertex.start_of(light.direction, wi.z > 0.0F);
    return Shadow{{start, light.direction, vertex.point.time, light.distance * (1.0F - 1e-4F)},
                  f_cos * light.radiance / light.pdf,
                  0,
                  light.source};
}

}  // namespace rs::capture
