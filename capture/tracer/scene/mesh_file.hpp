#pragma once
// Reads mesh files as scenes: Wavefront OBJ with MTL, PLY, glTF 2.0 and GLB, through Assimp.
//
// Materials become the nearest SurfaceKind. glTF: metallic >= 0.5 is metal, transmission >= 0.5 is glass, the rest
// glossy with the file's roughness and base colour; a metallicRoughnessTexture is replaced by its mean; the
// emissiveTexture is kept; alphaMode OPAQUE has no holes, MASK holes below alphaCutoff, BLEND below 0.5. MTL: illum 3
// or 5 without a diffuse colour is mirror, illum 4, 6, 7, 9 or d < 0.5 glass, Ks > 0 with illum >= 2 glossy (roughness
// from the exponent Ns), the rest diffuse; Ke is emission. Other formats: diffuse. Node transforms are applied;
// cameras, lights, animation, points and lines are left out. Vertices without normals get smooth ones, with creases
// where faces meet at more than 60 degrees.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>

namespace rs::capture {

/// Reads a mesh file without changing its coordinates. An OBJ file whose MTL file is missing becomes diffuse grey.
/// \return an error if the file is missing or malformed, has no faces or a vertex that is not finite, or if a texture
/// is missing
Result<Scene> read_mesh_file(const std::filesystem::path& path);

/// Returns true for the file name extensions above, in any letter case.
bool is_mesh_file(const std::filesystem::path& path);

Error missing_texture(const std::filesystem::path& path, const std::filesystem::path& referrer);

/// Reads an image file as a texture.
/// \param referrer the file that names it, for errors
Result<Texture> read_texture(const std::filesystem::path& path, const std::filesystem::path& referrer);

}  // namespace rs::capture
