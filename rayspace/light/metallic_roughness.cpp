#include "rayspace/light/metallic_roughness.hpp"

#include "rayspace/image/linear_light.hpp"

#include <algorithm>

namespace rs {

SurfaceProperties surface_of(const MetallicRoughness& material) {
    SurfaceProperties surface;
    surface.colour = glm::clamp(material.base, glm::vec3(0.0F), glm::vec3(1.0F));
    surface.roughness = std::clamp(material.roughness, 0.0F, 1.0F);
    surface.kind = material.metallic >= 0.5F ? SurfaceKind::metal : SurfaceKind::glossy;
    return surface;
}

PhongColours phong_colours_of(const MetallicRoughness& material, const glm::vec3& mean_texture) {
    const glm::vec3 base = glm::clamp(material.base, glm::vec3(0.0F), glm::vec3(1.0F));
    const float metallic = std::clamp(material.metallic, 0.0F, 1.0F);
    // Rough surfaces have wide highlights: the width of a Phong lobe of exponent n is about roughness^4 = 2 / (n + 2).
    const float r = std::clamp(material.roughness, 0.2F, 1.0F);
    return {base * (1 - 0.5F * metallic), glm::mix(glm::vec3(0.04F), base * mean_texture, metallic),
            std::clamp(2 / (r * r * r * r) - 2, 0.0F, 128.0F)};
}

glm::vec3 mean_of_codes(std::span<const Rgba8> pixels) {
    glm::dvec3 sum(0.0);
    for (const Rgba8& p : pixels) sum += glm::dvec3(p.r, p.g, p.b);
    return glm::vec3(sum / (255.0 * static_cast<double>(pixels.size())));
}

glm::vec3 mean_linear_colour(std::span<const Rgba8> pixels) {
    glm::dvec3 sum(0.0);
    for (const Rgba8& p : pixels) {
        sum += glm::dvec3(linear_from_srgb8(p.r), linear_from_srgb8(p.g), linear_from_srgb8(p.b));
    }
    return glm::vec3(sum / static_cast<double>(pixels.size()));
}

}  // namespace rs
