#include "compositor/viewer/surface_tables.hpp"

#include <algorithm>

namespace rs::compositor {

static_assert(sizeof(LightRow) == 80 && sizeof(MaterialRow) == 48);

LightRow row_of(const Light& light) {
    return {{light.colour, 0},
            {light.ambient, static_cast<float>(light.radius)},
            {glm::vec3(light.location), static_cast<float>(light.cut_off_rad)},
            {glm::vec3(light.towards), static_cast<float>(light.beam_width_rad)},
            {light.attenuation, 0}};
}

AlphaUse alpha_use(const SceneTexture& texture) {
    if (!texture.has_alpha) return AlphaUse::kNone;
    std::size_t between = 0;
    std::size_t not_opaque = 0;
    const std::span<const Rgba8> pixels = texture.picture.pixels();
    for (const Rgba8& pixel : pixels) {
        between += pixel.a > 16 && pixel.a < 239;
        not_opaque += pixel.a < 239;
    }
    if (not_opaque == 0) return AlphaUse::kNone;
    return between * 20 > pixels.size() ? AlphaUse::kBlend : AlphaUse::kMask;
}

MaterialRow row_of(const Material& material) {
    return {{material.diffuse, material.opacity},
            {material.specular, material.shininess * 128},
            {material.emissive, material.ambient}};
}

std::vector<std::uint32_t> lights_that_reach(const Scene& scene, const GeometryNode& node,
                                             const BoundingBox& box_in_world) {
    std::vector<std::uint32_t> found = node.lights;
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        if (!light.everywhere) continue;
        const glm::dvec3 nearest = glm::clamp(light.location, box_in_world.lowest, box_in_world.highest);
        if (light.kind == LightKind::kDirectional || glm::distance(nearest, light.location) <= light.radius) {
            found.push_back(i);
        }
    }
    return found;
}

std::vector<LightRow> rows_of(const Scene& scene, const std::vector<std::uint32_t>& lights) {
    std::vector<LightRow> rows;
    for (const LightKind kind : {LightKind::kDirectional, LightKind::kPoint, LightKind::kSpot}) {
        for (const std::uint32_t i : lights) {
            if (scene.lights[i].kind == kind) rows.push_back(row_of(scene.lights[i]));
        }
    }
    return rows;
}

}  // namespace rs::compositor
