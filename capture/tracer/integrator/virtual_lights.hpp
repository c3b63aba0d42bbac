#pragma once
// Where light that has fallen on surfaces goes out again: the virtual lights of instant radiosity (radiosity.hpp).
//
// Photons leave lights drawn by their flux and die by roulette over what surfaces absorb. Virtual lights that bring the
// view little are few but strong: one is kept with the probability min(c / mean c + 0.05, 1), c being what it brings to
// some points that the camera sees, and its power is divided by that (I. Georgiev, P. Slusallek, "Simple and Robust
// Iterative Importance Sampling of Virtual Point Lights", Eurographics 2010).

#include "capture/tracer/image/ray_image.hpp"
#include "capture/tracer/integrator/gather_packet.hpp"
#include "capture/tracer/integrator/transport.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace rs::capture {

inline constexpr int kMostMirrors = 8;  // that are followed for certain

struct VirtualLightOptions {
    int max_bounces = 16;      // as RenderOptions has it
    int lights_of_group = 48;  // that are kept, about
    bool importance = true;    // else all are kept
};

// Thread-safe.
class VirtualLights {
public:
    // Plans how many photons a group takes. Refers to all but the image.
    VirtualLights(const LightTransport& transport, const PacketMaterials& materials, const VirtualLightOptions& options,
                  const RayImage& image, std::uint64_t key);

    // Each stands for all light that has met a surface; their mean is it. At a time (RayScene).
    [[nodiscard]] std::vector<VirtualLight> group(int number, float time) const;
    // Of the geometry term, cosines over squared distance: that of surfaces half as far apart as those that the camera
    // sees are from what is around them (median), and at most a quarter of the scene's diagonal.
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
    // Of the photons first <= i < first + count of a sequence, in their order; in parallel.
    struct Found {
        VirtualLight light;
        float importance = 0.0F;  // where it counts
        float chosen = 0.0F;      // a random number for whether it is kept
    };
    [[nodiscard]] std::vector<Found> lights_of(std::uint64_t sequence, std::int64_t first, int count, float time) const;
    // What the camera points get, visibility included; luminance.
    [[nodiscard]] float importance_of(const VirtualLight& light, PacketLight& scratch) const;
    [[nodiscard]] bool by_importance() const { return options_.importance && !camera_points_.empty(); }

    const LightTransport& transport_;
    const PacketMaterials& materials_;
    VirtualLightOptions options_;
    std::uint64_t key_;
    float bound_ = 0.0F;
    int photons_ = 1;               // of a group
    float mean_importance_ = 0.0F;  // 0: all are kept
    std::vector<CameraPoints> camera_points_;
};

}  // namespace rs::capture
