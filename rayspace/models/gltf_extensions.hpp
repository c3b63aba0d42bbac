#pragma once
// Extensions of glTF 2.0 files: refuses required ones that are not supported, reports optional ones and animations,
// skins and morph targets, which are ignored, and rewrites those that Assimp does not know. Thread-safe.

#include "rayspace/base/result.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rs {

/// JSON text of a .gltf, or of a .glb's JSON chunk (glTF 2.0, 4.4), without a byte order mark.
/// \return an error if the .glb is damaged
Result<std::string> gltf_json(std::string_view bytes, const std::string& file);

/// Names of the extensions that prepare_gltf() accepts without a warning.
std::span<const std::string_view> supported_gltf_extensions();
/// Keys of glTF 2.0 for which prepare_gltf() warns.
std::vector<std::string> ignored_gltf_contents();

struct GltfFile {
    std::vector<std::byte> bytes;
    std::vector<std::string> warnings;
};

/// \param bytes contents of a .gltf or .glb
/// \return the file with the sources of EXT_texture_webp as ordinary sources; an error that names a required extension
/// that is not supported
Result<GltfFile> prepare_gltf(std::vector<std::byte> bytes, const std::string& file);

}  // namespace rs
