#pragma once
// BSDF: evaluates and samples scattering directions at one point of one material.
//
// Directions are in the local frame of the shading normal (z), on the side of the incoming ray: wo.z > 0. wi.z < 0
// is the far side (translucent petals, glass). Values are f * |cos|. Every kind conserves energy: a surface of colour 1
// reflects all incident light.
//   diffuse  colour / pi, a share `translucency` of it on the far side
//   glossy   GGX dielectric coat over a Lambert base lit by the light that the coat does not reflect:
//            colour (1 - E(wo)) (1 - E(wi)) / (pi (1 - mean E))   (Kelemen and Szirmay-Kalos 2001)
//   metal    GGX conductor, scaled by 1 + F0 (1 - E) / E for multiple scattering (Turquin 2019, eq. 16)
//   mirror, glass   sampled only; their directions are unique

#include "capture/tracer/integrator/microfacet.hpp"
#include "capture/tracer/scene/scene.hpp"

#include <memory>
#include <vector>

namespace rs::capture {

// BSDF parameters that are constant over a material.
struct SurfaceModel {
    SurfaceKind kind = SurfaceKind::diffuse;
    float alpha = 0.09F;
    float ior = 1.5F;
    float translucency = 0.0F;
    std::shared_ptr<const AlbedoTable> albedo;  // glossy and metal; shared by materials of equal roughness and ior
};
std::vector<SurfaceModel> make_surface_models(const std::vector<Material>& materials);

struct SurfaceSample {
    glm::vec3 direction;  // local
    glm::vec3 weight;     // f |cos| / density
    float pdf;            // per steradian; undefined if specular
    bool specular;        // a unique direction, which light sampling cannot generate
};

class Surface {
public:
    /// \param colour the material's times the texture's
    /// \param leaving true if wo is inside the glass
    Surface(const SurfaceModel& model, const glm::vec3& colour, const glm::vec3& wo, bool leaving);

    [[nodiscard]] bool is_specular() const {
        return model_.kind == SurfaceKind::mirror || model_.kind == SurfaceKind::glass;
    }

    // Returns true if the sample enters or leaves glass.
    [[nodiscard]] bool is_transmission(const SurfaceSample& drawn) const {
        return model_.kind == SurfaceKind::glass && drawn.direction.z < 0.0F;
    }

    struct Value {
        glm::vec3 f_cos{0.0F};
        float pdf = 0.0F;  // density of wi under sample()
    };
    // Zero for specular kinds.
    [[nodiscard]] Value evaluate(const glm::vec3& wi) const;

    // All directions of specular reflection and refraction with their weights: mirror, glass, and metal treated as a
    // mirror. Empty for other kinds.
    [[nodiscard]] std::vector<SurfaceSample> specular_directions() const;
    [[nodiscard]] const glm::vec3& colour() const { return colour_; }
    [[nodiscard]] const glm::vec3& viewer() const { return wo_; }
    // Cached values, as in SurfaceLanes.
    [[nodiscard]] float albedo() const { return albedo_; }
    [[nodiscard]] float lambda() const { return lambda_; }

    /// \return false if the path ends here
    [[nodiscard]] bool sample(float u_lobe, const glm::vec2& u, SurfaceSample& drawn) const;

private:
    [[nodiscard]] bool sample_specular(float u_lobe, SurfaceSample& drawn) const;
    [[nodiscard]] SurfaceSample reflected(const glm::vec3& weight) const;
    [[nodiscard]] SurfaceSample refracted(const glm::vec3& weight) const;
    // Refractive index behind the surface divided by the index before it.
    [[nodiscard]] float relative_ior() const;

    const SurfaceModel& model_;
    glm::vec3 colour_;
    glm::vec3 wo_;
    bool leaving_;
    float albedo_ = 0.0F;            // E(wo)
    float lambda_ = 0.0F;            // smith_lambda() of wo
    float coat_probability_ = 0.0F;  // glossy: share of the samples drawn from the coat
};

}  // namespace rs::capture
