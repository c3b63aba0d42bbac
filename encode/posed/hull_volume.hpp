#pragma once
// Visual hull of photos from anywhere: the voxels that all alpha mattes show, with the distance to the nearest contour,
// so that the surface lies between the voxels' centres.

#include "encode/posed/posed_photo.hpp"
#include "encode/posed/signed_volume.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <span>

namespace rs::encode {

/// Tolerance of a hull for inexact mattes and poses.
struct HullTolerance {
    double margin_px = 0;  // by which mattes are dilated
    double tolerated = 0;  // share of the photos that may rule out a point of the object
};

struct HullOptions {
    int longest_voxels = 320;  // along the longest side of the object's box
};

struct CarvedHull {
    SignedVolume volume;
    HullTolerance tolerance;  // the narrowest for which the mattes agree
    double contradicted = 0;  // share of the object's pixels whose rays miss the hull
};

/// Carves the hull. Points outside of a photo's frame are not ruled out by it. Errors: fewer than kLeastPhotos, cameras
/// inside the object, no common volume.
/// Memory: 4 bytes per voxel and per pixel of the photos.
Result<CarvedHull> carve_hull(std::span<const PosedPhoto> photos, const HullOptions& options,
                              Progress* progress = nullptr);

inline constexpr int kLeastPhotos = 8;

}  // namespace rs::encode
