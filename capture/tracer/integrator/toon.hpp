#pragma once
// Scenes as cartoons: Whitted's recursion, where the intensity of the light, not the colour, is stepped at every hit,
// so that what mirrors and glass show is drawn alike, with lines along edges (toon_edges.hpp). Source: N. Burnett and
// T. Piazza, "Toon Shading Using Distributed Raytracing".
//
//     colour of the surface * tone( (sum of E_k (N . L_k) over the lights that are seen + A) / (M + A) )
//
// E_k is the irradiance that light k would give a surface which faces it. M is what the surface at this place could get
// at most if it were turned the best way with nothing in between: |sum of E_k L_k|, or half the sum of E_k where lights
// stand opposite each other. So a single light has N . L for its intensity, however bright it is, and the best lit
// sides have the first tone however many lights there are. Colours of lights count nothing. The environment is one more
// light from far away, from where it shines the most, with what is above its least irradiance; the least, and the light
// that surfaces reflect, are A, which comes from everywhere. Normals are those of the vertices, interpolated. Emission
// is seen as it is, up to 1.

#include "capture/tracer/integrator/toon_edges.hpp"
#include "capture/tracer/integrator/whitted.hpp"
#include "capture/tracer/scene/toon_style.hpp"

#include <span>

namespace rs::capture {

class ToonTracer final : public WhittedTracer {
public:
    // `pixel_rad`: between the rays of neighbouring pixels in the middle of the image.
    ToonTracer(const LightTransport& transport, IrradianceMap irradiance, const glm::vec3& ambient, int max_depth,
               ToonStyle style, float pixel_rad);

    bool trace(const glm::vec3& origin, const glm::vec3& direction, float time, Sampler& sampler,
               glm::vec3& radiance) const override;
    void trace_many(std::span<CameraRay> rays, std::span<RadianceSample> arrived) const override {
        trace_one_by_one(rays, arrived);
    }

protected:
    bool shade(const LightTransport::Vertex& vertex, const Ray& ray, Sampler& sampler,
               glm::vec3& radiance) const override;

private:
    void find_sky();
    [[nodiscard]] float intensity(const LightTransport::Vertex& vertex, Sampler& sampler) const;

    ToonStyle style_;
    ToonEdges edges_;
    glm::vec3 sky_{0, 1, 0};  // where the environment shines the most from,
    float of_sky_ = 0;        // with as much irradiance,
    float everywhere_ = 0;    // and as much from everywhere
};

}  // namespace rs::capture
