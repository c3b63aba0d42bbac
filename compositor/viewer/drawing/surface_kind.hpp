#pragma once
// Surface kinds; each has a shader of its own. Pure; thread-safe.

#include "compositor/scene/scene.hpp"
#include "compositor/viewer/shadows/shadow_plan.hpp"

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

namespace rs::compositor {

/// Reflection of the surroundings (ReflectionPass).
enum class Reflection {
    kNone = 0,
    kOpaque = 1,  // metals, mirrors, and coats that are not rough
    kGlass = 2,
};
/// kNone for materials of VRML and X3D, and with Phong's formula: their shading is specified.
Reflection reflection_of(const Material& material, Shading shading);

/// Features of a surface that select its shader (geometry_shaders.hpp).
struct SurfaceKind {
    int directional = 0;  // number of lights that reach the surface
    int points = 0;
    int spots = 0;
    int shadowed_directional = 0;  // the first lights of each type cast shadows
    int shadowed_points = 0;
    int narrow_spots = 0;  // spots with one map; spots with a cube map follow
    int wide_spots = 0;
    bool cascades = false;  // of a directional light
    bool fading = false;    // some lights attenuate with distance
    bool headlight = false;
    bool environment = false;  // irradiance of Scene::environment
    bool lit = false;
    bool shiny = false;
    int image = 0;  // texture: 0 none, 1 replaces the diffuse colour, 2 multiplies it
    AlphaUse image_alpha = AlphaUse::kNone;
    bool colours = false;  // vertex colours
    bool relief = false;   // NormalMap
    int fog = 0;           // 0 none, 1 linear, 2 exponential
    bool phong = false;    // Phong's formula
    Cover cover = Cover::kNone;
    Reflection reflection = Reflection::kNone;
    /// Light counts are uniforms instead of constants. Slower to draw, but night scenes would otherwise need dozens of
    /// kinds, and compiling one takes as long as many frames. The counts above are then 1 (possible) or 0 (never), so
    /// that impossible lights are not tested.
    bool counted = false;
    bool fog_only = false;  // draws only the fog in front of the surface
    auto operator<=>(const SurfaceKind&) const = default;
};

/// Adds the counts of `lights`, in any order, and `fading`.
void add_lights(const Scene& scene, const ShadowPlan& shadows, const std::vector<std::uint32_t>& lights,
                SurfaceKind& kind);

/// \param lights indices of the lights that reach the node, in any order.
SurfaceKind kind_of(const Scene& scene, const ShadowPlan& shadows, const GeometryNode& node, AlphaUse alpha,
                    const std::vector<std::uint32_t>& lights);

inline constexpr int kMaxCountedLights = 48;  // capacity of a `counted` kind

/// Head of the fragment shader source: its version and constants.
std::string constants_of(const SurfaceKind& kind);

}  // namespace rs::compositor
