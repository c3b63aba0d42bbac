#include "compositor/viewer/drawing/surface_kind.hpp"

#include "compositor/viewer/drawing/shader_constants.hpp"

namespace rs::compositor {

SurfaceKind kind_of(const Scene& scene, const GeometryNode& node, AlphaUse alpha,
                    const std::vector<std::uint32_t>& lights) {
    SurfaceKind kind;
    kind.lit = node.material.lit;
    if (kind.lit) {
        for (const std::uint32_t i : lights) {
            const LightKind light = scene.lights[i].kind;
            ++(light == LightKind::kDirectional ? kind.directional
               : light == LightKind::kPoint     ? kind.points
                                                : kind.spots);
            kind.fading |= light != LightKind::kDirectional && scene.lights[i].attenuation != glm::vec3(1, 0, 0);
        }
        kind.headlight = scene.navigation.headlight;
        kind.shiny = node.material.specular != glm::vec3(0);
    }
    kind.picture = !node.material.texture ? 0 : node.material.texture->modulates ? 2 : 1;
    kind.picture_alpha = alpha;
    kind.colours = node.mesh->has_colours;
    if (scene.fog) kind.fog = scene.fog->kind == FogKind::kLinear ? 1 : 2;
    return kind;
}

std::string constants_of(const SurfaceKind& kind) {
    return "#version 450 core\n" + shader_constant("kDirectional", kind.directional) +
           shader_constant("kPoints", kind.points) + shader_constant("kSpots", kind.spots) +
           shader_constant("kFading", kind.fading) + shader_constant("kHeadlight", kind.headlight) +
           shader_constant("kLit", kind.lit) + shader_constant("kShiny", kind.shiny) +
           shader_constant("kPicture", kind.picture) +
           shader_constant("kPictureAlpha", static_cast<int>(kind.picture_alpha)) +
           shader_constant("kColours", kind.colours) + shader_constant("kFog", kind.fog);
}

}  // namespace rs::compositor
