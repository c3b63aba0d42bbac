#pragma once
// Fuses the photos' depth maps and the visual hull into one surface: a truncated signed distance function (Curless and
// Levoy 1996), in which what no photo shows stays as the hull has it.

#include "encode/posed/photo_depth.hpp"
#include "encode/posed/signed_volume.hpp"

#include <span>

namespace rs::encode {

/// The hull, with the voxels removed that depth maps show to be in front of the surface. On the hull's grid.
SignedVolume fuse_depths(const SignedVolume& hull, std::span<const PhotoDepth> depths, Progress* progress = nullptr);

}  // namespace rs::encode
