#pragma once
// PLY files in the one form that Assimp reads without surprises. Assimp 5.2 trusts what it reads: a body that is too
// short keeps it in an endless loop, a repeated element crashes it, a comment that begins with "vertex" counts as an
// element, binary bodies with elements that it does not know come out shifted, of a strip only the last triangle is
// kept, a binary body loses its first byte where that is a line feed. So the file is read and checked here, and written
// anew for Assimp, which adds materials, triangulation and normals.
//
// Source: G. Turk, "The PLY Polygon File Format", 1994.

#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>

namespace rs::capture {

// The bytes of a binary PLY file with the vertices' numbers, faces (vertex_indices, and texcoord where it has two
// numbers per vertex), materials and texture names of `path`, ascii or binary of either endianness. Strips become
// triangles. Everything is checked: what the header announces must be there (ply_header.hpp), every number must be one
// and fit its type, faces must name existing vertices; -1 begins a strip anew. Errors name the file and what is wrong.
Result<std::string> read_plain_ply(const std::filesystem::path& path);

}  // namespace rs::capture
