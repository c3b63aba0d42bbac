#pragma once
// Reader of glTF 2.0 (.gltf, .glb) and OBJ files, through Assimp, and of PLY files (capture/tracer/scene/ply_file.hpp).
//
// A glTF node represents an image-based object if its `extras` contain
//
//     "extras": {"RaySpace": {"url": "vase.rso", "size": 1, "standing": true, "description": "..."}}
//
// with the fields of VRML's RaySpace node (reader/vrml_file.hpp); only `url` is required. Similarly a room, which
// contains the objects below the node:
//
//     "extras": {"RaySpaceRoom": {"centre": [0, 1.5, 0], "size": [6, 3, 6], "description": "..."}}

#include "compositor/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>

namespace rs::compositor {

/// Metallic-roughness materials become diffuse and specular ones; embedded and external images are read. Files without
/// lights get a headlight. PLY files have the colours of their vertices, and are points if they have no faces.
/// Unsupported parts become warnings of the scene. Files beyond 64 MiB are rejected. Thread-safe.
Result<Scene> read_model(const std::filesystem::path& path);

/// Model with the names of its parts.
struct ModelParts {
    Scene scene;
    /// [geometry node of the scene]: name of its node; in an OBJ its `o`, or the `g` after it.
    std::vector<std::string> nodes;
    struct Named {
        std::string name;
        Material material;
    };
    std::vector<Named> materials;  // in the file's order; those of an OBJ's libraries follow a default of Assimp
};
Result<ModelParts> read_model_parts(const std::filesystem::path& path);

}  // namespace rs::compositor
