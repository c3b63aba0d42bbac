#pragma once
// Whether a PLY file is complete and consistent. Assimp reads PLY by trusting it: a header without an end or a body
// that is too short keeps Assimp 5.2 in an endless loop, so only files that pass here are handed on.
//
// Source: G. Turk, "The PLY Polygon File Format", 1994.

#include "rayspace/result.hpp"

#include <filesystem>

namespace rs::capture {

// Walks the whole file, ascii or binary of either endianness: every element that the header announces must be there,
// every number must be one, every face must name existing vertices. Errors name the file and what is wrong.
Status check_ply_file(const std::filesystem::path& path);

}  // namespace rs::capture
