#pragma once
// What others have measured of a camera or a turn, read from their files: OpenCV's intrinsics, the parameter files of
// the Middlebury multi-view sets, a NeRF tool's transforms.json. All of it is held by calibration.

#include "capture/calibration/model/calibration.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace rs::capture {

// What the readers of these files share; private to them.

// Pixels count as square within this share; f is the mean of both.
inline constexpr double kSquarePixels = 0.01;

// f from fx and fy, or an error that begins with `where`.
Result<double> common_focal_length(double fx_px, double fy_px, const std::string& where);

// Fills in pose, angles and sense.
Status set_turn(KnownInputs& known, std::span<const glm::dmat4> world_from_camera, const std::string& where);

struct KnownFile {
    KnownInputs known;
    std::vector<std::string> images;  // the images' names, in the order of known.angles_rad; none in an OpenCV file
};

// Pixels of the images that the file is to be used with; 0 x 0 where that is not known and so not checked.
struct ImagePixels {
    int width = 0;
    int height = 0;
};

// Intrinsics as cv::FileStorage writes them (YAML, XML or JSON, at most 1 MB): a 3 x 3 camera_matrix, cameraMatrix,
// Camera_Matrix, CameraMatrix or K, and distortion_coefficients, Distortion_Coefficients, distCoeffs, dist_coeffs or D.
// Gives f, principal point (moved by half a pixel: OpenCV counts from the centre of the first) and k1, k2 (0 where the
// file has no coefficients). Errors: pixels that are not square within 1 %, skew, other coefficients that are not 0,
// image_width and image_height that differ from `images`.
Result<KnownFile> read_opencv_intrinsics(const std::filesystem::path& path, ImagePixels images = {});
Result<KnownFile> opencv_intrinsics_from(const std::string& text, const std::string& where, ImagePixels images);

// A Middlebury *_par.txt (at most 16 MB, kMaxViews views): the number of views, then per line name k11..k33 r11..r33
// t1..t3, with pixel = K (R p + t), x right, y down, counted from the centre of the first pixel. Gives f, principal
// point, no distortion, pose, angles, sense of turning. Errors: what is no such file, views with different K, cameras
// that turn_of_cameras() refuses.
Result<KnownFile> read_middlebury_parameters(const std::filesystem::path& path);
Result<KnownFile> middlebury_parameters_from(const std::string& text, const std::string& where);

// The same from a transforms.json (read_rig()); its images' size must be `images` where that is known. k1 and k2 at
// its top are taken, other distortion is refused unless 0.
Result<KnownFile> read_known_rig(const std::filesystem::path& path, ImagePixels images = {});

// Whichever of the three the name speaks of: a folder or *.json is a rig, *.yml, *.yaml and *.xml are OpenCV's, *.txt
// is Middlebury's.
Result<KnownFile> read_known_file(const std::filesystem::path& path, ImagePixels images = {});

// The file's angles for photographs of these names, in their order: names are compared without folder and ending. Where
// the file names no images, or has no angles, `known` as it is. Error: a photograph that the file does not know.
Result<KnownInputs> known_of_photographs(const KnownFile& file, const std::vector<std::string>& photographs);

}  // namespace rs::capture
