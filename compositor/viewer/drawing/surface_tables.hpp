#pragma once
// The numbers that the geometry's shaders read, laid out as they declare them (geometry_shaders.hpp). Pure;
// thread-safe.

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
    // Of all directional lights that reach it; in Phong's formula what is reflected of it. w unused.
    glm::vec4 ambient_light{0};
};
MaterialRow row_of(const Material& material, Shading shading);

struct SurfaceLights {
    std::vector<std::uint32_t> lights;  // of Scene::lights, that may be reflected somewhere on the surface
    glm::vec3 ambient{0};               // of all directional lights, also of those that are not reflected
};
// The lights that reach a node: those of `node.lights`, and of those everywhere all that are near enough to the node's
// box, and spots whose cone may meet it. Of a surface that is seen from its front only, lights that shine on its back
// everywhere are left out: a wall has few lights, and a shader evaluates each of them at every pixel.
SurfaceLights lights_of(const Scene& scene, const GeometryNode& node, const BoundingBox& box_in_world);

// Of a node that moves: as lights_of(), but no light is left out for shining on its back.
SurfaceLights lights_near(const Scene& scene, const GeometryNode& node, const BoundingBox& box_in_world);

// As the shaders take them: directional ones first, then points, then spots; of each kind those with shadows first, of
// spots the narrow ones.
std::vector<std::uint32_t> in_shader_order(const Scene& scene, const ShadowPlan& shadows,
                                           std::vector<std::uint32_t> lights);
// In the order of `lights`.
std::vector<LightRow> rows_of(const Scene& scene, const std::vector<std::uint32_t>& lights);

struct ShadowRow {
    glm::vec4 u, v, depth, layer_texel;  // LightShadow
};
// Of those of `lights` that throw shadows, in their order.
std::vector<ShadowRow> rows_of(const ShadowPlan& shadows, const std::vector<std::uint32_t>& lights);

}  // namespace rs::compositor
