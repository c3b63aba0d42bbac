#include "compositor/scene/export/gltf_materials.hpp"

#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

namespace rs::compositor {
namespace {

using nlohmann::json;

constexpr std::uint64_t kMaxEmbeddedImage_bytes = std::uint64_t{64} << 20;
constexpr int kRepeat = 10497;
constexpr int kClampToEdge = 33071;

json colour_json(const glm::vec3& c) {
    return {c.r, c.g, c.b};
}

// Media type of a file that glTF viewers display as read_image() does; nullopt for other formats, and for images with a
// colour profile, which glTF ignores.
std::optional<const char*> embeddable_type(std::span<const std::byte> file) {
    const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
    const std::string_view head = text.substr(0, 65536);
    if (head.starts_with("\x89PNG\r\n\x1a\n")) {
        return head.find("iCCP") == std::string_view::npos ? std::optional("image/png") : std::nullopt;
    }
    if (head.starts_with("\xff\xd8\xff")) {
        const bool plain = head.find("ICC_PROFILE") == std::string_view::npos &&
                           head.find("Adobe") == std::string_view::npos;  // may be CMYK
        return plain ? std::optional("image/jpeg") : std::nullopt;
    }
    return std::nullopt;
}

std::uint8_t normal_code(float value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, -1.0F, 1.0F) * 127 + 128));
}

// Surface without textures: base colour, metallic, roughness.
struct MetallicRoughness {
    glm::vec3 base{1};
    float metallic = 0;
    float roughness = 1;
};

MetallicRoughness metallic_roughness(const Material& material) {
    if (!material.surface) {
        const bool shiny = material.specular != glm::vec3(0);
        return {material.diffuse, 0, shiny ? roughness_of_exponent(material.shininess * 128) : 1};
    }
    const SurfaceProperties& surface = *material.surface;
    switch (surface.kind) {
        case rs::SurfaceKind::metal:
            return {surface.colour, 1, surface.roughness};
        case rs::SurfaceKind::mirror:
            return {surface.colour, 1, 0};
        case rs::SurfaceKind::glossy:
            return {surface.colour, 0, surface.roughness};
        case rs::SurfaceKind::glass:
            return {surface.colour, 0, 0};
        case rs::SurfaceKind::diffuse:
            break;
    }
    return {surface.colour, 0, 1};
}

}  // namespace

Result<std::size_t> GltfMaterials::add(const Material& material, bool two_sided, bool coloured) {
    const auto known = std::ranges::find_if(written_, [&](const Written& written) {
        return written.two_sided == two_sided && written.coloured == coloured && written.material == material;
    });
    if (known != written_.end()) return known->index;
    RS_ASSIGN_OR_RETURN(json converted, convert(material, coloured));
    if (two_sided) converted["doubleSided"] = true;
    const std::size_t index = document_.append("materials", std::move(converted));
    written_.push_back({material, two_sided, coloured, index});
    return index;
}

Result<json> GltfMaterials::convert(const Material& material, bool coloured) {
    json made = json::object();
    const MetallicRoughness look = metallic_roughness(material);
    const bool replaced = material.texture && !material.texture->modulates;
    const AlphaUse alpha = material.texture ? alpha_use(*material.texture) : AlphaUse::kNone;
    const glm::vec3 base = coloured || replaced ? glm::vec3(1) : material.lit ? look.base : material.diffuse;
    const float opacity = replaced && alpha == AlphaUse::kBlend ? 1 : material.opacity;
    json& pbr = made["pbrMetallicRoughness"];
    pbr = {{"baseColorFactor", {base.r, base.g, base.b, opacity}},
           {"metallicFactor", look.metallic},
           {"roughnessFactor", look.roughness}};
    if (material.texture) {
        RS_ASSIGN_OR_RETURN(const std::size_t texture, texture_of(*material.texture));
        pbr["baseColorTexture"] = {{"index", texture}};
    }
    if (opacity < 1 || alpha == AlphaUse::kBlend) {
        made["alphaMode"] = "BLEND";
    } else if (alpha == AlphaUse::kMask) {
        made["alphaMode"] = "MASK";
    }
    const auto add_extension = [&](const char* name, json values) {
        document_.use_extension(name);
        made["extensions"][name] = std::move(values);
    };
    if (!material.lit) {
        add_extension("KHR_materials_unlit", json::object());
        return made;
    }
    const glm::vec3 emission = material.surface ? material.surface->emission : material.emissive;
    if (const float peak = std::max({emission.r, emission.g, emission.b}); peak > 0) {
        made["emissiveFactor"] = colour_json(emission / std::max(peak, 1.0F));
        if (peak > 1) add_extension("KHR_materials_emissive_strength", {{"emissiveStrength", peak}});
        if (material.emission_texture) {
            RS_ASSIGN_OR_RETURN(const std::size_t texture, texture_of(*material.emission_texture));
            made["emissiveTexture"] = {{"index", texture}};
        }
    }
    if (material.surface && material.surface->kind == rs::SurfaceKind::glass) {
        add_extension("KHR_materials_transmission", {{"transmissionFactor", 1}});
        add_extension("KHR_materials_ior", {{"ior", material.surface->ior}});
    }
    const bool matt =
        material.surface ? material.surface->kind == rs::SurfaceKind::diffuse : material.specular == glm::vec3(0);
    if (matt) made["extras"]["RaySpaceMaterial"] = {{"matt", true}};
    if (material.normals) {
        RS_ASSIGN_OR_RETURN(const std::size_t texture, normals_of(*material.normals));
        made["normalTexture"] = {{"index", texture}};
    }
    return made;
}

Result<std::size_t> GltfMaterials::texture_of(const SceneTexture& texture) {
    RS_ASSIGN_OR_RETURN(const std::size_t image, image_of(texture));
    return add_texture(image, texture.repeat_s, texture.repeat_t);
}

Result<std::size_t> GltfMaterials::image_of(const SceneTexture& texture) {
    if (const auto known = images_.find(&texture); known != images_.end()) return known->second;
    // Readers of models change alpha values.
    const bool unchanged = !texture.file.empty() && !(texture.modulates && texture.has_alpha);
    if (unchanged) {
        if (const auto known = files_.find(texture.file); known != files_.end()) return known->second;
        const auto file = read_file(texture.file, kMaxEmbeddedImage_bytes);
        if (const auto type = file ? embeddable_type(*file) : std::nullopt) {
            const std::size_t view = document_.add_view(*file);
            const std::string name = texture.file.stem().string();
            const std::size_t index =
                document_.append("images", {{"bufferView", view}, {"mimeType", *type}, {"name", name}});
            files_.emplace(texture.file, index);
            return index;
        }
    }
    RS_ASSIGN_OR_RETURN(const std::vector<std::byte> png, encode_png(texture.image, texture.file.string()));
    const std::size_t index = add_image(png);
    images_.emplace(&texture, index);
    return index;
}

Result<std::size_t> GltfMaterials::normals_of(const NormalMap& map) {
    auto known = images_.find(&map);
    if (known == images_.end()) {
        Image<Rgba8> codes(map.directions.width(), map.directions.height());
        std::ranges::transform(map.directions.pixels(), codes.pixels().begin(), [](const RgbaF& direction) {
            const glm::vec3 v(direction.r, direction.g, direction.b);
            const glm::vec3 n = glm::length(v) > 0 ? glm::normalize(v) : glm::vec3(0, 0, 1);
            return Rgba8{normal_code(n.x), normal_code(n.y), normal_code(n.z), 255};
        });
        RS_ASSIGN_OR_RETURN(const std::vector<std::byte> png, encode_png(codes, map.file.string()));
        known = images_.emplace(&map, add_image(png)).first;
    }
    return add_texture(known->second, map.repeat_s, map.repeat_t);
}

std::size_t GltfMaterials::add_image(std::span<const std::byte> file) {
    return document_.append("images", {{"bufferView", document_.add_view(file)}, {"mimeType", "image/png"}});
}

std::size_t GltfMaterials::add_texture(std::size_t image, bool repeat_s, bool repeat_t) {
    const auto key = std::tuple(image, repeat_s, repeat_t);
    if (const auto known = textures_.find(key); known != textures_.end()) return known->second;
    const std::size_t sampler = document_.append(
        "samplers", {{"wrapS", repeat_s ? kRepeat : kClampToEdge}, {"wrapT", repeat_t ? kRepeat : kClampToEdge}});
    const std::size_t index = document_.append("textures", {{"source", image}, {"sampler", sampler}});
    textures_.emplace(key, index);
    return index;
}

}  // namespace rs::compositor
