#pragma once
// The kinds of surfaces that have a shader each. Pure; thread-safe.

#include "compositor/scene/scene.hpp"
#include "compositor/viewer/shadows/shadow_plan.hpp"

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

namespace rs::compositor {

// What the shader of a surface has to do: surfaces of a kind share one (geometry_shaders.hpp).
struct SurfaceKind {
    int directional = 0;  // lights that reach it
    int points = 0;
    int spots = 0;
    int shadowed_directional = 0;  // the first so many of them throw shadows
    int shadowed_points = 0;
    int narrow_spots = 0;  // the first so many, with a single map; then those with a cube of them
    int wide_spots = 0;
    bool fading = false;  // some of these lights are weaker farther away
    bool headlight = false;
    bool lit = false;
    bool shiny = false;
    int image = 0;  // 0 none, 1 in place of the material's colour, 2 times it
    AlphaUse image_alpha = AlphaUse::kNone;
    bool colours = false;  // of its own at the corners
    bool relief = false;   // NormalMap
    int fog = 0;           // 0 none, 1 linear, 2 exponential
    bool phong = false;    // by Phong's formula
    Cover cover = Cover::kNone;
    // How many lights there are are numbers that it is given, not constants: slower to draw, but a street at night
    // would have dozens of kinds else, and making a shader takes as long as many frames. The numbers above show only
    // whether there may be any (1) or not (0): what cannot be is not tested.
    bool counted = false;
    bool veil = false;  // nothing but the fog before it
    auto operator<=>(const SurfaceKind&) const = default;
};

// The numbers of `lights`, in any order, and whether they fade.
void add_lights(const Scene& scene, const ShadowPlan& shadows, const std::vector<std::uint32_t>& lights,
                SurfaceKind& kind);

// `lights`: those that reach it, in any order.
SurfaceKind kind_of(const Scene& scene, const ShadowPlan& shadows, const GeometryNode& node, AlphaUse alpha,
                    const std::vector<std::uint32_t>& lights);

inline constexpr int kMostCountedLights = 48;  // that a `counted` kind has room for

// The head of its fragment shader.
std::string constants_of(const SurfaceKind& kind);

}  // namespace rs::compositor
