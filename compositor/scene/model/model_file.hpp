#pragma once
// Scenes from glTF 2.0 (.gltf, .glb) and OBJ files, through Assimp.
//
// A glTF node stands for an object made of images where its `extras` state it:
//
//     "extras": {"RaySpace": {"url": "vase.rso", "size": 1, "standing": true, "description": "..."}}
//
// with the fields of VRML's RaySpace node (reader/vrml_file.hpp); all but `url` may be left out. Likewise a room, to
// which the objects below the node belong:
//
//     "extras": {"RaySpaceRoom": {"centre": [0, 1.5, 0], "size": [6, 3, 6], "description": "..."}}

#include "compositor/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>

namespace rs::compositor {

// Metallic and rough surfaces become diffuse and specular ones; embedded and separate images are read. A file without
// lights gets a headlight. What cannot be shown becomes a warning of the scene. Files beyond 64 MiB are refused. May be
// called from any thread.
Result<Scene> read_model(const std::filesystem::path& path);

// What a model's file calls its parts, for taking it apart.
struct ModelParts {
    Scene scene;
    // [geometry node of the scene]: of the node that it hangs on; in an OBJ its `o`, or `g` where that came after it.
    std::vector<std::string> nodes;
    struct Named {
        std::string name;
        Material material;
    };
    std::vector<Named> materials;  // in the file's order, those of an OBJ's libraries behind one of Assimp's own
};
Result<ModelParts> read_model_parts(const std::filesystem::path& path);

}  // namespace rs::compositor
