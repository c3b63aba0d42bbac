#pragma once
/// \file
/// Selects the reader of a file or folder with the cameras of photos: COLMAP, transforms.json, Middlebury.

#include "capture/posed/cameras/posed_camera.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace rs::capture {

/// Reads the cameras of `path`:
///
///   folder          its transforms.json; a COLMAP model (find_colmap_model()); transforms_train.json, transforms_val
///                   .json and transforms_test.json, those that exist, as one; its only *_par.txt
///   *.json          transforms.json of nerfstudio, instant-ngp, Blender or NeRF, by read_rig() with its lens keys
///   *.bin, *.txt    a file of a COLMAP model; any other *.txt is Middlebury's
///
/// The first of several equal frames is kept. Errors: those of the readers, an image with two different
/// cameras, an unknown file type.
Result<PosedModel> read_camera_file(const std::filesystem::path& path);

/// Lens distortion that a transforms.json states by camera_model (or camera_type), is_fisheye, k1..k6, p1, p2 and k
/// (k1 of SIMPLE_RADIAL), by the keys of a frame or else by those of the file. k4..k6 are OpenCV's rational model.
/// Errors: a camera model that is neither a pinhole with radial and tangential distortion nor OpenCV's fisheye,
/// by its name; coefficients that are no numbers.
Result<LensDistortion> lens_distortion_of(const nlohmann::json& file, const nlohmann::json& frame,
                                          const std::string& place);

}  // namespace rs::capture
