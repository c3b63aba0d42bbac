#include "compositor/scene/vrml/appearance.hpp"

#include "rayspace/image/linear_light.hpp"
#include "rayspace/light/metallic_roughness.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>

namespace rs::compositor::vrml {
namespace {

float fraction(double number) {
    return static_cast<float>(std::clamp(number, 0.0, 1.0));
}

// Factor of a PhysicalMaterial, which is linear light as in glTF.
glm::vec3 factor(const glm::dvec3& linear) {
    return glm::vec3(glm::clamp(linear, glm::dvec3(0), glm::dvec3(1)));
}

// Image of a PixelTexture, whose first row is the bottom.
std::shared_ptr<const SceneTexture> pixel_texture(const Node& node) {
    const std::vector<double>& numbers = node.field("image").numbers;
    const int width = static_cast<int>(numbers.at(0));
    const int height = static_cast<int>(numbers.at(1));
    const auto components = static_cast<std::size_t>(numbers.at(2));
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (pixels == 0 || components == 0) return nullptr;
    auto texture = std::make_shared<SceneTexture>();
    texture->image = Image<Rgba8>(width, height);
    texture->has_alpha = components == 2 || components == 4;
    texture->repeat_s = node.flag("repeatS");
    texture->repeat_t = node.flag("repeatT");
    texture->modulates = components <= 2;
    const double* next = numbers.data() + 3;
    for (int y = height - 1; y >= 0; --y) {
        for (int x = 0; x < width; ++x, ++next) {
            const auto packed = static_cast<std::uint32_t>(*next);
            const auto byte = [&](std::size_t i) {
                return static_cast<std::uint8_t>(packed >> 8 * (components - 1 - i));
            };
            const std::size_t colours = components <= 2 ? 0 : 1;
            const std::uint8_t alpha = texture->has_alpha ? byte(components - 1) : std::uint8_t{255};
            texture->image(x, y) = {byte(0), byte(colours), byte(2 * colours), alpha};
        }
    }
    return texture;
}

// ISO/IEC 14772-1, 6.49: Tc' = -C * S * R * C * T * Tc.
glm::mat3 texture_matrix(const Node& node) {
    const glm::dvec2 centre = node.pair("center");
    const glm::dvec2 scale = node.pair("scale");
    const double angle = node.number("rotation");
    const auto moved = [](const glm::dvec2& by) {
        glm::dmat3 m(1.0);
        m[2] = glm::dvec3(by, 1);
        return m;
    };
    glm::dmat3 scaled(1.0);
    scaled[0][0] = scale.x;
    scaled[1][1] = scale.y;
    glm::dmat3 turned(1.0);
    turned[0] = {std::cos(angle), std::sin(angle), 0};
    turned[1] = {-std::sin(angle), std::cos(angle), 0};
    return glm::mat3(moved(-centre) * scaled * turned * moved(centre) * moved(node.pair("translation")));
}

// Fields of X3D 4 that are read, but not drawn.
constexpr const char* kUnusedTextures[] = {"ambientTexture", "occlusionTexture", "shininessTexture", "specularTexture"};

class MaterialReader {
public:
    MaterialReader(const Node& appearance, const std::filesystem::path& folder, SceneImages& images,
                   const NodeWarning& warn)
        : appearance_(appearance), folder_(folder), images_(images), warn_(warn) {}

    // Without textures.
    const Material& read_colours(const Node& given) {
        material_ = {};
        if (given.type == "UnlitMaterial") {
            material_.lit = false;
            material_.diffuse = linear_colour(given.triple("emissiveColor"));
        } else if (given.type == "PhysicalMaterial") {
            read_physical(given);
        } else {
            material_.diffuse = linear_colour(given.triple("diffuseColor"));
            material_.specular = linear_colour(given.triple("specularColor"));
            material_.emissive = linear_colour(given.triple("emissiveColor"));
            material_.ambient = fraction(given.number("ambientIntensity"));
            material_.shininess = fraction(given.number("shininess"));
        }
        material_.opacity = 1 - fraction(given.number("transparency"));
        if (appearance_.node("backMaterial")) {
            warn_(appearance_, "backMaterial is not drawn; the back has the material of the front");
        }
        return material_;
    }

    // \param given may be null: white, unlit
    const Material& read(const Node* given) {
        material_.lit = false;
        material_.diffuse = glm::vec3(1);
        if (given != nullptr) read_colours(*given);
        const char* const own = given == nullptr                    ? nullptr
                                : given->type == "PhysicalMaterial" ? "baseTexture"
                                : given->type == "UnlitMaterial"    ? "emissiveTexture"
                                                                    : "diffuseTexture";
        NodePointer colours = own != nullptr ? given->node(own) : nullptr;
        // A texture of an X3D 4 material multiplies its colour, as in glTF; VRML97's replaces it.
        const bool multiplies = colours || (given != nullptr && given->type != "Material");
        if (!colours) colours = appearance_.node("texture");
        if (colours) material_.texture = texture_of(*colours);
        if (material_.texture && multiplies) {
            auto copy = std::make_shared<SceneTexture>(*material_.texture);
            copy->modulates = true;
            material_.texture = std::move(copy);
        }
        if (material_.texture && physical_) set_phong_colours(mean_linear_colour(material_.texture->image.pixels()));
        apply_alpha_mode();
        if (const NodePointer transform = appearance_.node("textureTransform")) {
            material_.texture_transform = texture_matrix(*transform);
        }
        if (given == nullptr) return material_;
        if (material_.lit) read_relief(*given);
        if (material_.lit && given->node("emissiveTexture")) read_emission(*given);
        for (const char* const field : kUnusedTextures) {
            if (given->has(field) && given->node(field)) warn_(*given, std::string(field) + " is not drawn; left out");
        }
        return material_;
    }

private:
    void read_physical(const Node& given) {
        MetallicRoughness& factors =
            physical_.emplace(MetallicRoughness{factor(given.triple("baseColor")), fraction(given.number("metallic")),
                                                fraction(given.number("roughness"))});
        material_.ambient = 1;
        material_.emissive = factor(given.triple("emissiveColor"));
        if (const NodePointer texture = given.node("metallicRoughnessTexture")) {
            if (const auto read = texture_of(*texture)) {
                const glm::vec3 mean = mean_of_codes(read->image.pixels());
                factors.roughness *= mean.g;
                factors.metallic *= mean.b;
            }
        }
        set_phong_colours(glm::vec3(1));
        material_.surface = surface_of(factors);
        material_.surface->emission = material_.emissive;
    }

    void set_phong_colours(const glm::vec3& mean_texture) {
        const PhongColours phong = phong_colours_of(*physical_, mean_texture);
        material_.diffuse = phong.diffuse;
        material_.specular = phong.specular;
        material_.shininess = phong.exponent / 128;
    }

    void read_relief(const Node& given) {
        const NodePointer texture = given.node("normalTexture");
        const auto read = texture ? texture_of(*texture) : nullptr;
        if (read) material_.normals = normal_map(*read, static_cast<float>(given.number("normalScale")));
    }

    void read_emission(const Node& given) {
        material_.emission_texture = texture_of(*given.node("emissiveTexture"));
        if (material_.emission_texture && !material_.surface) material_.surface = surface_of(material_);
    }

    // X3D 4, 12.4.1: AUTO blends if anything is transparent.
    void apply_alpha_mode() {
        const std::string& mode = appearance_.text("alphaMode");
        if (mode == "AUTO" || mode == "BLEND") return;
        if (mode != "OPAQUE" && mode != "MASK") {
            return warn_(appearance_, "alphaMode '" + mode.substr(0, 40) + "' is unknown; AUTO is used");
        }
        const double cutoff = appearance_.number("alphaCutoff") * 255 / static_cast<double>(material_.opacity);
        material_.opacity = 1;
        if (!material_.texture || !material_.texture->has_alpha) return;
        auto copy = std::make_shared<SceneTexture>(*material_.texture);
        copy->has_alpha = mode == "MASK";
        for (Rgba8& p : copy->image.pixels()) p.a = mode == "MASK" && p.a < cutoff ? 0 : 255;
        material_.texture = std::move(copy);
    }

    // Null if it cannot be read.
    std::shared_ptr<const SceneTexture> texture_of(const Node& node) {
        if (node.type == "PixelTexture") return pixel_texture(node);
        if (node.field("url").texts.empty()) return nullptr;
        std::string fault;
        auto texture =
            images_.read(node.field("url").texts, folder_, node.flag("repeatS"), node.flag("repeatT"), fault);
        if (!fault.empty()) warn_(node, fault + "; drawn without");
        return texture;
    }

    const Node& appearance_;
    const std::filesystem::path& folder_;
    SceneImages& images_;
    const NodeWarning& warn_;
    Material material_;
    std::optional<MetallicRoughness> physical_;  // with the mean of its texture
};

}  // namespace

glm::vec3 linear_colour(const glm::dvec3& srgb) {
    return {linear_from_srgb(fraction(srgb.r)), linear_from_srgb(fraction(srgb.g)), linear_from_srgb(fraction(srgb.b))};
}

Material material_of(const Node* appearance, Topology topology, const std::filesystem::path& folder,
                     SceneImages& images, const NodeWarning& warn) {
    Material material;
    material.lit = false;
    material.diffuse = glm::vec3(1);
    if (appearance == nullptr) return material;
    const NodePointer given = appearance->node("material");
    MaterialReader reader(*appearance, folder, images, warn);
    if (topology == Topology::kTriangles) return reader.read(given.get());
    // Lines and points are unlit: they have the emissive colour, or vertex colours.
    if (!given) return material;
    material = reader.read_colours(*given);
    if (material.lit) material.diffuse = material.emissive;
    material.lit = false;
    return material;
}

}  // namespace rs::compositor::vrml
