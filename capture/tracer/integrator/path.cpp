#include "capture/tracer/integrator/path.hpp"

#include <algorithm>

namespace rs::capture {

bool PathTracer::trace(const glm::vec3& origin, const glm::vec3& direction, float time, Sampler& sampler,
                       glm::vec3& radiance) const {
    CameraRay ray{origin, direction, time, sampler};
    const RadianceSample arrived = follow(ray);
    sampler = ray.sampler;
    radiance = arrived.radiance;
    return arrived.met;
}

void PathTracer::trace_many(std::span<CameraRay> rays, std::span<RadianceSample> arrived) const {
    for (std::size_t i = 0; i < rays.size(); ++i) arrived[i] = follow(rays[i]);
}

RadianceSample PathTracer::follow(CameraRay& ray) const {
    // From its second rough surface on (its fourth of any kind) a path goes on with a probability of 2.5 times what is
    // left of its light, at most 1: fur, where little comes back, takes an eighth less time with the same noise.
    constexpr int kRouletteFrom = 3;
    constexpr int kRoughBefore = 2;
    constexpr float kRouletteMargin = 2.5F;
    using Met = LightTransport::Met;
    RadianceSample arrived;
    Sampler& sampler = ray.sampler;
    glm::vec3 throughput(1.0F);
    LightTransport::Segment segment = LightTransport::camera_segment(ray.origin, ray.direction, ray.time);
    MediumStack media;  // that the segment runs in
    float distance = 0.0F;
    int rough = 0;  // surfaces so far

    for (int bounce = 0;; ++bounce) {
        SurfacePoint point;
        const Met met = transport_.meet(segment, media, throughput, arrived.radiance, point);
        arrived.met = bounce > 0 || met != Met::kNothing;
        if (met != Met::kSurface || bounce == max_bounces_) return arrived;

        LightTransport::Vertex vertex = transport_.vertex_at(point, segment.direction);
        distance += point.distance;
        if (guides_) vertex.guide(distance, arrived);
        const glm::vec2 choices = sampler.next_2d();
        if (!vertex.surface.is_specular()) {
            ++rough;
            transport_.select_lights(vertex);
            arrived.radiance += throughput * transport_.light_sample(vertex, choices.y, sampler.next_2d());
        }
        SurfaceSample drawn;
        if (!vertex.surface.sample(choices.x, sampler.next_2d(), drawn)) return arrived;
        throughput *= drawn.weight;
        segment = transport_.segment_from(vertex, drawn);
        if (vertex.surface.passes(drawn)) media.cross(transport_.material_of(point), point.front_side);

        if (rough >= kRoughBefore || bounce >= kRouletteFrom) {
            const float survival = std::min(1.0F, kRouletteMargin * max_component(throughput));
            if (!(sampler.next_2d().x < survival)) return arrived;
            throughput /= survival;
        }
    }
}

}  // namespace rs::capture
