#pragma once
/// \file
/// Cameras of photos taken by hand: runs COLMAP (https://colmap.github.io), which is installed separately, in a
/// temporary folder:
///
///   colmap feature_extractor     SIFT features on the CPU; one SIMPLE_RADIAL lens if all photos have one size and
///                                focal length, else one lens for each photo
///   colmap exhaustive_matcher    all pairs; sequential_matcher for more than kMostExhaustive photos
///   colmap mapper                models; the largest is used
///
/// The whole photos are used, since the floor has most of the texture. If too few cameras are found so and masks are
/// given, features of the object alone are tried: the object was turned, or people walked behind it.

#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/file/file_output.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace rs::capture {

struct ColmapRequest {
    std::filesystem::path photos;    ///< folder, with its subfolders
    std::filesystem::path masks;     ///< folder as MaskFolder reads it; empty: none
    std::string program = "colmap";  ///< searched in PATH; called with COLMAP's command line
};

/// Photos up to which all pairs are matched.
inline constexpr std::size_t kMostExhaustive = 150;

/// Model of at least two thirds of the photos.
struct ColmapReconstruction {
    StagedFolder folder;             ///< has all files of COLMAP; deleted on destruction
    std::filesystem::path model;     ///< for read_camera_file()
    std::vector<std::string> notes;  ///< one line each: several models, more photos than are matched exhaustively
};

/// Computes the cameras, in minutes. Errors: COLMAP is not installed, or fails (with its last line); it finds the
/// cameras of fewer than two thirds of the photos (the others are named); those of list_photos() and MaskFolder.
Result<ColmapReconstruction> reconstruct_with_colmap(const ColmapRequest& request, Progress* progress);

}  // namespace rs::capture
