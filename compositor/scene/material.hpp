#pragma once
// What a surface looks like, as VRML97 describes it (ISO/IEC 14772-1, 4.14 and 6.27). Colours are linear light.

#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <memory>
#include <optional>

namespace rs::compositor {

struct SceneTexture {
    Image<Rgba8> image;  // sRGB, straight alpha; the first row is the top
    bool has_alpha = false;
    bool repeat_s = true;  // else the border goes on
    bool repeat_t = true;
    bool modulates = false;  // multiplies the diffuse colour (grey images, glTF); else it replaces it
};

struct NormalMap;  // normal_map.hpp

enum class AlphaUse { kNone = 0, kMask = 1, kBlend = 2 };
// An image whose alpha is nearly everywhere 0 or 255 cuts holes, with sharp edges and no order of drawing.
AlphaUse alpha_use(const SceneTexture& texture);

// What Phong's formula needs of a material beyond the rest (Shading::kPhong).
struct PhongTerms {
    glm::vec3 ambient{0.2F};  // reflected of the ambient light
    float exponent = 25.6F;   // of the cosine between the reflected viewer and the light, >= 0
    bool operator==(const PhongTerms&) const = default;
};

struct Material {
    glm::vec3 diffuse{0.8F};
    glm::vec3 specular{0};
    glm::vec3 emissive{0};
    float ambient = 0.2F;    // how much of a light's ambient part is reflected, times `diffuse`
    float shininess = 0.2F;  // times 128: the exponent of the highlight
    float opacity = 1;       // 1 - transparency
    bool lit = true;         // else it shows `diffuse` as it is
    std::shared_ptr<const SceneTexture> texture;
    std::shared_ptr<const NormalMap> normals;  // relief, at the same texture coordinates
    glm::mat3 texture_transform{1};            // of (s, t, 1)
    std::optional<PhongTerms> phong = {};      // else made of `ambient` and `shininess` (phong_terms)

    bool operator==(const Material&) const = default;
};
PhongTerms phong_terms(const Material& material);

// Whether other things shine through: such surfaces are drawn behind all others, the farthest first.
bool is_blended(const Material& material);

}  // namespace rs::compositor
