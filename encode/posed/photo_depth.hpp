#pragma once
// Depth of each photo by plane sweep (Collins 1996; Gallup et al. 2007) between the hull's entry and exit, against
// photos in any direction around it. The cost is normalized cross-correlation; semi-global matching regularizes.

#include "encode/posed/posed_photo.hpp"
#include "encode/posed/signed_volume.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <span>
#include <vector>

namespace rs::encode {

struct PhotoDepthOptions {
    int working_size_px = 768;  // photos whose longer side is longer are reduced by a whole factor
    int most_maps = 160;        // of more photos, those spread most evenly have a depth map
    int neighbours = 6;
    double least_angle_deg = 5, most_angle_deg = 30;  // between two photos, seen from the object
    double level_px = 0.75;  // a point's move from one level to the next in the neighbour where it moves most
    int max_levels = 256;
    int window_px = 5;       // of the correlation, odd
    double agreement = 2.5;  // voxels of the hull's grid within which neighbours must confirm a depth
    int confirming = 2;      // neighbours
};

/// Depth map of a photo at the working size.
struct PhotoDepth {
    Camera camera;       // of the depth map
    Image<float> depth;  // axial, in the rig's units; 0 where unknown or not confirmed
};

/// Estimates depth maps of the photos, in their order. Memory: 9 bytes per pixel of the working size, 4 more if photos
/// are reduced, and for each thread about 3 bytes per object pixel and level.
Result<std::vector<PhotoDepth>> estimate_photo_depths(std::span<const PosedPhoto> photos, const SignedVolume& hull,
                                                      const PhotoDepthOptions& options, Progress* progress = nullptr);

}  // namespace rs::encode
