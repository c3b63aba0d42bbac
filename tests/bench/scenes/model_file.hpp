#pragma once
// Writes a model as glTF 2.0, with the lights and luminaires beside it.

#include "rayspace/base/result.hpp"
#include "tests/bench/scenes/model.hpp"

#include <filesystem>

namespace rs::synthetic {

// The folder OUTPUT with NAME.gltf, NAME.bin, lights.json, luminaires and images. What stands several times is stored
// once. What stands there is replaced only where it is such a folder (StagedFolder).
Status write_model(const Model& model, const std::filesystem::path& output, const std::string& name);

}  // namespace rs::synthetic
