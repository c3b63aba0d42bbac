#pragma once
// From a capture set to a ray-space object.

#include "encode/capture_set.hpp"
#include "encode/raymap/plane_map.hpp"
#include "rayspace/progress.hpp"
#include "rayspace/ray_space_object.hpp"
#include "rayspace/result.hpp"

#include <string>
#include <vector>

namespace rs::encode {

struct BuildOptions {
    PlaneMapOptions map;
    std::string name;  // of the object; the set's folder name where empty
};

struct BuiltObject {
    RaySpaceObject object;
    std::vector<std::string> warnings;  // one line each: what a user may want to change
};

// Memory: the stored pictures (2.5 bytes a pixel), the map (2 bytes a cell), and one decoded picture per thread.
Result<BuiltObject> build_object(const CaptureSet& set, const BuildOptions& options, Progress* progress = nullptr);

// The stored pictures and their rig, as a capture set under `folder`: what the object knows, bit for bit.
Status extract_pictures(const RaySpaceObject& object, const std::filesystem::path& folder,
                        Progress* progress = nullptr);

}  // namespace rs::encode
