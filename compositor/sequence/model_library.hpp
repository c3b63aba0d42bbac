#pragma once
// Models taken apart into the objects that instances name: an extended OBJ read by scene/model/model_file.hpp, its
// parts gathered by object.

#include "compositor/scene/scene.hpp"
#include "compositor/sequence/extended_obj.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rs::compositor {

struct ModelObject {
    std::string name;
    std::vector<GeometryNode> parts;  // as they stand in the file
    BoundingBox box;                  // of them
};

struct NamedMaterial {
    std::string name;
    Material material;
};

struct Model {
    std::vector<ModelObject> objects;
    std::vector<NamedMaterial> materials;  // of the libraries, in their order
    std::vector<std::string> warnings;

    // By number or by name; null where there is none.
    [[nodiscard]] const ModelObject* object(const std::string& id) const;
    [[nodiscard]] const Material* material(const std::string& id) const;
};

// The number that a word is; nothing where it is none.
std::optional<std::size_t> number_of(const std::string& word);

// The mesh of a file that has been parsed; a material library that is not there is an error with its line. Thread-safe.
Result<Model> read_model_objects(const std::filesystem::path& path, const ExtendedObj& parsed);

// A file's text, parsed.
Result<ExtendedObj> read_extended_obj(const std::filesystem::path& path);

}  // namespace rs::compositor
