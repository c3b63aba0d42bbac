#include "capture/tracer/integrator/path.hpp"

#include <algorithm>

namespace rs::capture {

bool PathTracer::trace(const glm::vec3& origin, const glm::vec3& direction, float time, Sampler& sampler,
                       glm::vec3& radiance) const {
    CameraRay ray{origin, direction, time, sampler};
    const RadianceSample sample = follow(ray);
    sampler = ray.sampler;
    radiance = sample.radiance;
    return sample.hit;
}

void PathTracer::trace_many(std::span<CameraRay> rays, std::span<RadianceSample> samples) const {
    for (std::size_t i = 0; i < rays.size(); ++i) samples[i] = follow(rays[i]);
}

RadianceSample PathTracer::follow(CameraRay& ray) const {
    // From its second rough surface on (its fourth of any kind) a path continues with probability min(1, 2.5 * largest
    // throughput component). Compared with a later start, fur takes an eighth less time at the same noise.
    constexpr int kRouletteFrom = 3;
    constexpr int kRoughBefore = 2;
    constexpr float kRouletteMargin = 2.5F;
    using SegmentEnd = LightTransport::SegmentEnd;
    RadianceSample sample;
    Sampler& sampler = ray.sampler;
    glm::vec3 throughput(1.0F);
    LightTransport::Segment segment = LightTransport::camera_segment(ray.origin, ray.direction, ray.time);
    MediumStack media;
    float distance = 0.0F;
    int rough = 0;  // rough surfaces so far

    for (int bounce = 0;; ++bounce) {
        SurfacePoint point;
        const SegmentEnd end = transport_.trace_segment(segment, media, throughput, sample.radiance, point);
        sample.hit = bounce > 0 || end != SegmentEnd::kNothing;
        if (end != SegmentEnd::kSurface || bounce == max_bounces_) return sample;

        LightTransport::Vertex vertex = transport_.vertex_at(point, segment.direction);
        distance += point.distance;
        if (guides_) vertex.record_guide(distance, sample);
        const glm::vec2 choices = sampler.next_2d();
        if (!vertex.surface.is_specular()) {
            ++rough;
            transport_.select_lights(vertex);
            sample.radiance += throughput * transport_.sample_light(vertex, choices.y, sampler.next_2d());
        }
        SurfaceSample drawn;
        if (!vertex.surface.sample(choices.x, sampler.next_2d(), drawn)) return sample;
        throughput *= drawn.weight;
        segment = transport_.make_segment(vertex, drawn);
        if (vertex.surface.is_transmission(drawn)) media.cross(transport_.material_of(point), point.front_side);

        if (rough >= kRoughBefore || bounce >= kRouletteFrom) {
            const float survival = std::min(1.0F, kRouletteMargin * max_component(throughput));
            if (!(sampler.next_2d().x < survival)) return sample;
            throughput /= survival;
        }
    }
}

}  // namespace rs::capture
