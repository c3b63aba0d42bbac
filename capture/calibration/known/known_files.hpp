#pragma once
// Readers for camera parameters measured by other tools: OpenCV's intrinsics, the parameter files of the Middlebury
// multi-view sets, a NeRF tool's transforms.json. Calibration holds all of these values constant.

#include "capture/calibration/model/calibration.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace rs::capture {

// Shared by the readers of this folder; internal.

/// Relative difference of fx and fy up to which pixels count as square; f is their mean.
inline constexpr double kSquarePixels = 0.01;

/// f from fx and fy; errors begin with `where`.
Result<double> common_focal_length(double fx_px, double fy_px, const std::string& where);

/// Sets pose, angles and direction of turning.
Status set_turntable(KnownInputs& known, std::span<const glm::dmat4> world_from_camera, const std::string& where);

struct KnownFile {
    KnownInputs known;
    std::vector<std::string> images;  // image names, in the order of known.angles_rad; none in an OpenCV file
};

/// Size in pixels of the images that the file is used with; 0 x 0 if unknown: then it is not checked.
struct ImagePixels {
    int width = 0;
    int height = 0;
};

/// Intrinsics as written by cv::FileStorage (YAML, XML or JSON, at most 1 MB): a 3 x 3 camera_matrix, cameraMatrix,
/// Camera_Matrix, CameraMatrix or K, and distortion_coefficients, Distortion_Coefficients, distCoeffs, dist_coeffs or
/// D. Sets f, principal point (shifted by half a pixel: OpenCV's origin is the centre of the first pixel) and k1, k2 (0
/// if the file has no coefficients). Errors: pixels that are not square within 1 %, skew, other coefficients that are
/// not 0, image_width and image_height that differ from `images`.
Result<KnownFile> read_opencv_intrinsics(const std::filesystem::path& path, ImagePixels images = {});
Result<KnownFile> opencv_intrinsics_from(const std::string& text, const std::string& where, ImagePixels images);

/// A Middlebury *_par.txt (at most 16 MB, kMaxViews views): the number of views, then per line name k11..k33 r11..r33
/// t1..t3, with pixel = K (R p + t), x right, y down, relative to the centre of the first pixel. Sets f, principal
/// point, zero distortion, pose, angles and direction of turning. Errors: another format, views with different K,
/// cameras that fit_turn_to_cameras() refuses.
Result<KnownFile> read_middlebury_parameters(const std::filesystem::path& path);
Result<KnownFile> middlebury_parameters_from(const std::string& text, const std::string& where);

/// The same from a transforms.json (read_rig()). Its image size must equal `images` if that is known. k1 and k2 at its
/// top level are used; other distortion coefficients must be 0.
Result<KnownFile> read_known_rig(const std::filesystem::path& path, ImagePixels images = {});

/// One view of a Middlebury *_par.txt.
struct MiddleburyView {
    std::string name;
    std::array<double, 9> k{};  ///< row by row
    glm::dmat4 world_from_camera{1.0};
};

/// All views of such a file, with lenses and poses of any kind. Error: another format.
Result<std::vector<MiddleburyView>> read_middlebury_views(const std::filesystem::path& path);
Result<std::vector<MiddleburyView>> middlebury_views_from(const std::string& text, const std::string& where);

/// Error: K is not that of a camera without skew.
Status check_middlebury_lens(const MiddleburyView& view, const std::string& where);

/// True if the name ends in .yml, .yaml or .xml.
bool is_opencv_intrinsics(const std::filesystem::path& path);

/// Selects the reader by the name: a folder or *.json is a rig, *.yml, *.yaml and *.xml are OpenCV's, *.txt is
/// Middlebury's.
Result<KnownFile> read_known_file(const std::filesystem::path& path, ImagePixels images = {});

/// The file's angles for the photos of these names, in their order; names are compared without folder and extension.
/// Returns `file.known` unchanged if the file names no images or has no angles. Error: a photo that is not in the file.
Result<KnownInputs> known_inputs_of(const KnownFile& file, const std::vector<std::string>& photos);

}  // namespace rs::capture
