#pragma once
// Mesh files as scenes: Wavefront OBJ with MTL, PLY, glTF 2.0 and GLB, through Assimp.
//
// Materials become the nearest SurfaceKind. glTF: metallic >= 0.5 is metal, transmission >= 0.5 is glass, the rest
// glossy with the file's roughness and base colour; of a metallicRoughnessTexture the mean counts; the emissiveTexture
// is kept; alphaMode OPAQUE has no holes, MASK those of its alphaCutoff, BLEND those of alpha below 0.5. MTL: illum 3
// or 5 without a diffuse colour is mirror, illum 4, 6, 7, 9 or d < 0.5 glass, Ks > 0 with illum >= 2 glossy (roughness
// from the exponent Ns), the rest diffuse; Ke is emission. Other formats: diffuse. Node transforms are applied;
// cameras, lights, animation, points and lines are left out. Vertices without normals get smooth ones, with creases
// where faces meet at more than 60 degrees.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>

namespace rs::capture {

// Positions are the file's own. Errors: the file is missing or not understood, it has no faces, a vertex is not finite,
// a texture is missing (the message names the texture and the file that names it). An OBJ file whose MTL file is
// missing is read without it, as diffuse grey.
Result<Scene> read_mesh_file(const std::filesystem::path& path);

// True for the name endings above, in any letter case.
bool is_mesh_file(const std::filesystem::path& path);

Error missing_texture(const std::filesystem::path& path, const std::filesystem::path& asked_by);

// An image file as a texture; `asked_by` is the file that names it.
Result<Texture> read_texture(const std::filesystem::path& path, const std::filesystem::path& asked_by);

}  // namespace rs::capture
