#pragma once
// A rig: the cameras of a capture set, in and out of `transforms.json` as NeRF tools read and write it.
//
// A capture set is a folder: RGBA images (sRGB, straight alpha) and one transforms.json. Common keys: w h fl_x fl_y
// cx cy (of all frames, or of one frame where it carries its own), camera_angle_x (where fl_x is absent), frames[].
// file_path and frames[].transform_matrix. Our own keys: object_radius (the radius about Y that holds the object, in
// the rig's units), foot_height (Y of the ground that the object stands on, in the rig's units), axis_note,
// depth_file_path per frame. Keys we do not know survive a round trip.

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
    std::string depth_file_path;  // true axial depth as EXR channel "Z"; empty where there is none
    Camera camera;
    nlohmann::json extras = nlohmann::json::object();  // keys of the frame that we do not know
};

struct Rig {
    std::vector<RigView> views;
    double object_radius = 0;                          // 0 = not known
    std::optional<double> foot_height;                 // where it is known
    nlohmann::json extras = nlohmann::json::object();  // top-level keys that we do not know
};

inline constexpr const char* kRigFileName = "transforms.json";

// `path` is a transforms.json or a folder that holds one. Every matrix is checked for being a rigid transform (within
// 1e-3; scaled rotations are refused), every size against the caps of conventions.hpp. A rig without images' sizes
// (no w, h) takes them from the first image's header. Lens distortion (k1, k2, p1, ...) and other keys that change
// what a camera sees stay in `extras`: callers that cannot handle them must look.
Result<Rig> read_rig(const std::filesystem::path& path);

// Intrinsics that all views share are written once at the top, as NeRF tools expect, otherwise per frame.
Status write_rig(const std::filesystem::path& transforms_json, const Rig& rig);

// The JSON text read and written by the functions above; `where` names the source in errors. Doubles come back exactly.
// rig_from_json() looks at no image: w and h must be there.
Result<Rig> rig_from_json(const std::string& text, const std::string& where);
std::string rig_to_json(const Rig& rig);

// Where view i's image is: file_path under `folder`, with ".png" added where the name as given does not exist (and,
// if neither does, where it has no extension).
std::filesystem::path image_path(const std::filesystem::path& folder, const RigView& view);

// A ring of `count` cameras about Y, looking at the target (0, look_at_height, 0) from `distance`, `elevation_rad`
// above the target's horizontal plane (|elevation_rad| < pi/2); first camera on +Z, turning towards +X by 2*pi/count
// each: as a turntable that carries the object the other way. `first_rad` turns the whole ring. Images are named
// images/0000.png and so on. count 1..kMaxViews, distance and fl_px > 0.
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

}  // namespace rs
