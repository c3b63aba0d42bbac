#include "tests/bench/scenes/model_file.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

namespace rs::synthetic {
namespace {

using OrderedJson = nlohmann::ordered_json;

enum : int { kFloat = 5126, kUnsigned = 5125, kOfVertices = 34962, kOfIndices = 34963 };

OrderedJson matrix_of(const glm::mat4& m) {
    OrderedJson list = OrderedJson::array();
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) list.push_back(static_cast<double>(m[column][row]));
    }
    return list;
}

// Concatenated arrays of the file's buffer. All components have four bytes, so that no padding is needed.
class Buffer {
public:
    template <class T>
    int add(const std::vector<T>& values, const char* type, int component, int target) {
        const auto bytes = std::as_bytes(std::span(values));
        views_.push_back(
            {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}, {"target", target}});
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
        accessors_.push_back({{"bufferView", views_.size() - 1},
                              {"componentType", component},
                              {"count", bytes.size() / (std::string(type) == "SCALAR" ? 4 : sizeof(T))},
                              {"type", type}});
        return static_cast<int>(accessors_.size()) - 1;
    }
    int add_positions(const std::vector<glm::vec3>& positions) {
        const int index = add(positions, "VEC3", kFloat, kOfVertices);
        glm::vec3 low = positions.front(), high = low;
        for (const glm::vec3& p : positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        accessors_.back()["min"] = {low.x, low.y, low.z};
        accessors_.back()["max"] = {high.x, high.y, high.z};
        return index;
    }

    OrderedJson views_ = OrderedJson::array();
    OrderedJson accessors_ = OrderedJson::array();
    std::vector<std::byte> bytes_;
};

OrderedJson materials_of(const Model& model, const std::vector<std::string>& images) {
    OrderedJson materials = OrderedJson::array();
    for (const ModelMaterial& material : model.materials) {
        OrderedJson surface{{"baseColorFactor", {material.colour.r, material.colour.g, material.colour.b, 1.0}},
                            {"metallicFactor", 0},
                            {"roughnessFactor", material.roughness}};
        for (std::size_t i = 0; i < images.size(); ++i) {
            if (images[i] == material.image) surface["baseColorTexture"] = {{"index", i}};
        }
        materials.push_back({{"name", material.name}, {"pbrMetallicRoughness", surface}, {"doubleSided", true}});
    }
    return materials;
}

// World transform of a glTF camera, which looks along -Z.
glm::mat4 camera_matrix(const ModelView& view) {
    return glm::inverse(glm::lookAt(view.eye, view.at, glm::vec3(0, 1, 0)));
}

OrderedJson gltf_of(const Model& model, const std::string& name, Buffer& buffer) {
    std::vector<std::string> images;
    for (const auto& [file, image] : model.images) images.push_back(file);
    OrderedJson gltf{{"asset", {{"version", "2.0"}, {"generator", "rs-showroom"}}}, {"scene", 0}};
    OrderedJson meshes = OrderedJson::array();
    for (const ModelGroup& group : model.groups) {
        OrderedJson primitives = OrderedJson::array();
        for (const capture::Mesh& mesh : group.meshes) {
            OrderedJson attributes{{"POSITION", buffer.add_positions(mesh.positions)},
                                   {"NORMAL", buffer.add(mesh.normals, "VEC3", kFloat, kOfVertices)}};
            if (!model.materials[static_cast<std::size_t>(mesh.material)].image.empty()) {
                attributes["TEXCOORD_0"] = buffer.add(mesh.uvs, "VEC2", kFloat, kOfVertices);
            }
            const int indices = buffer.add(mesh.triangles, "SCALAR", kUnsigned, kOfIndices);
            primitives.push_back({{"attributes", attributes}, {"indices", indices}, {"material", mesh.material}});
        }
        meshes.push_back({{"name", group.name}, {"primitives", primitives}});
    }
    OrderedJson nodes = OrderedJson::array(), roots = OrderedJson::array(), cameras = OrderedJson::array();
    for (const ModelNode& node : model.nodes) {
        roots.push_back(nodes.size());
        nodes.push_back({{"mesh", node.group}, {"matrix", matrix_of(node.world_from_group)}});
    }
    for (const ModelView& view : model.views) {
        roots.push_back(nodes.size());
        nodes.push_back({{"name", view.name}, {"camera", cameras.size()}, {"matrix", matrix_of(camera_matrix(view))}});
        cameras.push_back({{"type", "perspective"}, {"perspective", {{"yfov", 0.85}, {"znear", 0.05}}}});
    }
    gltf["scenes"] = OrderedJson::array({{{"name", model.name}, {"nodes", roots}}});
    gltf["nodes"] = nodes;
    gltf["meshes"] = meshes;
    gltf["cameras"] = cameras;
    gltf["materials"] = materials_of(model, images);
    if (!images.empty()) {
        gltf["images"] = gltf["textures"] = OrderedJson::array();
        for (std::size_t i = 0; i < images.size(); ++i) {
            gltf["images"].push_back({{"uri", images[i]}});
            gltf["textures"].push_back({{"source", i}});
        }
    }
    gltf["buffers"] = OrderedJson::array({{{"uri", name + ".bin"}, {"byteLength", buffer.bytes_.size()}}});
    gltf["bufferViews"] = buffer.views_;
    gltf["accessors"] = buffer.accessors_;
    return gltf;
}

}  // namespace

Status write_model(const Model& model, const std::filesystem::path& output, const std::string& name, bool force) {
    RS_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(output, "parts of a model", force));
    const std::filesystem::path& folder = staged.temporary_path();
    Buffer buffer;
    const std::string text = gltf_of(model, name, buffer).dump(1) + "\n";
    RS_TRY(write_file(folder / (name + ".gltf"), text));
    RS_TRY(write_file(folder / (name + ".bin"), buffer.bytes_));
    RS_TRY(write_file(folder / "lights.json", model.lights));
    for (const auto& [file, ies] : model.luminaires) {
        RS_TRY(write_file(folder / file, ies));
    }
    for (const auto& [file, image] : model.images) {
        RS_TRY(write_png(folder / file, image));
    }
    return staged.commit();
}

}  // namespace rs::synthetic
