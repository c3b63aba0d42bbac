#pragma once
// Computes the shape maps of an object (rayspace/api/types/shape_map.hpp) from its photos.
//
// For each photo of a ring: the visual hull of all silhouettes, including those of the rings next below and above,
// bounds the depths, after parts that single masks lack are restored (silhouette_repair.hpp, lost_parts.hpp); matching
// costs compare colours with the photos on either side, below and above (cost_volume.hpp); semi-global matching chooses
// the depths (semi_global.hpp). Depths are estimated a second time with the neighbors' depths, so that photos agree
// about surfaces (ring_depth_estimator.hpp). A ring whose silhouettes contradict this one's, because the rings were
// calibrated separately, is left out. Each line between two photos merges both depth maps (shape_lines.hpp), and each
// of its cells is shown by the photos in which it is not occluded (visibility.hpp).

#include "encode/raymap/semi_global.hpp"
#include "encode/raymap/shape_lines.hpp"
#include "encode/set/capture_set.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <string>
#include <vector>

namespace rs::encode {

struct ShapeOptions {
    int working_size_px = 768;    // photos whose longer side is longer are reduced by a whole factor
    int max_hull_margin_px = 16;  // of the working views; the narrowest margin that fits is used
    // Distance of depth levels: how far a point moves from one level to the next, in pixels of the working view of the
    // neighbor where it moves most.
    double level_px = 0.3;
    int min_levels = 32, max_levels = 256;
    SmoothnessOptions smoothness;
    ShapeLinesOptions lines;
};

/// Depth maps of one photo for display: distances from the foot of the pixel's ray in object radii, NaN where unknown,
/// at the working size.
struct DepthPreview {
    int view = 0;
    Image<float> hull;   // where the ray enters the visual hull
    Image<float> depth;  // of the surface
};

struct ShapeMapOutput {
    std::vector<DepthPreview> samples;  // of a few views
    CompletedImages completed;          // photos whose masks were completed
    std::vector<std::string> warnings;  // one line each
};

/// The photos of an object.
struct ShapeMapInput {
    const CaptureSet& set;               // read photo by photo; has no completed photos yet
    const Rig& rig;                      // set.upright, in object radii
    const std::vector<ViewRing>& rings;  // from find_rings()
    bool keep_images = false;            // stores the photos, with completed masks, in the object
};

/// Adds the shape map of each ring to an object. Deterministic.
/// \param object  has its views and rings, but not their shapes.
/// \return warnings and depth maps for display; errors of reading.
/// Memory: at the working size 10 bytes per pixel and photo, 4 bytes per full-size pixel of `completed`, and for each
/// thread about 3 bytes per object pixel and depth level.
Result<ShapeMapOutput> add_shape_maps(const ShapeMapInput& input, const ShapeOptions& options, RaySpaceObject& object,
                                      Progress* progress = nullptr);

}  // namespace rs::encode
