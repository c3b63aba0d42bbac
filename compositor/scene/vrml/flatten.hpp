#pragma once
// Flattens the graph of a VRML file to draw lists. Private to the VRML reader.

#include "compositor/scene/scene.hpp"
#include "compositor/scene/scene_images.hpp"
#include "compositor/scene/vrml/graph.hpp"
#include "compositor/scene/vrml/traversal_state.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>

namespace rs::compositor::vrml {

/// File with its parsed graph.
struct LoadedFile {
    std::filesystem::path path;
    Graph graph;
};
/// Reads the first readable URL, relative to `folder`.
using Loader = std::function<Result<std::shared_ptr<const LoadedFile>>(const std::vector<std::string>& urls,
                                                                       const std::filesystem::path& folder)>;

/// Traverses the graph of `file` and of included files, and appends to a scene without geometry, lights and objects.
/// Unsupported parts become warnings. Fails if USE, PROTO and Inline expand to more than kMaxVisits nodes. Of several
/// Backgrounds, Fogs and NavigationInfos of the file itself the first is used; its viewpoints precede those of included
/// files. Not thread-safe.
Status flatten(const std::shared_ptr<const LoadedFile>& file, const Loader& load, Scene& scene);

}  // namespace rs::compositor::vrml
