#pragma once
/// \file
/// Sparse models of COLMAP, text and binary: cameras.txt and images.txt, or cameras.bin and images.bin. Points are not
/// read. Format: https://colmap.github.io/format.html. Pixels have their centres at +0.5, as here.
///
/// Camera models: SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV, FULL_OPENCV, SIMPLE_RADIAL_FISHEYE,
/// RADIAL_FISHEYE, OPENCV_FISHEYE.

#include "capture/posed/cameras/posed_camera.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rs::capture {

/// Names of the camera models that are read, and of those that are known but refused.
std::vector<std::string> colmap_camera_models();
std::vector<std::string> refused_colmap_camera_models();

/// Folder of the COLMAP model at `path`: the folder itself, its sparse/0, sparse or 0, or the folder of one of its
/// files. Nullopt if there is none.
std::optional<std::filesystem::path> find_colmap_model(const std::filesystem::path& path);

/// Reads the model of a folder; binary files are used if both are there. Files of at most 1 GiB. Errors: those of
/// colmap_model_from_text() and colmap_model_from_binary(), unreadable files.
Result<PosedModel> read_colmap_model(const std::filesystem::path& folder);

/// Parses the contents of cameras.txt and images.txt. Errors, one line each with the file in `folder` and the line:
/// malformed lines, unknown camera models (by name), numbers out of range, images without a camera, none or more than
/// kMaxViews images.
Result<PosedModel> colmap_model_from_text(std::string_view cameras, std::string_view images, const std::string& folder);

/// Parses the contents of cameras.bin and images.bin. Errors likewise; nothing is allocated by a count of the file that
/// its size does not confirm.
Result<PosedModel> colmap_model_from_binary(std::span<const std::byte> cameras, std::span<const std::byte> images,
                                            const std::string& folder);

/// Contents of the files of a text model.
struct ColmapText {
    std::string cameras;
    std::string images;
    std::string points;  ///< without points
};

/// Text model of cameras without distortion, with 17 significant digits. Photos with equal lenses share a camera.
ColmapText colmap_text_of(std::span<const PosedCamera> cameras);

}  // namespace rs::capture
