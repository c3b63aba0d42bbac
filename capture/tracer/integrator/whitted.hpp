#pragma once
// Ray tracing as T. Whitted has it ("An Improved Illumination Model for Shaded Display", CACM 23(6), 1980): direct
// light with hard shadows, mirrors and glass to a depth of 8, and nothing at random.
//
//     direct       each light from one point: areas and surfaces that shine from their middle, or, for soft shadows,
//                  from a place of theirs that each sample draws anew (R. Cook, T. Porter, L. Carpenter, "Distributed
//                  Ray Tracing", SIGGRAPH 1984): then this is random, too
//     environment  cosine-convolved, without shadows; seen in mirrors and through glass as it is
//     the rest     a constant, `ambient`
//     metal        a mirror of its colour, whatever its roughness, with the highlights of lights without an area
//
// Rays whose light would come to less than 1/256 of the image's are not followed.

#include "capture/tracer/integrator/packet_materials.hpp"
#include "capture/tracer/integrator/transport.hpp"
#include "capture/tracer/light/irradiance_map.hpp"

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
    // Camera rays and those to lights in packets (packets/packet.hpp), light by light; mirrors and glass are followed
    // ray by ray.
    void trace_many(std::span<CameraRay> rays, std::span<RadianceSample> arrived) const override;

protected:
    struct Ray {
        LightTransport::Segment segment;
        glm::vec3 throughput{1.0F};
        MediumStack media{};
        int depth = 0;
        float behind = 0.0F;  // how far it is from the camera to where the segment begins
    };
    // What a surface sends back along the ray that met it, beside what it reflects or lets pass. False where it does
    // neither.
    virtual bool shade(const LightTransport::Vertex& vertex, const Ray& ray, Sampler& sampler,
                       glm::vec3& radiance) const;
    [[nodiscard]] const LightTransport& transport() const { return transport_; }
    [[nodiscard]] const IrradianceMap& irradiance() const { return irradiance_; }

private:
    // The ray to a light, and what the light makes the surface send where nothing is in its way.
    struct Shadow {
        RayScene::Ray ray;
        glm::vec3 light;
    };
    // Sixteen rays of neighbours, and what they have met.
    struct Packet;
    void trace_packet(std::span<CameraRay> rays, std::span<RadianceSample> arrived, Packet& packet) const;
    void meet(std::span<const CameraRay> rays, std::span<RadianceSample> arrived, Packet& packet) const;
    bool arrive_at(std::size_t lane, const Packet& packet, RadianceSample& arrived) const;
    void make_ready(Packet& packet) const;
    void light_packet(std::size_t light, std::span<CameraRay> rays, Packet& packet) const;
    void go_on(std::span<CameraRay> rays, std::span<RadianceSample> arrived, const Packet& packet) const;
    bool follow(const Ray& ray, Sampler& sampler, glm::vec3& radiance) const;
    void follow_mirrors(const Ray& ray, const LightTransport::Vertex& vertex, Sampler& sampler,
                        glm::vec3& radiance) const;
    // Nothing where the light of this number brings nothing.
    [[nodiscard]] std::optional<Shadow> shadow_of(std::size_t number, const LightTransport::Vertex& vertex,
                                                  Sampler& sampler) const;
    [[nodiscard]] bool is_metal(const LightTransport::Vertex& vertex) const;
    [[nodiscard]] glm::vec3 matte_light(const LightTransport::Vertex& vertex) const;
    [[nodiscard]] glm::vec3 from_everywhere(const glm::vec3& normal, float translucency) const;

    LightTransport transport_;
    IrradianceMap irradiance_;
    glm::vec3 ambient_;
    int max_depth_;
    bool soft_shadows_;
    PacketMaterials materials_;
};

}  // namespace rs::capture
