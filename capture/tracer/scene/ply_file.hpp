#pragma once
// Reads PLY files, ascii or binary of either endianness, with the result of Assimp's reader: one mesh with its
// material, before triangulation and generation of normals. Assimp 5.2's own reader does not validate its input: a
// truncated body causes an endless loop, a repeated element crashes it, and only the last triangle of a strip is kept.
//
// Source: G. Turk, "The PLY Polygon File Format", 1994.

#include "rayspace/base/result.hpp"

#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <filesystem>
#include <memory>

namespace rs::capture {

enum class PlyUse {
    kCapture,  // meshes only
    // Also files without faces: each vertex is a face of one corner. Without a material it is diffuse.
    kDisplay
};

/// Reads the vertices with normals, texture coordinates and colours (sRGB in the file; converted to linear light), the
/// faces of three and more corners (with texcoord if it has two numbers per corner), the materials and the texture.
/// Strips become triangles; -1 restarts a strip. \return an error with file and element if the header is invalid
/// (ply_header.hpp), the body is truncated, a number is malformed or does not fit its type, or a face names a missing
/// vertex
Result<std::unique_ptr<aiScene>> read_ply_file(const std::filesystem::path& path, PlyUse use = PlyUse::kCapture);

/// Makes the scene that of the importer, as if it had read it, for post-processing.
void pass_to_importer(std::unique_ptr<aiScene> ply, Assimp::Importer& importer);

}  // namespace rs::capture
