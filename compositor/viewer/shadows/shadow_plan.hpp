#pragma once
// Which lights throw shadows in raster, and from where their maps are seen. Pure; thread-safe.
//
//   directional        of those that shine on some nodes only, the brightest on each: the others stand for light that
//                      walls reflect, which throws none. One parallel map that just holds what throws shadows: beyond
//                      it all is lit
//   narrow spots       one map seen from the light, as wide as its cone
//   points, wide spots the faces of a cube about the light; spots leave out the face behind them
//
// Maps hold reversed depth (gl/context.hpp): kNear over the axial depth where they are seen from a place, and a line
// from 1 at the nearest to 0 at the farthest where they are parallel.

#include "compositor/scene/scene.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace rs::compositor {

enum class ShadowShape { kNone, kParallel, kCone, kCube };

// One map.
struct ShadowFace {
    std::uint32_t light = 0;  // of Scene::lights
    bool of_cube = false;     // which of the two arrays of maps it is in: cubes have smaller ones
    int layer = 0;            // of that array
    glm::dmat4 clip_from_world{1.0};
    // Where it is seen from a place; else the direction it looks along counts alone.
    bool perspective = false;
    // Of a light that shines on some nodes only: where they are; of others empty. Only these nodes, and objects among
    // them, throw its shadows: rooms that light their own things through walls stay as light as they were.
    BoundingBox scope{};
};

// A light with maps. Rows are laid out as shadow_shaders.hpp declares them.
struct LightShadow {
    ShadowShape shape = ShadowShape::kNone;
    glm::vec4 row_u{0};        // parallel, cone: place in the world to u on the map; cube: its axis X
    glm::vec4 row_v{0};        // v; axis Y
    glm::vec4 row_depth{0};    // depth in the map; axial depth; axis Z
    glm::vec4 layer_texel{0};  // first layer; a texel's width in scene units, seen from a place: at axial depth 1
};

struct ShadowPlan {
    std::vector<LightShadow> of_light;  // [light of Scene::lights]; empty without shadows
    std::vector<ShadowFace> faces;
    int plane_side = 0;  // texels of parallel maps and cones; 0 where there are none
    int plane_layers = 0;
    int cube_side = 0;  // of cubes' faces
    int cube_layers = 0;

    [[nodiscard]] ShadowShape shape_of(std::uint32_t light) const {
        return light < of_light.size() ? of_light[light].shape : ShadowShape::kNone;
    }
};

// At most so many lights have maps, the brightest first; the others shine through everything.
inline constexpr int kMostPlaneShadows = 16;  // directional lights and narrow spots
inline constexpr int kMostCubeShadows = 48;   // points and wide spots
// Maps are as fine as so many texels of each of the two arrays allow (64 MiB each, and as much again once something
// has moved), up to the sides below.
inline constexpr int kMostShadowTexels = 1 << 24;
inline constexpr int kLargestPlaneSide = 2048;
inline constexpr int kLargestCubeSide = 1024;

// What is opaque: blended surfaces, lines and points throw none.
bool throws_shadows(const GeometryNode& node);
// What may throw shadows, in scene coordinates: objects with as much room about their place as they may need.
BoundingBox bounds_of_casters(const Scene& scene);

// `scene.lights` as raster has them (raster_lights.hpp). `casters` holds all that may throw a shadow, in scene
// coordinates; empty: nothing does.
ShadowPlan plan_shadows(const Scene& scene, const BoundingBox& casters);

}  // namespace rs::compositor
