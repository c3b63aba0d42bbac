#pragma once
// Instant radiosity with one set of virtual lights per pass (A. Keller, "Instant Radiosity", SIGGRAPH 1997).
//
//     photons from the lights -> virtual lights (virtual_lights.hpp)
//     camera ray -> mirrors, glass -> surface: a sample of each light (direct), all virtual lights (indirect)
//
// In images of 65,536 pixels and more virtual lights are interleaved: each pixel of a square of 4 x 4 has its own
// group, so that a square uses sixteen times as many (I. Wald et al., "Interactive Global Illumination using Fast Ray
// Tracing", Eurographics Rendering Workshop 2002); discontinuity_filter.hpp averages the groups. A packet consists of
// sixteen pixels with the same group.
//
// The geometry term is bounded near a virtual light to avoid bright spots in corners. Paths compute the clamped
// remainder: they continue from a surface only where the term exceeds the bound (T. Kollig, A. Keller, "Illumination
// in the Presence of Weak Singularities", MCQMC 2004). The mean of the passes thus converges to the path tracer's
// result.
//
// Not computed: indirect light from primitives and from emissive surfaces that move while the shutter is open.

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
    /// Traces the virtual lights for samples first <= s < first + count of an image; each sample is one pass. They
    /// depend only on `key` and the sample index.
    RadiosityTracer(const LightTransport& transport, const VirtualLightOptions& options, const RayImage& image,
                    std::uint64_t key, int first, int count);
    RadiosityTracer(const RadiosityTracer&) = delete;
    RadiosityTracer& operator=(const RadiosityTracer&) = delete;
    ~RadiosityTracer() override = default;

    /// Ignores `time`: the pass determines the time. A single ray uses the group of the first pixel of a square.
    bool trace(const glm::vec3& origin, const glm::vec3& direction, float time, Sampler& sampler,
               glm::vec3& radiance) const override;
    /// All rays must belong to one pass.
    void trace_many(std::span<CameraRay> rays, std::span<RadianceSample> samples) const override;

    [[nodiscard]] bool has_guides() const override { return true; }

    // Number of virtual lights of all passes.
    [[nodiscard]] std::size_t light_count() const;

private:
    using Vertex = LightTransport::Vertex;
    // State of the path that starts with one camera ray.
    struct PathState {
        CameraRay* ray = nullptr;  // null if the path has ended
        RadianceSample* sample = nullptr;
        LightTransport::Segment segment{};
        MediumStack media;
        glm::vec3 throughput{1.0F};
        std::optional<Vertex> vertex;  // end of the last segment
        // Cosine at the segment's origin if virtual lights have already accounted, up to the bound, for the light that
        // the segment finds on a surface; otherwise 0.
        float gathered_cos = 0.0F;
        float distance = 0.0F;  // length of the path

        void begin(CameraRay& from, RadianceSample& into, float at);
    };
    struct Packet;

    void trace_packet(Packet& packet) const;
    void trace_to_surfaces(Packet& packet, int bounce) const;
    void finish_hit(PathState& path, bool hit, const SurfacePoint& point, int bounce) const;
    void gather(Packet& packet, int bounce) const;
    [[nodiscard]] glm::vec3 gather_areas(const Vertex& vertex, Sampler& sampler) const;
    void continue_path(PathState& path, int bounce) const;
    // Time of a pass, for its virtual lights and its camera rays. 0 if nothing moves.
    [[nodiscard]] float time_of(int pass) const;
    [[nodiscard]] const std::vector<VirtualLight>& lights_for(const CameraRay& ray) const;

    LightTransport transport_;
    PacketMaterials materials_;
    VirtualLightOptions options_;
    std::uint64_t key_;
    int first_;
    int groups_ = 1;  // per pass
    float bound_ = 0.0F;
    std::vector<std::vector<VirtualLight>> lights_;  // [pass * groups_ + group]
};

}  // namespace rs::capture
