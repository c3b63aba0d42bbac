#pragma once
// Exports a scene as binary glTF 2.0 (GLB): triangles, lines and points with their materials, lights as
// KHR_lights_punctual, viewpoints as cameras, and ray-space objects as nodes with `extras` that model/gltf_nodes.hpp
// reads. Parts that glTF lacks are approximated or omitted, each with a warning.
//
// For pages of rs-view, extras hold what else the scene states:
//   scene   RaySpaceScene {background {sky, skyAngles, ground, groundAngles}, fog {kind, colour, visibility},
//           navigation {types, speed, headlight, eyeHeight}}; colours are linear light
//   light   RaySpaceLight {ambient, everywhere, castsShadows, leastAttenuation}: its ambient part; `everywhere` is
//           false if it lights only nodes that list it; near surfaces get at most intensity / leastAttenuation
//   node    RaySpaceLights [...]: indices of such lights
//   material  RaySpaceMaterial {matt}: true if it has no highlights

#include "compositor/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace rs::compositor {

struct GltfFile {
    std::vector<std::byte> bytes;
    std::vector<std::string> warnings;  // "PART: what differs"
};

/// \param url_of address that the file states for an .rso file
/// \return error if an image cannot be encoded, or if the file would exceed 4 GiB
Result<GltfFile> export_gltf(const Scene& scene,
                             const std::function<std::string(const std::filesystem::path&)>& url_of);

/// Percent-encodes a relative path for a URL.
std::string url_of_path(const std::filesystem::path& relative);

}  // namespace rs::compositor
