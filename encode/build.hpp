#pragma once
// Builds a ray-space object from a capture set.

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
    kPlane,  // as in the paper: the object is assumed to lie on the reference planes; the nearest ray is shown
    kShape,  // with a depth for every ray, estimated from the photos; two neighbouring photos are blended
};

/// The names used by `--raymap`: "plane" and "shape".
std::string to_string(MapKind kind);
std::optional<MapKind> parse_map_kind(const std::string& name);

/// The default plane map of each kind. Beside a shape map it is coarser, since it only fills the rays without a
/// surface.
PlaneMapOptions default_plane_map(MapKind kind);

struct BuildOptions {
    PlaneMapOptions map;
    std::string name;  // object name; if empty, the name of the set's folder
    MapKind raymap = MapKind::kShape;
    ShapeOptions shape = {};
    bool raw_images = true;  // false: the object's images stay empty, for encode/codec to add coded ones
};

struct BuiltObject {
    RaySpaceObject object;
    std::vector<std::string> warnings;  // one line each, with a remedy
    std::vector<DepthPreview> depths;   // of a few views, if there is a shape map
    CompletedImages completed;          // to be assigned to CaptureSet::completed before encode_images()
};

/// Builds the object of a set of rings (with_rings() makes one of a posed set). Memory: the stored images (2.5 bytes
/// per pixel), the map (2 bytes per cell), and one decoded image per thread.
Result<BuiltObject> build_object(const CaptureSet& set, const BuildOptions& options, Progress* progress = nullptr);

/// Writes the stored images and their rig as a capture set to `folder`, without loss. `force` is that of StagedFolder.
Status extract_images(const RaySpaceObject& object, const std::filesystem::path& folder, Progress* progress = nullptr,
                      bool force = false);

}  // namespace rs::encode
