#pragma once
/// \file
/// Import of photos with known cameras anywhere around the object -> a capture set. Stages:
///
///   read_camera_file()         cameras                              cameras/camera_file.hpp
///   match_photos()             photos of the cameras                photo_match.hpp
///   choose_segmenter()         one segmenter per size of photos     photos/segmentation/segmenter_choice.hpp
///   make_consistent_segmenters()  instead of background models      consistent_segmenter.hpp
///   undistorted()              foreground images of pinhole cameras undistortion.hpp
///   common_target(), find_up(), carve_bounding_cylinder()           up_axis.hpp, visual_hull.hpp
///
/// The set has Y up, its origin at the middle of the object's bounding cylinder and an object_radius of 1; the first
/// camera is above +Z. Images have different sizes, so each frame has w, h, fl_x, fl_y, cx, cy and a transform_matrix.
/// The key "posed": true states that the cameras form no turntable rings.

#include "capture/photos/segmentation/segmenter_choice.hpp"
#include "capture/posed/up_axis.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image_io/photo_size.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rs::capture {

/// Axes of the cameras in a transforms.json.
enum class CameraAxes {
    kAuto,    ///< those with which most cameras look at a common point; OpenGL's if both do
    kOpenGl,  ///< X right, Y up, looking along -Z
    kOpenCv,  ///< X right, Y down, looking along Z
};

struct PosedImportOptions {
    std::filesystem::path photos;   ///< folder
    std::filesystem::path cameras;  ///< read_camera_file()
    std::filesystem::path output;   ///< folder; an existing one is replaced as StagedFolder states
    SegmenterRequest segmentation;  ///< masks by mask_path of the cameras' file if no folder is given
    UpRequest up;
    CameraAxes axes = CameraAxes::kAuto;
    int max_side_px = kDefaultMaxSide_px;  ///< larger photos are reduced first
    bool force = false;                    ///< replace an existing folder whatever it holds
};

struct PosedImportReport {
    std::size_t views = 0;
    std::vector<std::string> without_camera;  ///< names of photos that the model does not have
    std::vector<std::string> without_photo;   ///< photos of the model that are not there
    std::vector<std::string> without_object;  ///< photos that show no object
    SegmenterKind segmenter = SegmenterKind::kAlpha;
    std::vector<std::string> sizes;  ///< of the photos: "1440x1080"
    std::size_t undistorted = 0;     ///< number of photos that were resampled
    UpAxis up;                       ///< in the axes of the cameras' file
    glm::dvec3 origin{0};            ///< the object's centre, likewise
    double radius = 0;               ///< of the object's bounding cylinder, in units of the cameras' file
    double height = 0;               ///< of that cylinder
    std::vector<std::string> notes;  ///< one line each
};

/// Checks what import_posed_photos() needs of the photos besides their cameras: a segmenter for each. Called before the
/// cameras are computed, which takes minutes. `options.cameras` is ignored.
Status check_segmenters(const PosedImportOptions& options, Progress* progress);

/// Imports a folder of photos. Nothing is left at options.output if it fails. Errors: those of the stages; fewer than
/// three photos with a camera and an object; photos without alpha, masks or a network whose views do not agree about
/// the object before a structured background; cameras that do not look at a common point, or that are inside the
/// object.
Result<PosedImportReport> import_posed_photos(const PosedImportOptions& options, Progress* progress);

}  // namespace rs::capture
