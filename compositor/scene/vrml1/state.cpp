#include "compositor/scene/vrml1/state.hpp"

#include <utility>

namespace rs::compositor::vrml1 {

bool State::take(const TreePointer& node) {
    const std::pair<const char*, TreePointer State::*> kept[] = {
        {"Coordinate3", &State::coordinates},
        {"Normal", &State::normals},
        {"TextureCoordinate2", &State::texture_coordinates},
        {"Material", &State::material},
        {"MaterialBinding", &State::material_binding},
        {"NormalBinding", &State::normal_binding},
        {"ShapeHints", &State::hints},
        {"FontStyle", &State::font},
        {"Texture2", &State::texture},
        {"Texture2Transform", &State::texture_transform},
    };
    for (const auto& [type, member] : kept) {
        if (node->type != type) continue;
        this->*member = node;
        return true;
    }
    return false;
}

vrml::NodePointer make_node(vrml::GraphBuilder& builder, const char* type, int line, vrml::Fields fields,
                            const std::string& name) {
    auto node = std::make_shared<vrml::Node>();
    node->type = type;
    node->spec = vrml::find_node(type);
    node->name = name;
    node->line = line;
    node->fields = std::move(fields);
    for (const auto& [key, value] : node->fields) builder.count(value);
    return builder.finish_node(node, {});
}

Value numbers(std::vector<double> values) {
    Value value;
    value.numbers = std::move(values);
    return value;
}

Value words(std::string word) {
    Value value;
    value.texts.push_back(std::move(word));
    return value;
}

Value nodes(std::vector<vrml::NodePointer> list) {
    Value value;
    value.nodes = std::move(list);
    return value;
}

}  // namespace rs::compositor::vrml1
