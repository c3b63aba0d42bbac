// Appearance, Material and texture nodes of VRML 1.0 shapes in their state.

#include "compositor/scene/vrml1/state.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::compositor::vrml1 {

using vrml::Fields;
using vrml::NodePointer;

namespace {

const Tree& default_material() {
    static const Tree kDefault{.type = "Material", .kind = find_kind("Material")};
    return kDefault;
}

// Value number `part` of a list of colours or numbers, clamped to the last.
std::vector<double> value_at(const Tree& material, const char* field, std::size_t part, std::size_t each) {
    const std::vector<double>& all = material.field(field).numbers;
    if (all.size() < each) return material.kind->fields.find(field)->second.initial.numbers;
    const std::size_t at = std::min(part, all.size() / each - 1) * each;
    return {all.begin() + static_cast<std::ptrdiff_t>(at), all.begin() + static_cast<std::ptrdiff_t>(at + each)};
}

bool is_black(const std::vector<double>& colour) {
    return std::all_of(colour.begin(), colour.end(), [](double c) { return c <= 0; });
}

}  // namespace

NodePointer ShapeBuilder::material_of(const TreePointer& material, bool lines, std::size_t part, int line) {
    const Tree& from = material ? *material : default_material();
    const auto colour = [&](const char* field) { return value_at(from, field, part, 3); };
    Fields fields{{"diffuseColor", numbers(colour("diffuseColor"))},
                  {"specularColor", numbers(colour("specularColor"))},
                  {"emissiveColor", numbers(colour("emissiveColor"))},
                  {"shininess", numbers(value_at(from, "shininess", part, 1))},
                  {"transparency", numbers(value_at(from, "transparency", part, 1))}};
    if (lines && is_black(colour("emissiveColor"))) fields["emissiveColor"] = fields["diffuseColor"];
    return make_node(builder_, "Material", line, std::move(fields));
}

NodePointer ShapeBuilder::texture_of(const State& state) {
    const Tree& texture = *state.texture;
    Fields fields{{"repeatS", numbers({texture.text("wrapS") == "CLAMP" ? 0.0 : 1.0})},
                  {"repeatT", numbers({texture.text("wrapT") == "CLAMP" ? 0.0 : 1.0})}};
    if (!texture.text("filename").empty()) {
        fields["url"] = words(texture.text("filename"));
        return make_node(builder_, "ImageTexture", texture.line, std::move(fields));
    }
    if (texture.field("image").numbers.size() < 4) return nullptr;
    fields["image"] = texture.field("image");
    return make_node(builder_, "PixelTexture", texture.line, std::move(fields));
}

// VRML 1.0 scales about the centre, rotates and translates; VRML97 translates, rotates and scales about the negative
// centre. Rotated non-uniform scales have no equivalent: the order of rotation and scale is then lost.
NodePointer ShapeBuilder::texture_transform_of(const Tree& from) {
    const auto pair = [&](const char* field) {
        const std::vector<double>& n = from.field(field).numbers;
        return glm::dvec2(n.at(0), n.at(1));
    };
    const double angle = from.number("rotation");
    const glm::dvec2 scale = pair("scaleFactor");
    const glm::dvec2 by = pair("translation");
    const glm::dvec2 turned(std::cos(angle) * by.x + std::sin(angle) * by.y,
                            std::cos(angle) * by.y - std::sin(angle) * by.x);
    const auto divided = [](double a, double b) { return b != 0 ? a / b : 0.0; };
    return make_node(builder_, "TextureTransform", from.line,
                     {{"translation", numbers({divided(turned.x, scale.x), divided(turned.y, scale.y)})},
                      {"rotation", from.field("rotation")},
                      {"scale", from.field("scaleFactor")},
                      {"center", numbers({-pair("center").x, -pair("center").y})}});
}

NodePointer ShapeBuilder::appearance_of(const State& state, bool lines, std::size_t part, bool coloured) {
    NodePointer& known = appearances_[{state.material, state.texture, state.texture_transform, lines, part, coloured}];
    if (known) return known;
    const int line = state.material ? state.material->line : 0;
    Fields fields;
    // Emissive colours per corner are represented as a surface without material.
    const bool of_itself = coloured && state.material->field("diffuseColor").numbers.size() <= 3;
    if (!of_itself) fields["material"] = nodes({material_of(state.material, lines, part, line)});
    if (state.texture && !lines) {
        if (const NodePointer texture = texture_of(state)) {
            fields["texture"] = nodes({texture});
            if (state.texture_transform) {
                fields["textureTransform"] = nodes({texture_transform_of(*state.texture_transform)});
            }
        }
    }
    known = make_node(builder_, "Appearance", line, std::move(fields));
    return known;
}

}  // namespace rs::compositor::vrml1
