#include "compositor/scene/material.hpp"

#include <span>

namespace rs::compositor {

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

bool is_blended(const Material& material) {
    return material.opacity < 1 || (material.texture && alpha_use(*material.texture) == AlphaUse::kBlend);
}

}  // namespace rs::compositor
