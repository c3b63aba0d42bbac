#pragma once
// Models split into the objects that instances refer to: an extended OBJ read by scene/model/model_file.hpp, its parts
// grouped by object.

#include "compositor/scene/scene.hpp"
#include "compositor/sequence/extended_obj.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rs::compositor {

struct ModelObject {
    std::string name;
    std::vector<GeometryNode> parts;  // as positioned in the file
    BoundingBox box;                  // bounds of the parts
};

struct NamedMaterial {
    std::string name;
    Material material;
};

struct Model {
    std::vector<ModelObject> objects;
    std::vector<NamedMaterial> materials;  // of the material libraries, in their order
    std::vector<std::string> warnings;

    /// Lookup by index or name; null if not found.
    [[nodiscard]] const ModelObject* object(const std::string& id) const;
    [[nodiscard]] const Material* material(const std::string& id) const;
};

/// Parses an index; nullopt if the word is not a number.
std::optional<std::size_t> parse_index(const std::string& word);

/// Reads the meshes of a parsed file. A missing material library is an error with its line. Thread-safe.
Result<Model> read_model_objects(const std::filesystem::path& path, const ExtendedObj& parsed);

/// Reads and parses a file.
Result<ExtendedObj> read_extended_obj(const std::filesystem::path& path);

}  // namespace rs::compositor
