#pragma once
// A rig: the cameras of a capture set, read from and written to `transforms.json` of NeRF tools.
//
// A capture set is a folder with RGBA images (sRGB, straight alpha) and one transforms.json. Common keys: w h fl_x fl_y
// cx cy (global, or per frame), camera_angle_x (if fl_x is absent), frames[].file_path and frames[].transform_matrix.
// Additional keys of this project: object_radius (the radius about Y of a cylinder that contains the object, in the
// rig's units), foot_height (Y of the ground below the object, in the rig's units), axis_note, depth_file_path per
// frame. Unknown keys survive a round trip.

#include "rayspace/api/types/ray_space_object.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rs {

struct RigView {
    std::string file_path;        // relative to the transforms.json, '/' as separator; may lack its extension (.png)
    std::string depth_file_path;  // ground-truth axial depth as EXR channel "Z"; empty if there is none
    Camera camera;
    nlohmann::json extras = nlohmann::json::object();  // unknown keys of the frame
};

struct Rig {
    std::vector<RigView> views;
    double object_radius = 0;                          // 0: unknown
    std::optional<double> foot_height;                 // nullopt: unknown
    nlohmann::json extras = nlohmann::json::object();  // unknown top-level keys
};

inline constexpr const char* kRigFileName = "transforms.json";

/// The transforms.json of a folder; other paths unchanged.
std::filesystem::path rig_file(const std::filesystem::path& path);

/// Reads a rig. Every matrix must be a rigid transform (within 1e-3; scaled rotations are rejected), every size within
/// the limits of conventions.hpp. A rig without image sizes (no w, h) takes them from the first image's header. Lens
/// distortion (k1, k2, p1, ...) and other unsupported camera keys stay in `extras`, which callers must check.
/// \param path  a transforms.json or its folder.
Result<Rig> read_rig(const std::filesystem::path& path);

/// Writes a rig. Intrinsics shared by all views are written once at the top, as NeRF tools expect, otherwise per frame.
Status write_rig(const std::filesystem::path& transforms_json, const Rig& rig);

/// Conversion from and to JSON text; `where` names the source in errors. Doubles are preserved exactly. rig_from_json()
/// reads no images: w and h are required.
Result<Rig> rig_from_json(const std::string& text, const std::string& where);
std::string rig_to_json(const Rig& rig);

/// The path of a view's image: file_path under `folder`, or with ".png" added, resolved as file_reference.hpp says. If
/// none exists, ".png" is added if it has no extension.
std::filesystem::path image_path(const std::filesystem::path& folder, const RigView& view);

/// Options of a ring of cameras about Y, directed at the target (0, look_at_height, 0) from `distance`, `elevation_rad`
/// above the target's horizontal plane (|elevation_rad| < pi/2). The first camera is on +Z and the next ones turn
/// towards +X by 2*pi/count each, as on a turntable turning the other way. `first_rad` rotates the whole ring. Images
/// are named images/0000.png and so on. count 1..kMaxViews, distance and fl_px > 0.
struct RingOptions {
    int count = 90;
    double distance = 3.5;
    double elevation_rad = 0;
    double look_at_height = 0;
    double fl_px = 0;
    int width = 512;
    int height = 512;
    double first_rad = 0;
};
Rig make_ring(const RingOptions& options);

/// Views of a rig that form a ring about the Y axis of the ring's axes.
struct ViewRing {
    double elevation_rad = 0;  // mean, above the plane y = 0 of the ring's axes
    std::vector<int> views;    // in turning order, from +Z towards +X
    RingRotation rotation;     // from the rig's axes to the ring's
};

/// Sorts views by the elevation of their centres; a gap of more than 5 degrees starts a new ring.
std::vector<ViewRing> find_rings(const Rig& rig);

}  // namespace rs
