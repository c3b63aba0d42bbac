#pragma once
// Photographs of an object on a turntable, with exactly known truth: for measuring calibration and matting.
//
//     scene -> plan (session_plan) -> disc -> per view: turn the lights, trace through the lens, lay over the still
//     backdrop, expose (sensor), write            -> FOLDER/photos/000.jpg ...   what a photographer would have
//              coverage of the object alone       -> FOLDER/truth/alpha/000.png  grey, alpha as 8-bit codes
//                                                 -> FOLDER/truth/transforms.json
//
// The camera and the lights stand still in the room; the object turns, with the disc and the board on it. Lights that
// would clip bright parts of object or disc are dimmed, all by one factor, which the truth states. Everything is traced
// in the object's frame, where the camera and the lights go around.
//
// transforms.json holds every view's pinhole camera in the object's frame, which is the scene's
// (rayspace/geometry/rig.hpp); the photographs it names are distorted by the lens, which only "turntable" states: f_px,
// cx, cy, k1, k2, pan_rad, tilt_rad, roll_rad and angles_rad as in capture/calibration/model/turntable_model.hpp;
// "distance" and "camera_height" of the camera's centre from axis and origin, in the scene's unit; exposures; dimming
// (of the lights); "plate", the turntable's disc; the board's corners in the object's frame; the options; and, of
// recentred photographs, "places": for every view scale and shift_px as in
// capture/calibration/model/image_placement.hpp. The cameras are the still one's.

#include "capture/tracer/scene/scene.hpp"
#include "capture/tracer/session/capture_set.hpp"
#include "capture/tracer/session/session_plan.hpp"
#include "capture/tracer/session/turntable.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>

namespace rs::capture {

struct PhotoOptions {
    SessionOptions session;
    int samples_per_pixel = 64;
    bool filtered = false;     // RenderOptions::filtered
    int threads = 0;           // 0 = all
    double noise_codes = 1.5;  // standard deviation, 8-bit sRGB
    int jpeg_quality = 90;     // 1..100; 0 = PNG
    DiscSurface disc = DiscSurface::rings;
    std::filesystem::path board;    // an image; empty = none
    double board_width = 1.2;       // object radii
    bool recentred = false;         // each image by itself, as shops do (recentring.hpp)
    std::string backdrop = "wall";  // "wall", "blue", "white", or the name of an image
};

// True for the names of backdrops that no file is needed for.
bool is_made_backdrop(const std::string& name);

// `object` stands as it is on a disc under its lowest vertex; `object_radius` is its largest distance from the axis.
// The folder appears when all is written, and replaces one that this function wrote (file_output.hpp). The same
// options give the same bytes, whatever the number of threads. Fails where an image cannot be read, where the lens or
// the camera are impossible (session_plan.hpp), and where no view shows the object. `progress` counts all views.
Result<CaptureSetSummary> write_photo_session(const Scene& object, double object_radius, const PhotoOptions& options,
                                              const std::filesystem::path& folder, Progress* progress = nullptr);

}  // namespace rs::capture
