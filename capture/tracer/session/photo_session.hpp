#pragma once
// Synthetic photos of an object on a turntable with exact ground truth, for evaluating calibration and segmentation.
//
//     scene -> plan (session_plan) -> disc -> per view: rotate the lights, trace through the lens, composite over the
//     static backdrop, expose (sensor), write     -> FOLDER/photos/000.jpg ...   input of the capture pipeline
//              coverage of the object alone       -> FOLDER/truth/alpha/000.png  grey, alpha as 8-bit codes
//                                                 -> FOLDER/truth/transforms.json
//
// The camera and the lights are static; the object rotates with the disc and the board on it. If bright parts of object
// or disc would clip, all lights are dimmed by one factor, which is part of the truth. Tracing takes place in the
// object's frame, in which the camera and the lights rotate.
//
// transforms.json contains every view's pinhole camera in the object's frame, which is the scene's
// (rayspace/geometry/rig.hpp); the photos it names have lens distortion, given by "turntable" only: f_px,
// cx, cy, k1, k2, pan_rad, tilt_rad, roll_rad and angles_rad as in capture/calibration/model/turntable_model.hpp;
// "distance" and "camera_height" of the camera's centre from axis and origin, in the scene's unit; exposures; dimming
// (of the lights); "plate", the turntable's disc; the board's corners in the object's frame; the options; and, for
// recentred photos, "places": for every view scale and shift_px as in
// capture/calibration/model/calibration.hpp.
// The cameras are those before recentring.

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
    bool recentred = false;         // shift and scale each photo to its object, like web shops do (coverage.hpp)
    std::string backdrop = "wall";  // "wall", "blue", "white", or the name of an image
    bool force = false;             // replace an existing folder whatever it holds (StagedFolder)
};

/// Returns true for the names of procedural backdrops.
bool is_procedural_backdrop(const std::string& name);

/// Renders and writes a session. The disc lies under the object's lowest vertex. The folder is created atomically; an
/// existing one is replaced as StagedFolder states (file_output.hpp). The same options give the same bytes with any
/// number of threads. \param object_radius largest distance of the object from the axis \param progress covers all
/// views; may be null \return an error if an image cannot be read, if lens or camera are infeasible (session_plan.hpp),
/// or if no view shows the object
Result<CaptureSetSummary> write_photo_session(const Scene& object, double object_radius, const PhotoOptions& options,
                                              const std::filesystem::path& folder, Progress* progress = nullptr);

}  // namespace rs::capture
