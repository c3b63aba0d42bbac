#pragma once
// What the shader of a surface has to do: surfaces of a kind share one (geometry_shaders.hpp). Pure; thread-safe.

#include "compositor/scene/scene.hpp"
#include "compositor/viewer/drawing/surface_tables.hpp"

#include <compare>
#include <string>

namespace rs::compositor {

struct SurfaceKind {
    int directional = 0;  // lights that reach it
    int points = 0;
    int spots = 0;
    bool fading = false;  // some of these lights are weaker farther away
    bool headlight = false;
    bool lit = false;
    bool shiny = false;
    int picture = 0;  // 0 none, 1 in place of the material's colour, 2 times it
    AlphaUse picture_alpha = AlphaUse::kNone;
    bool colours = false;  // of its own at the corners
    int fog = 0;           // 0 none, 1 linear, 2 exponential
    auto operator<=>(const SurfaceKind&) const = default;
};

// `lights`: those that reach it, in any order.
SurfaceKind kind_of(const Scene& scene, const GeometryNode& node, AlphaUse alpha,
                    const std::vector<std::uint32_t>& lights);

// The head of its fragment shader.
std::string constants_of(const SurfaceKind& kind);

}  // namespace rs::compositor
