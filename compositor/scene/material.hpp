#pragma once
// Surface materials of VRML97 (ISO/IEC 14772-1, 4.14 and 6.27). Colours are linear light.

#include "rayspace/image/image.hpp"

#include <filesystem>
#include <glm/glm.hpp>

#include <memory>
#include <optional>

namespace rs::compositor {

struct SceneTexture {
    std::filesystem::path file;  // empty: of no file of its own
    Image<Rgba8> image;          // sRGB, straight alpha; the first row is the top
    bool has_alpha = false;
    bool repeat_s = true;  // else clamp to edge
    bool repeat_t = true;
    bool modulates = false;  // multiplies the diffuse colour (grey images, glTF); otherwise replaces it
};

struct NormalMap;  // normal_map.hpp

enum class AlphaUse { kNone = 0, kMask = 1, kBlend = 2 };
/// kMask if nearly all alpha values are 0 or 255: drawn with sharp holes and without sorting.
AlphaUse alpha_use(const SceneTexture& texture);

/// Parameters of Phong's formula in addition to the material (Shading::kPhong).
struct PhongTerms {
    glm::vec3 ambient{0.2F};  // reflectance of ambient light
    float exponent = 25.6F;   // of the cosine between the view direction and the mirror direction, >= 0
    bool operator==(const PhongTerms&) const = default;
};

struct Material {
    glm::vec3 diffuse{0.8F};
    glm::vec3 specular{0};
    glm::vec3 emissive{0};
    float ambient = 0.2F;    // reflectance of a light's ambient part, times `diffuse`
    float shininess = 0.2F;  // times 128: the specular exponent
    float opacity = 1;       // 1 - transparency
    bool lit = true;         // else `diffuse` is displayed without lighting
    std::shared_ptr<const SceneTexture> texture;
    std::shared_ptr<const NormalMap> normals;  // normal map, at the same texture coordinates
    glm::mat3 texture_transform{1};            // applied to (s, t, 1)
    std::optional<PhongTerms> phong = {};      // if empty, derived from `ambient` and `shininess` (phong_terms)

    bool operator==(const Material&) const = default;
};
PhongTerms phong_terms(const Material& material);

/// True for transparent surfaces, which are drawn after all others, back to front.
bool is_blended(const Material& material);

}  // namespace rs::compositor
