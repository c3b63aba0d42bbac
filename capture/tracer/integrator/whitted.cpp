#include "capture/tracer/integrator/whitted.hpp"

#include <algorithm>
#include <limits>

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
    const bool goes_on = shade(vertex, here.segment.direction, sampler, sent);
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
        follow(next, sampler, radiance);
    }
}

bool WhittedTracer::shade(const LightTransport::Vertex& vertex, const glm::vec3& /*direction*/, Sampler& sampler,
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

void WhittedTracer::trace_many(std::span<CameraRay> rays, std::span<Arrived> arrived) const {
    constexpr std::size_t kBatch = 64;  // what the nearest cache holds
    Batch batch;
    for (std::size_t first = 0; first < rays.size(); first += kBatch) {
        const std::size_t count = std::min(kBatch, rays.size() - first);
        trace_batch(rays.subspan(first, count), arrived.subspan(first, count), batch);
    }
}

void WhittedTracer::trace_batch(std::span<CameraRay> rays, std::span<Arrived> arrived, Batch& batch) const {
    using Met = LightTransport::Met;
    constexpr float kFar = std::numeric_limits<float>::infinity();
    batch.queries.clear();
    batch.surfaces.clear();
    for (const CameraRay& ray : rays) batch.queries.push_back({ray.origin, ray.direction, ray.time, kFar});
    batch.hits.resize(rays.size());
    transport_.rays().intersect_many(batch.queries, batch.hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const RayScene::Hit& hit = batch.hits[i];
        Ray ray{LightTransport::camera_segment(rays[i].origin, rays[i].direction, rays[i].time)};
        arrived[i] = {};
        SurfacePoint point;
        if (hit.met()) transport_.rays().surface_at(hit, rays[i].direction, rays[i].time, point);
        const Met met =
            transport_.arrive(ray.segment, hit.met(), ray.media, ray.throughput, arrived[i].radiance, point);
        arrived[i].met = met != Met::kNothing;
        if (met != Met::kSurface) continue;
        batch.surfaces.push_back({i, ray, transport_.vertex_at(point, rays[i].direction), glm::vec3(0.0F)});
    }
    light_surfaces(rays, batch);
    for (const Batch::Lit& lit : batch.surfaces) {
        Arrived& into = arrived[lit.ray];
        into.radiance += lit.followed.throughput * lit.sent;
        follow_mirrors(lit.followed, lit.vertex, rays[lit.ray].sampler, into.radiance);
    }
}

// Light by light, so that the rays of a packet go the same way; what a surface sends is summed in the order of shade().
void WhittedTracer::light_surfaces(std::span<CameraRay> rays, Batch& batch) const {
    for (Batch::Lit& lit : batch.surfaces) {
        if (!lit.vertex.surface.is_specular()) lit.sent += matte_light(lit.vertex);
    }
    for (std::size_t light = 0; light < transport_.lights().light_count(); ++light) {
        batch.queries.clear();
        batch.brought.clear();
        for (Batch::Lit& lit : batch.surfaces) {
            if (lit.vertex.surface.is_specular()) continue;
            const auto shadow = shadow_of(light, lit.vertex, rays[lit.ray].sampler);
            if (!shadow) continue;
            batch.queries.push_back(shadow->ray);
            batch.brought.push_back({&lit, shadow->light});
        }
        batch.hidden.resize(batch.queries.size());
        transport_.rays().occluded_many(batch.queries, batch.hidden);
        for (std::size_t i = 0; i < batch.brought.size(); ++i) {
            if (batch.hidden[i] == 0) batch.brought[i].to->sent += batch.brought[i].light;
        }
    }
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
    const glm::vec3 colour = vertex.surface.colour();
    const float through = transport_.model_of(vertex.point).translucency;
    const glm::vec3 near = irradiance_.at(vertex.frame.normal), far = irradiance_.at(-vertex.frame.normal);
    return colour * (ambient_ + ((1.0F - through) * near + through * far) / kPiF);
}

}  // namespace rs::capture
