#pragma once
// Surface materials of VRML97 (ISO/IEC 14772-1, 4.14 and 6.27) with textures and normal maps. Colours are linear light.
// Functions are pure and thread-safe.

#include "rayspace/image/image.hpp"
#include "rayspace/light/surface_properties.hpp"

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

/// Normal map in the tangent frame of the texture coordinates.
/// One direction of any length per texel: r along s, g along t, b away from the surface; a is 1. (0, 0, 1) keeps the
/// surface's normal bit for bit. Interpolated between texels, then normalised.
struct NormalMap {
    std::filesystem::path file;  // as SceneTexture::file
    Image<RgbaF> directions;     // the first row is the top, at the largest t
    bool repeat_s = true;
    bool repeat_t = true;
};

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
    // For traced renderers; if empty, derived from the fields above (surface_of).
    std::optional<SurfaceProperties> surface = {};
    std::shared_ptr<const SceneTexture> emission_texture = {};  // of `surface`

    bool operator==(const Material&) const = default;
};
PhongTerms phong_terms(const Material& material);

/// Surface for traced renderers, without textures: `surface`, or that of the VRML97 material (phong_surface), of glass
/// if its opacity is below 1/2. Not for unlit materials.
SurfaceProperties surface_of(const Material& material);

/// True for transparent surfaces, which raster renderers draw after all others, back to front.
bool is_blended(const Material& material);

/// Converts a glTF 2.0 normal texture (3.9.3): bytes 1, 128, 255 are -1, 0, 1.
/// \param scale factor on r and g.
std::shared_ptr<const NormalMap> normal_map(const SceneTexture& image, float scale);

/// Converts a height image (its luminance; MTL's bump map) with the Sobel operator.
/// \param multiplier MTL's -bm: a step from black to white between two columns gives a slope of 4 at both.
std::shared_ptr<const NormalMap> normal_map_of_heights(const SceneTexture& image, float multiplier);

}  // namespace rs::compositor
