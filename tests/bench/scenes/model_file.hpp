#pragma once
// Writes a model as glTF 2.0, with the lights and luminaires beside it.

#include "rayspace/base/result.hpp"
#include "tests/bench/scenes/model.hpp"

#include <filesystem>

namespace rs::synthetic {

/// Writes the folder `output` with NAME.gltf, NAME.bin, lights.json, luminaires and images. Groups are stored once,
/// however many instances they have. An existing folder is replaced under the conditions of StagedFolder.
Status write_model(const Model& model, const std::filesystem::path& output, const std::string& name,
                   bool force = false);

}  // namespace rs::synthetic
