#pragma once
// Virtual point lights of instant radiosity (radiosity.hpp).
//
// Photons start at lights chosen in proportion to flux and are absorbed by Russian roulette. A virtual light is kept
// with probability min(c / mean c + 0.05, 1), where c is its contribution to a set of points visible to the camera, and
// its power is divided by that probability (I. Georgiev, P. Slusallek, "Simple and Robust Iterative Importance Sampling
// of Virtual Point Lights", Eurographics 2010).

#include "capture/tracer/image/ray_image.hpp"
#include "capture/tracer/integrator/gather_packet.hpp"
#include "capture/tracer/integrator/transport.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace rs::capture {

inline constexpr int kMaxSpecularBounces = 8;  // followed without Russian roulette

struct VirtualLightOptions {
    int max_bounces = 16;       // see RenderOptions
    int lights_per_group = 48;  // approximate number after selection
    bool importance = true;     // select lights by importance; otherwise all are kept
};

// Thread-safe.
class VirtualLights {
public:
    // Determines the number of photons per group. Keeps references to all arguments but the image.
    VirtualLights(const LightTransport& transport, const PacketMaterials& materials, const VirtualLightOptions& options,
                  const RayImage& image, std::uint64_t key);

    // Traces one group of virtual lights at a time (RayScene). Each group is an unbiased estimate of all indirect
    // light; groups are averaged.
    [[nodiscard]] std::vector<VirtualLight> make_group(int number, float time) const;
    // Upper bound of the geometry term (cosines over squared distance): its value at half the median distance between
    // surfaces visible to the camera and the surfaces around them, at most a quarter of the scene's diagonal.
    [[nodiscard]] float bound() const { return bound_; }

private:
    using Vertex = LightTransport::Vertex;
    struct CameraPoints {
        GatherPacket packet;
        std::array<glm::vec3, kLanes> throughput{};
    };

    void find_camera_points(const RayImage& image);
    void find_bound(std::vector<float> distances);
    void plan_photons();
    void follow_photon(float time, Sampler& sampler, std::vector<VirtualLight>& lights) const;
    struct Candidate {
        VirtualLight light;
        float importance = 0.0F;  // 0 if lights are not selected by importance
        float u_keep = 0.0F;      // random number for the selection
    };
    // Traces photons first <= i < first + count of a sequence in parallel; the result is in their order.
    [[nodiscard]] std::vector<Candidate> trace_photons(std::uint64_t sequence, std::int64_t first, int count,
                                                       float time) const;
    // Luminance that the light contributes to the camera points, visibility included.
    [[nodiscard]] float estimate_importance(const VirtualLight& light, PacketLight& scratch) const;
    [[nodiscard]] bool uses_importance() const { return options_.importance && !camera_points_.empty(); }

    const LightTransport& transport_;
    const PacketMaterials& materials_;
    VirtualLightOptions options_;
    std::uint64_t key_;
    float bound_ = 0.0F;
    int photons_ = 1;               // per group
    float mean_importance_ = 0.0F;  // 0: all are kept
    std::vector<CameraPoints> camera_points_;
};

}  // namespace rs::capture
