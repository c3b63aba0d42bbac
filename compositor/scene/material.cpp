#include "compositor/scene/material.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace rs::compositor {
namespace {

float signed_part(std::uint8_t code) {
    return std::max((static_cast<float>(code) - 128) / 127, -1.0F);
}

int neighbour(int at, int size, bool repeats) {
    return repeats ? (at + size) % size : std::clamp(at, 0, size - 1);
}

}  // namespace

AlphaUse alpha_use(const SceneTexture& texture) {
    if (!texture.has_alpha) return AlphaUse::kNone;
    std::size_t between = 0;
    std::size_t not_opaque = 0;
    const std::span<const Rgba8> pixels = texture.image.pixels();
    for (const Rgba8& pixel : pixels) {
        between += pixel.a > 16 && pixel.a < 239;
        not_opaque += pixel.a < 239;
    }
    if (not_opaque == 0) return AlphaUse::kNone;
    return between * 20 > pixels.size() ? AlphaUse::kBlend : AlphaUse::kMask;
}

PhongTerms phong_terms(const Material& material) {
    return material.phong.value_or(PhongTerms{material.diffuse * material.ambient, material.shininess * 128});
}

SurfaceProperties surface_of(const Material& material) {
    if (material.surface) return *material.surface;
    const bool replaced = material.texture && !material.texture->modulates;
    const glm::vec3 diffuse = glm::clamp(replaced ? glm::vec3(1) : material.diffuse, glm::vec3(0), glm::vec3(1));
    const glm::vec3 specular = glm::clamp(material.specular, glm::vec3(0), glm::vec3(1));
    SurfaceProperties surface = phong_surface(diffuse, specular, material.shininess * 128);
    surface.emission = glm::max(material.emissive, glm::vec3(0));
    if (material.opacity < 0.5F) {
        surface.kind = rs::SurfaceKind::glass;
        surface.colour = glm::vec3(1);
    }
    return surface;
}

bool is_blended(const Material& material) {
    return material.opacity < 1 || (material.texture && alpha_use(*material.texture) == AlphaUse::kBlend);
}

std::shared_ptr<const NormalMap> normal_map(const SceneTexture& image, float scale) {
    auto map = std::make_shared<NormalMap>();
    map->file = image.file;
    map->repeat_s = image.repeat_s;
    map->repeat_t = image.repeat_t;
    map->directions = Image<RgbaF>(image.image.width(), image.image.height());
    std::ranges::transform(image.image.pixels(), map->directions.pixels().begin(), [&](const Rgba8& p) {
        return RgbaF{scale * signed_part(p.r), scale * signed_part(p.g), std::max(signed_part(p.b), 0.0F), 1};
    });
    return map;
}

std::shared_ptr<const NormalMap> normal_map_of_heights(const SceneTexture& image, float multiplier) {
    const Image<Rgba8>& heights = image.image;
    auto map = std::make_shared<NormalMap>();
    map->file = image.file;
    map->repeat_s = image.repeat_s;
    map->repeat_t = image.repeat_t;
    map->directions = Image<RgbaF>(heights.width(), heights.height());
    // Integers, so that constant heights give exactly flat normals; white is 255000.
    const auto height = [&](int x, int y) {
        const Rgba8& p =
            heights(neighbour(x, heights.width(), image.repeat_s), neighbour(y, heights.height(), image.repeat_t));
        return 299 * p.r + 587 * p.g + 114 * p.b;
    };
    for (int y = 0; y < heights.height(); ++y) {
        for (int x = 0; x < heights.width(); ++x) {
            int rise_s = 0;  // towards the right
            int rise_t = 0;  // upwards
            for (const auto& [aside, weight] : {std::pair(-1, 1), std::pair(0, 2), std::pair(1, 1)}) {
                rise_s += weight * (height(x + 1, y + aside) - height(x - 1, y + aside));
                rise_t += weight * (height(x + aside, y - 1) - height(x + aside, y + 1));
            }
            const float slope = multiplier / 255000;
            map->directions(x, y) = {0 - slope * static_cast<float>(rise_s), 0 - slope * static_cast<float>(rise_t), 1,
                                     1};
        }
    }
    return map;
}

}  // namespace rs::compositor
