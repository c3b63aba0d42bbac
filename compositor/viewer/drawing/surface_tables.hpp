#pragma once
// Uniform tables of the geometry shaders, in the layout that geometry_shaders.hpp declares. Pure; thread-safe.

#include "compositor/scene/scene.hpp"
#include "compositor/viewer/shadows/shadow_plan.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace rs::compositor {

struct LightRow {
    glm::vec4 colour;
    glm::vec4 ambient_radius;
    glm::vec4 location_cut_off;
    glm::vec4 towards_beam;
    glm::vec4 attenuation;
};
LightRow row_of(const Light& light);

struct MaterialRow {
    glm::vec4 diffuse_opacity;
    glm::vec4 specular_exponent;
    glm::vec4 emissive_ambient;
    // Sum over the directional lights that reach the surface; with Phong's formula, its reflected part. w unused.
    glm::vec4 ambient_light{0};
    glm::vec4 ambient_reflectance{0};  // of the environment's irradiance / pi, times the diffuse colour in VRML97
    glm::vec4 reflection{0};  // metallic, 0 or 1; roughness; dielectric reflectance at normal incidence; unused
};
inline constexpr std::size_t kMaterialRows = sizeof(MaterialRow) / sizeof(glm::vec4);

MaterialRow row_of(const Material& material, Shading shading);

struct SurfaceLights {
    std::vector<std::uint32_t>
        lights;            // indices into Scene::lights; lights that may be reflected somewhere on the surface
    glm::vec3 ambient{0};  // sum over all directional lights, including those not reflected
};
/// Lights that reach a node: those of `node.lights`, and unscoped lights whose range and spot cone intersect the node's
/// box. Lights behind one-sided surfaces are omitted: a wall then has few lights, each of which costs time at every
/// pixel.
SurfaceLights lights_of(const Scene& scene, const GeometryNode& node, const BoundingBox& box_in_world);

/// Same for a movable node: lights behind one-sided surfaces are included.
SurfaceLights lights_near(const Scene& scene, const GeometryNode& node, const BoundingBox& box_in_world);

/// Sorts lights into the shader's order: directional, point, spot; within each type shadow casters first, narrow spots
/// before wide ones.
std::vector<std::uint32_t> sort_for_shader(const Scene& scene, const ShadowPlan& shadows,
                                           std::vector<std::uint32_t> lights);
/// Rows in the order of `lights`.
std::vector<LightRow> rows_of(const Scene& scene, const std::vector<std::uint32_t>& lights);

struct ShadowRow {
    glm::vec4 u, v, depth, layer_texel;  // LightShadow
};
/// Rows of the shadow casters among `lights`, in their order.
std::vector<ShadowRow> rows_of(const ShadowPlan& shadows, const std::vector<std::uint32_t>& lights);

}  // namespace rs::compositor
