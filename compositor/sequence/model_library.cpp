#include "compositor/sequence/model_library.hpp"

#include "compositor/scene/model/model_file.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_output.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <string_view>
#include <utility>

namespace rs::compositor {
namespace {

// Lookup by index if `id` is a number, else by name.
template <class Named>
const Named* find_named(const std::vector<Named>& all, const std::string& id) {
    if (const auto number = parse_index(id)) return *number < all.size() ? &all[*number] : nullptr;
    const auto found = std::find_if(all.begin(), all.end(), [&](const Named& one) { return one.name == id; });
    return found == all.end() ? nullptr : &*found;
}

}  // namespace

std::optional<std::size_t> parse_index(const std::string& word) {
    std::size_t value = 0;
    const auto end = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end.ec != std::errc() || end.ptr != word.data() + word.size()) return std::nullopt;
    return value;
}

const ModelObject* Model::object(const std::string& id) const {
    return find_named(objects, id);
}

const Material* Model::material(const std::string& id) const {
    const NamedMaterial* const found = find_named(materials, id);
    return found == nullptr ? nullptr : &found->material;
}

Result<ExtendedObj> read_extended_obj(const std::filesystem::path& path) {
    RS_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, read_file(path, kMaxExtendedObj_bytes));
    return parse_extended_obj({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path.string());
}

Result<Model> read_model_objects(const std::filesystem::path& path, const ExtendedObj& parsed) {
    for (const NamedLine& library : parsed.libraries) {
        std::error_code error;
        if (std::filesystem::is_regular_file(path.parent_path() / library.name, error)) continue;
        return Error{printable(path.string() + ":" + std::to_string(library.line) + ": the material library '" +
                               library.name + "' is not next to the file; put it there or remove the line")};
    }
    RS_ASSIGN_OR_RETURN(ModelParts parts, read_model_parts(path));
    Model model;
    model.warnings = std::move(parts.scene.warnings);
    // The first material is Assimp's default.
    for (std::size_t i = 1; i < parts.materials.size(); ++i) {
        model.materials.push_back({parts.materials[i].name, parts.materials[i].material});
    }
    std::map<std::string_view, std::size_t> object_of_node;
    for (const ObjObject& object : parsed.objects) {
        for (const std::string& node : object.nodes) object_of_node.emplace(node, model.objects.size());
        model.objects.push_back({object.name, {}, {}});
    }
    for (std::size_t i = 0; i < parts.scene.geometry.size(); ++i) {
        const auto owner = object_of_node.find(parts.nodes[i]);
        if (owner == object_of_node.end()) {
            return Error{printable(path.string() + ": the object '" + parts.nodes[i] +
                                   "' has no `o` or `g` line; export the file again")};
        }
        ModelObject& object = model.objects[owner->second];
        GeometryNode& part = parts.scene.geometry[i];
        const BoundingBox box = bounds_of(*part.mesh).moved(part.world_from_node);
        if (!box.empty()) {
            object.box.include(box.lowest);
            object.box.include(box.highest);
        }
        object.parts.push_back(std::move(part));
    }
    return model;
}

}  // namespace rs::compositor
