#pragma once
// Instant radiosity, a pass of virtual lights at a time (A. Keller, "Instant Radiosity", SIGGRAPH 1997).
//
//     photons from the lights -> a virtual light wherever one meets a surface that is not specular
//     camera ray -> mirrors, glass -> surface: light samples for direct light, all virtual lights for the rest
//
// Photons leave lights drawn by their flux and die by roulette over what surfaces absorb. Virtual lights that bring the
// view little are few but strong: one is kept with the probability min(c / mean c + 0.05, 1), c being what it brings to
// some points that the camera sees, and its power is divided by that (I. Georgiev, P. Slusallek, "Simple and Robust
// Iterative Importance Sampling of Virtual Point Lights", Eurographics 2010).
//
// Near a virtual light the geometry term is bounded, so that no bright spots stand in corners. What that cuts off is
// found by paths, which go on from a surface only where the term exceeds the bound (T. Kollig, A. Keller, "Illumination
// in the Presence of Weak Singularities", MCQMC 2004). So the mean of the passes goes to what a path tracer finds.
//
// Left out is the light that reaches the camera over more than one surface from primitives, and from surfaces that
// shine and move while the shutter is open.

#include "capture/tracer/integrator/ray_picture.hpp"
#include "capture/tracer/integrator/transport.hpp"

#include <cstdint>
#include <vector>

namespace rs::capture {

struct RadiosityOptions {
    int max_bounces = 16;     // as RenderOptions has it
    int lights_of_pass = 24;  // that are kept, about
    bool importance = true;   // else all are kept
};

class RadiosityTracer final : public Integrator {
public:
    // Makes ready for the samples first <= s < first + count of a picture; each is a pass of its own. The same `key`
    // and sample give the same virtual lights.
    RadiosityTracer(const LightTransport& transport, const RadiosityOptions& options, const RayPicture& picture,
                    std::uint64_t key, int first, int count);

    // At the time of the sampler's pass, whatever `time` is.
    bool trace(const glm::vec3& origin, const glm::vec3& direction, float time, Sampler& sampler,
               glm::vec3& radiance) const override;

    // Of the passes that are ready.
    [[nodiscard]] std::size_t light_count() const;

private:
    using Vertex = LightTransport::Vertex;
    struct VirtualLight {
        Vertex vertex;   // seen from where the photon came
        glm::vec3 flux;  // that arrives
        int depth;       // surfaces that the photon has met, this one included
    };
    struct CameraPoint {
        Vertex vertex;
        glm::vec3 throughput;
    };
    using VirtualLights = std::vector<VirtualLight>;

    void find_camera_points(const RayPicture& picture);
    void plan_photons();
    void follow_photon(float time, Sampler& sampler, VirtualLights& lights) const;
    [[nodiscard]] VirtualLights lights_of(int pass) const;
    // A pass is a moment, for its virtual lights and all that they shine on. 0 where nothing moves.
    [[nodiscard]] float time_of(int pass) const;
    // What the camera points get, visibility included; luminance.
    [[nodiscard]] float importance_of(const VirtualLight& light) const;
    [[nodiscard]] glm::vec3 light_from(const VirtualLight& light, const Vertex& vertex) const;

    LightTransport transport_;
    RadiosityOptions options_;
    std::uint64_t key_;
    int first_;
    float bound_;  // of the geometry term, cosines over squared distance
    int photons_ = 1;
    float mean_importance_ = 0.0F;  // 0: all are kept
    std::vector<CameraPoint> camera_points_;
    std::vector<VirtualLights> passes_;
};

}  // namespace rs::capture
