#pragma once
// Whitted ray tracing (T. Whitted, "An Improved Illumination Model for Shaded Display", CACM 23(6), 1980): direct
// light with hard shadows, mirrors and glass to a depth of 8; deterministic.
//
//     direct       each light as one point: area lights and emissive meshes by their centre or, for soft shadows, by a
//                  random point per sample (R. Cook, T. Porter, L. Carpenter, "Distributed Ray Tracing",
//                  SIGGRAPH 1984)
//     environment  cosine-convolved, without shadows; unchanged in mirrors and through glass
//     indirect     a constant, `ambient`
//     metal        a mirror of its colour at any roughness, with highlights of lights without an area
//
// Rays with a throughput below 1/256 are not traced.

#include "capture/tracer/integrator/packet_materials.hpp"
#include "capture/tracer/integrator/transport.hpp"
#include "capture/tracer/light/environment_map.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace rs::capture {

class WhittedTracer : public Integrator {
public:
    WhittedTracer(const LightTransport& transport, IrradianceMap irradiance, const glm::vec3& ambient, int max_depth,
                  bool soft_shadows = false)
        : transport_(transport),
          irradiance_(std::move(irradiance)),
          ambient_(ambient),
          max_depth_(max_depth),
          soft_shadows_(soft_shadows),
          materials_(transport.scene(), transport.models()) {}

    bool trace(const glm::vec3& origin, const glm::vec3& direction, float time, Sampler& sampler,
               glm::vec3& radiance) const override;
    /// Traces camera rays and shadow rays in packets (packets/packet.hpp), specular rays one by one.
    void trace_many(std::span<CameraRay> rays, std::span<RadianceSample> samples) const override;

protected:
    struct Ray {
        LightTransport::Segment segment;
        glm::vec3 throughput{1.0F};
        MediumStack media{};
        int depth = 0;
        float previous_distance = 0.0F;  // path length from the camera to the segment's origin
    };
    // Adds the radiance that a surface sends back along the ray, without specular reflection and refraction. Returns
    // false if the ray has no specular continuation.
    virtual bool shade(const LightTransport::Vertex& vertex, const Ray& ray, Sampler& sampler,
                       glm::vec3& radiance) const;
    [[nodiscard]] const LightTransport& transport() const { return transport_; }
    [[nodiscard]] const IrradianceMap& irradiance() const { return irradiance_; }

private:
    // A shadow ray, and the radiance that the surface reflects if it is unoccluded.
    struct ShadowRay {
        RayScene::Ray ray;
        glm::vec3 light;
        ShadowCasters casters;
    };
    // Sixteen neighbouring rays with their hits.
    struct Packet;
    void trace_packet(std::span<CameraRay> rays, std::span<RadianceSample> samples, Packet& packet) const;
    void intersect_packet(std::span<const CameraRay> rays, std::span<RadianceSample> samples, Packet& packet) const;
    bool finish_camera_ray(std::size_t lane, const Packet& packet, RadianceSample& sample) const;
    void prepare_shading(Packet& packet) const;
    void add_light_samples(std::size_t light, std::span<CameraRay> rays, Packet& packet) const;
    void trace_specular_rays(std::span<CameraRay> rays, std::span<RadianceSample> samples, const Packet& packet) const;
    bool follow(const Ray& ray, Sampler& sampler, glm::vec3& radiance) const;
    void trace_specular(const Ray& ray, const LightTransport::Vertex& vertex, Sampler& sampler,
                        glm::vec3& radiance) const;
    // Empty if the light contributes nothing.
    [[nodiscard]] std::optional<ShadowRay> make_shadow_ray(std::size_t index, const LightTransport::Vertex& vertex,
                                                           Sampler& sampler) const;
    [[nodiscard]] bool is_metal(const LightTransport::Vertex& vertex) const;
    [[nodiscard]] glm::vec3 ambient_light(const LightTransport::Vertex& vertex) const;
    [[nodiscard]] glm::vec3 ambient_radiance(const glm::vec3& normal, float translucency) const;

    LightTransport transport_;
    IrradianceMap irradiance_;
    glm::vec3 ambient_;
    int max_depth_;
    bool soft_shadows_;
    PacketMaterials materials_;
};

}  // namespace rs::capture
