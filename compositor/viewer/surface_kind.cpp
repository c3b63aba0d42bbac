#include "compositor/viewer/surface_kind.hpp"

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
    const auto whole = [](const char* name, int value) {
        return std::string("const int ") + name + " = " + std::to_string(value) + ";\n";
    };
    const auto truth = [](const char* name, bool value) {
        return std::string("const bool ") + name + (value ? " = true;\n" : " = false;\n");
    };
    return "#version 450 core\n" + whole("kDirectional", kind.directional) + whole("kPoints", kind.points) +
           whole("kSpots", kind.spots) + truth("kHeadlight", kind.headlight) + truth("kLit", kind.lit) +
           truth("kShiny", kind.shiny) + whole("kPicture", kind.picture) +
           whole("kPictureAlpha", static_cast<int>(kind.picture_alpha)) + truth("kColours", kind.colours) +
           whole("kFog", kind.fog);
}

}  // namespace rs::compositor
