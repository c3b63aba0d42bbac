#pragma once
// Writes a model as glTF 2.0, with the lights and luminaires beside it.

#include "rayspace/base/result.hpp"
#include "tests/bench/scenes/model.hpp"

#include <filesystem>

namespace rs::synthetic {

// The folder OUTPUT with NAME.gltf, NAME.bin, lights.json, luminaires and images. What stands several times is stored
// once. An existing folder is replaced as StagedFolder states.
Status write_model(const Model& model, const std::filesystem::path& output, const std::string& name,
                   bool force = false);

}  // namespace rs::synthetic
