#include "compositor/scene/vrml/appearance.hpp"

#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace rs::compositor::vrml {
namespace {

float fraction(double number) {
    return static_cast<float>(std::clamp(number, 0.0, 1.0));
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

}  // namespace

glm::vec3 linear_colour(const glm::dvec3& srgb) {
    return {linear_from_srgb(fraction(srgb.r)), linear_from_srgb(fraction(srgb.g)), linear_from_srgb(fraction(srgb.b))};
}

Material material_of(const Node* appearance, const Mesh& mesh, const std::filesystem::path& folder, SceneImages& images,
                     std::string& fault) {
    fault.clear();
    Material material;
    const NodePointer given = appearance != nullptr ? appearance->node("material") : nullptr;
    if (given) {
        material.diffuse = linear_colour(given->triple("diffuseColor"));
        material.specular = linear_colour(given->triple("specularColor"));
        material.emissive = linear_colour(given->triple("emissiveColor"));
        material.ambient = fraction(given->number("ambientIntensity"));
        material.shininess = fraction(given->number("shininess"));
        material.opacity = 1 - fraction(given->number("transparency"));
    } else {
        material.lit = false;
        material.diffuse = glm::vec3(1);
    }
    if (mesh.topology != Topology::kTriangles) {
        // Lines and points are unlit: they have the emissive colour, or vertex colours.
        if (given) material.diffuse = material.emissive;
        material.lit = false;
        return material;
    }
    if (appearance == nullptr) return material;
    if (const NodePointer texture = appearance->node("texture")) {
        if (texture->type == "PixelTexture") {
            material.texture = pixel_texture(*texture);
        } else if (!texture->field("url").texts.empty()) {
            material.texture = images.read(texture->field("url").texts, folder, texture->flag("repeatS"),
                                           texture->flag("repeatT"), fault);
        }
    }
    if (const NodePointer transform = appearance->node("textureTransform")) {
        material.texture_transform = texture_matrix(*transform);
    }
    return material;
}

}  // namespace rs::compositor::vrml
