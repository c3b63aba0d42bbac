#pragma once
// PLY files, ascii or binary of either endianness, as what Assimp's own reader would give: one mesh with its material,
// still without triangulation and normals. That reader is not used: Assimp 5.2 trusts what it reads, and a body that is
// too short keeps it in an endless loop, a repeated element crashes it, and of a strip only the last triangle is kept.
//
// Source: G. Turk, "The PLY Polygon File Format", 1994.

#include "rayspace/base/result.hpp"

#include <assimp/scene.h>

#include <filesystem>
#include <memory>

namespace rs::capture {

// The vertices with their normals and texture coordinates, the faces of three corners and more (texcoord where it has
// two numbers per corner), the materials and the texture. Strips become triangles; -1 begins a strip anew. Everything
// is checked: what the header announces must be there (ply_header.hpp), every number must be one and fit its type,
// faces must name existing vertices. Errors name the file, the element and what is wrong.
Result<std::unique_ptr<aiScene>> read_ply_file(const std::filesystem::path& path);

}  // namespace rs::capture
