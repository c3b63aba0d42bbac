#pragma once
// Rewrites material libraries (MTL) of other programs so that Assimp reads them. Pure; thread-safe.

#include <glm/glm.hpp>

#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>

namespace rs {

/// Texture coordinates of a material's colour texture: scale * uv + offset ("-s", "-o").
struct TexturePlacement {
    glm::vec2 scale{1};
    glm::vec2 offset{0};
};

struct MtlText {
    std::string text;
    std::map<std::string, TexturePlacement> placements;  // by material, where not the identity
    std::set<std::string> materials;                     // names
};

/// Keywords of MTL that are read.
std::span<const std::string_view> mtl_keywords();

/// Statements before the first newmtl are removed, since they crash Assimp, and leading spaces, which hide statements
/// from it. Keywords get their usual letter case ("MAP_KD"), options behind a file name move in front of it, "-s" and
/// "-o" of colour textures become `placements`, and "-texres" is removed. "Tr 1" of materials that are not transparent
/// by their illumination model is removed: some exporters write it for opaque materials.
MtlText rewrite_mtl(std::string_view text);

}  // namespace rs
