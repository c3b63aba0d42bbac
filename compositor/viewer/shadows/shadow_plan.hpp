#pragma once
// Selects the lights with shadow maps in raster rendering and the projections of the maps. Pure; thread-safe.
//
//     directional        of scoped ones only the brightest per node: the others model light reflected by walls,
//                        which casts no shadows. One orthographic map fitted to the casters; lit outside of it.
//                        In large scenes also cascades: finer maps of the surroundings of the eye
//     narrow spots       one perspective map that covers the cone
//     points, wide spots the faces of a cube map about the light; spots omit the face behind them
//
// Maps contain reversed depth (gl/context.hpp): kNear / axial depth in perspective maps; in orthographic maps linear
// from 1 (nearest) to 0 (farthest).
//
// Cascades (W. Engel, Cascaded Shadow Maps, ShaderX5, 2006) are nested squares about the eye in the light's plane.
// Their reaches are the logarithmic splits between the eye height and the half width of the scene, which is the
// practical split scheme of F. Zhang and others, Parallel-Split Shadow Maps, VRCIA 2006, for a nearest surface at the
// viewer's feet. Squares about the eye, in place of slices of the frustum, do not depend on the view direction: the
// walls of a CAVE, the faces of a panorama and the views of a quilt share them. They move in steps of whole texels, so
// that edges of shadows do not crawl, and of an eighth of their width, so that most frames reuse them.

#include "compositor/scene/scene.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rs::compositor {

enum class ShadowShape { kNone, kParallel, kCone, kCube };

/// One map.
struct ShadowFace {
    std::uint32_t light = 0;  // index into Scene::lights
    bool of_cube = false;     // selects the map array: cube maps are smaller
    int layer = 0;            // in that array
    glm::dmat4 clip_from_world{1.0};
    // Perspective map; else orthographic, only the view direction matters.
    bool perspective = false;
    // Bounds of the nodes of a scoped light; else empty. Only these nodes, and objects among them, cast its shadows:
    // rooms whose lights pass through walls keep their brightness.
    BoundingBox scope{};
};

/// Light with maps; rows in the layout of shadow_shaders.hpp.
struct LightShadow {
    ShadowShape shape = ShadowShape::kNone;
    glm::vec4 row_u{0};      // orthographic, cone: world position to u in the map; cube: its X axis
    glm::vec4 row_v{0};      // v; Y axis
    glm::vec4 row_depth{0};  // depth in the map; axial depth; Z axis
    // First layer; texel width in scene units, in perspective maps at axial depth 1; first row in
    // ShadowPlan::cascade_rows() and number of cascades of a directional light, whose layers follow.
    glm::vec4 layer_texel{0};
};

/// Map of the surroundings of the eye.
struct ShadowCascade {
    std::size_t face = 0;             // index into ShadowPlan::faces
    glm::dmat4 clip_from_world{1.0};  // of the light's map of all casters
    glm::dvec2 scale{1};              // width and height of that map over those of the cascade
    glm::dvec2 step_at{0};            // position in steps
};

struct ShadowPlan {
    std::vector<LightShadow> of_light;  // [index into Scene::lights]; empty without shadows
    std::vector<ShadowFace> faces;
    std::vector<ShadowCascade> cascades;  // kCascades per light with cascades, nearest first
    int plane_side = 0;                   // texels, orthographic maps and cones; 0 if none
    int plane_layers = 0;
    int cube_side = 0;  // texels of a cube face
    int cube_layers = 0;

    [[nodiscard]] ShadowShape shape_of(std::uint32_t light) const {
        return light < of_light.size() ? of_light[light].shape : ShadowShape::kNone;
    }
    [[nodiscard]] bool has_cascades(std::uint32_t light) const {
        return shape_of(light) == ShadowShape::kParallel && of_light[light].layer_texel.w > 0;
    }
    /// Moves the cascades to a viewpoint. The result depends on it alone, not on earlier ones.
    /// \return faces that have moved
    std::vector<std::size_t> centre_cascades(const glm::dvec3& eye);
    /// Rows for shadow_shaders.hpp: maps positions (u, v) in the map of all casters to xy + zw * (u, v) in the cascade.
    [[nodiscard]] std::vector<glm::vec4> cascade_rows() const;
};

// Limits; the brightest lights get maps first, the others cast no shadows.
inline constexpr int kMaxPlaneShadows = 16;  // directional lights and narrow spots
inline constexpr int kMaxCubeShadows = 48;   // points and wide spots
// Texel budget of each of the two arrays (64 MiB each, doubled after the first movement); limits the sides below.
inline constexpr int kMaxShadowTexels = 1 << 24;
inline constexpr int kMaxPlaneSide = 2048;
inline constexpr int kMaxCubeSide = 1024;
inline constexpr int kCascades = 3;           // per light, besides its map of all casters
inline constexpr int kMaxCascadedLights = 4;  // the brightest
inline constexpr int kCascadeSteps = 8;       // steps of a cascade per width; divides the sides of maps
/// A light has cascades if a texel of its only map, seen from the eye height, is wider than this: four pixels of a
/// frame of 1000 pixels and 53 degrees.
inline constexpr double kMaxTexel_rad = 1.0 / 250;

/// True for opaque triangle meshes; blended surfaces, lines and points cast no shadows.
bool casts_shadows(const GeometryNode& node);
/// Bounds of all possible casters in scene coordinates; objects with an upper bound of their size.
BoundingBox bounds_of_casters(const Scene& scene);

/// \param scene contains raster lights (scene_lights.hpp). Navigation::avatar has the eye height.
/// \param casters bounds of all shadow casters in scene coordinates; empty if there are none.
ShadowPlan plan_shadows(const Scene& scene, const BoundingBox& casters);

}  // namespace rs::compositor
