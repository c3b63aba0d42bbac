#pragma once
// Writes a scene as a web page with the custom element <ray-space-scene> (docs/web.md). Functions return warnings about
// parts that the page lacks.

#include "compositor/scene/scene.hpp"
#include "compositor/web/page/page.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rs::web {

/// Writes one HTML file that contains the scene, its objects, script and module, and needs neither server nor network.
/// \param options the title must not be empty
/// \return error if a required object or an image cannot be read
Result<std::vector<std::string>> write_scene_page(const compositor::Scene& scene, const std::filesystem::path& html,
                                                  const PageOptions& options);

/// Writes a folder for a web server: index.html, scene.glb, scene.js, ray-space.wasm, and the objects.
Result<std::vector<std::string>> write_scene_site(const compositor::Scene& scene, const std::filesystem::path& folder,
                                                  const PageOptions& options, bool force);

}  // namespace rs::web
