#pragma once
// Instant radiosity, a pass of virtual lights at a time (A. Keller, "Instant Radiosity", SIGGRAPH 1997).
//
//     photons from the lights -> virtual lights (virtual_lights.hpp)
//     camera ray -> mirrors, glass -> surface: a sample of each light for direct light, virtual lights for the rest
//
// In images of 65,536 pixels and more virtual lights are interleaved: of the pixels of each square of 4 x 4 every one
// has a group of its own, so that neighbours together see sixteen times as many (I. Wald et al., "Interactive Global
// Illumination using Fast Ray Tracing", Eurographics Rendering Workshop 2002); discontinuity_filter.hpp brings them
// together. Sixteen pixels that have the same group go together as a packet.
//
// Near a virtual light the geometry term is bounded, so that no bright spots stand in corners. What that cuts off is
// found by paths, which go on from a surface only where the term exceeds the bound (T. Kollig, A. Keller, "Illumination
// in the Presence of Weak Singularities", MCQMC 2004). So the mean of the passes goes to what a path tracer finds.
//
// Left out is the light that reaches the camera over more than one surface from primitives, and from surfaces that
// shine and move while the shutter is open.

#include "capture/tracer/image/ray_image.hpp"
#include "capture/tracer/integrator/gather_packet.hpp"
#include "capture/tracer/integrator/packet_materials.hpp"
#include "capture/tracer/integrator/transport.hpp"
#include "capture/tracer/integrator/virtual_lights.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace rs::capture {

class RadiosityTracer final : public Integrator {
public:
    // Makes ready for the samples first <= s < first + count of an image; each is a pass of its own. The same `key`
    // and sample give the same virtual lights.
    RadiosityTracer(const LightTransport& transport, const VirtualLightOptions& options, const RayImage& image,
                    std::uint64_t key, int first, int count);
    RadiosityTracer(const RadiosityTracer&) = delete;
    RadiosityTracer& operator=(const RadiosityTracer&) = delete;
    ~RadiosityTracer() override = default;

    // At the time of the sampler's pass, whatever `time` is. All rays of a call are of one pass. One ray alone counts
    // as the first pixel of its square.
    bool trace(const glm::vec3& origin, const glm::vec3& direction, float time, Sampler& sampler,
               glm::vec3& radiance) const override;
    void trace_many(std::span<CameraRay> rays, std::span<RadianceSample> arrived) const override;

    [[nodiscard]] bool gives_guides() const override { return true; }

    // Of the passes that are ready.
    [[nodiscard]] std::size_t light_count() const;

private:
    using Vertex = LightTransport::Vertex;
    // A camera ray on its way.
    struct Way {
        CameraRay* ray = nullptr;
        RadianceSample* arrived = nullptr;
        LightTransport::Segment segment{};
        MediumStack media;
        glm::vec3 throughput{1.0F};
        std::optional<Vertex> vertex;  // where it has arrived
        // Where virtual lights stand for what the segment would find on a surface, up to their bound: the cosine at its
        // beginning; else 0.
        float gathered_cos = 0.0F;
        float distance = 0.0F;  // so far

        void begin(CameraRay& from, RadianceSample& into, float at);
    };
    struct Packet;

    void trace_packet(Packet& packet) const;
    void follow_to_surfaces(Packet& packet, int bounce) const;
    void meet(Way& way, bool hit, const SurfacePoint& point, int bounce) const;
    void gather(Packet& packet, int bounce) const;
    [[nodiscard]] glm::vec3 from_areas(const Vertex& vertex, Sampler& sampler) const;
    void go_on(Way& way, int bounce) const;
    // A pass is a moment, for its virtual lights and all that they shine on. 0 where nothing moves.
    [[nodiscard]] float time_of(int pass) const;
    [[nodiscard]] const std::vector<VirtualLight>& lights_for(const CameraRay& ray) const;

    LightTransport transport_;
    PacketMaterials materials_;
    VirtualLightOptions options_;
    std::uint64_t key_;
    int first_;
    int groups_ = 1;  // of a pass
    float bound_ = 0.0F;
    std::vector<std::vector<VirtualLight>> lights_;  // of each group of each pass
};

}  // namespace rs::capture
