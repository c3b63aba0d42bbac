#pragma once
// Ray tracing as T. Whitted has it ("An Improved Illumination Model for Shaded Display", CACM 23(6), 1980): direct
// light with hard shadows, mirrors and glass to a depth of 8, and nothing at random.
//
//     direct       each light from one point: areas and surfaces that shine from their middle
//     environment  cosine-convolved, without shadows; seen in mirrors and through glass as it is
//     the rest     a constant, `ambient`
//     metal        a mirror of its colour, whatever its roughness, with the highlights of lights without an area
//
// Rays whose light would come to less than 1/256 of the picture's are not followed.

#include "capture/tracer/integrator/transport.hpp"
#include "capture/tracer/light/irradiance_map.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <utility>

namespace rs::capture {

class WhittedTracer final : public Integrator {
public:
    WhittedTracer(const LightTransport& transport, IrradianceMap irradiance, const glm::vec3& ambient, int max_depth)
        : transport_(transport), irradiance_(std::move(irradiance)), ambient_(ambient), max_depth_(max_depth) {}

    bool trace(const glm::vec3& origin, const glm::vec3& direction, float time, Sampler& sampler,
               glm::vec3& radiance) const override;
    // Camera rays and those to lights in packets, light by light; mirrors and glass are followed ray by ray.
    void trace_many(std::span<CameraRay> rays, std::span<Arrived> arrived) const override;

private:
    struct Ray {
        LightTransport::Segment segment;
        glm::vec3 throughput{1.0F};
        MediumStack media{};
        int depth = 0;
    };
    bool follow(Ray ray, glm::vec3& radiance) const;
    void follow_mirrors(const Ray& ray, const LightTransport::Vertex& vertex, glm::vec3& radiance) const;
    // Of a vertex that is not specular: what comes from everywhere, and each light that counts there.
    template <class Visit>
    void visit_lights(const Ray& ray, const LightTransport::Vertex& vertex, glm::vec3& radiance,
                      const Visit& visit) const;
    // The ray to a light, and what the light brings where nothing is in its way.
    struct Shadow {
        RayScene::Ray ray;
        glm::vec3 light;
        std::size_t vertex;  // of a list
        int source;
    };
    [[nodiscard]] static std::optional<Shadow> shadow_of(const LightTransport::Vertex& vertex,
                                                         const LightSample& light);
    [[nodiscard]] glm::vec3 matte_light(const LightTransport::Vertex& vertex) const;

    LightTransport transport_;
    IrradianceMap irradiance_;
    glm::vec3 ambient_;
    int max_depth_;
};

}  // namespace rs::capture
