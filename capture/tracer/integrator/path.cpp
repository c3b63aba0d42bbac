#include "capture/tracer/integrator/path.hpp"

#include <algorithm>

namespace rs::capture {

bool PathTracer::trace(const glm::vec3& origin, const glm::vec3& direction, float time, Sampler& sampler,
                       glm::vec3& radiance) const {
    constexpr int kRouletteFrom = 3;
    using Met = LightTransport::Met;
    radiance = glm::vec3(0.0F);
    glm::vec3 throughput(1.0F);
    LightTransport::Segment segment = LightTransport::camera_segment(origin, direction, time);
    MediumStack media;  // that the segment runs in

    for (int bounce = 0;; ++bounce) {
        SurfacePoint point;
        const Met met = transport_.meet(segment, media, throughput, radiance, point);
        if (met != Met::kSurface || bounce == max_bounces_) return bounce > 0 || met != Met::kNothing;

        LightTransport::Vertex vertex = transport_.vertex_at(point, segment.direction);
        const glm::vec2 choices = sampler.next_2d();
        if (!vertex.surface.is_specular()) {
            transport_.select_lights(vertex);
            radiance += throughput * transport_.light_sample(vertex, choices.y, sampler.next_2d());
        }
        SurfaceSample drawn;
        if (!vertex.surface.sample(choices.x, sampler.next_2d(), drawn)) return true;
        throughput *= drawn.weight;
        segment = transport_.segment_from(vertex, drawn);
        if (vertex.surface.passes(drawn)) media.cross(transport_.material_of(point), point.front_side);

        if (bounce >= kRouletteFrom) {
            const float survival = std::min(1.0F, max_component(throughput));
            if (!(sampler.next_2d().x < survival)) return true;
            throughput /= survival;
        }
    }
}

}  // namespace rs::capture
