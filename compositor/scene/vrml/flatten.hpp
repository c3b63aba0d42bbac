#pragma once
// The graph of a VRML file -> draw lists. Private to the VRML reader.

#include "compositor/scene/scene.hpp"
#include "compositor/scene/scene_images.hpp"
#include "compositor/scene/vrml/graph.hpp"
#include "compositor/scene/vrml/place.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>

namespace rs::compositor::vrml {

// A file whose graph has been read.
struct LoadedFile {
    std::filesystem::path path;
    Graph graph;
};
// Reads the first of the URLs that can be read, relative to `folder`.
using Loader = std::function<Result<std::shared_ptr<const LoadedFile>>(const std::vector<std::string>& urls,
                                                                       const std::filesystem::path& folder)>;

// Walks the graph of `file` and of the files that it includes, and appends to a scene without geometry, lights and
// objects. What cannot be shown goes to the scene's warnings. Fails where USE, PROTO and Inline unfold to more than
// kMaxVisits nodes. The first of several Backgrounds, Fogs and NavigationInfos of the file itself counts; its
// viewpoints come before those of files that it includes. Not thread-safe.
Status flatten(const std::shared_ptr<const LoadedFile>& file, const Loader& load, Scene& scene);

}  // namespace rs::compositor::vrml
