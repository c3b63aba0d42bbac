#pragma once
// From a capture set to a ray-space object.

#include "encode/raymap/plane_map.hpp"
#include "encode/raymap/shape_map.hpp"
#include "encode/set/capture_set.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rs::encode {

enum class MapKind {
    kPlane,  // the paper's: the object is taken to lie on the reference planes, the nearest ray answers
    kShape,  // with a depth for every ray, found from the images; two neighbouring images are blended
};

// What `--raymap` calls them: "plane" and "shape".
std::string to_string(MapKind kind);
std::optional<MapKind> map_kind_from(const std::string& name);

// The plane map that goes with each kind: beside a shape map it answers only what the shape does not know, so it is
// coarser.
PlaneMapOptions usual_plane_map(MapKind kind);

struct BuildOptions {
    PlaneMapOptions map;
    std::string name;  // of the object; the set's folder name where empty
    MapKind raymap = MapKind::kShape;
    ShapeOptions shape = {};
    bool raw_images = true;  // else the object's images stay empty: encode/codec makes coded ones
};

struct BuiltObject {
    RaySpaceObject object;
    std::vector<std::string> warnings;  // one line each: what a user may change
    std::vector<FoundDepth> depths;     // of a few views, where there is a shape map
    CompletedImages completed;          // for CaptureSet::completed before encode_images()
};

// Memory: the stored images (2.5 bytes a pixel), the map (2 bytes a cell), and one decoded image per thread.
Result<BuiltObject> build_object(const CaptureSet& set, const BuildOptions& options, Progress* progress = nullptr);

// The stored images and their rig, as a capture set under `folder`: what the object knows, bit for bit.
Status extract_images(const RaySpaceObject& object, const std::filesystem::path& folder, Progress* progress = nullptr);

}  // namespace rs::encode
