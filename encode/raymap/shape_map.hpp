#pragma once
// Finds the shape maps of an object (rayspace/object/shape_map.hpp) from its pictures.
//
// For every picture of a ring: the visual hull of all silhouettes, those of the rings next below and above among them,
// bounds the depths, with what single cut-outs lack given back to them (silhouette_repair.hpp, lost_parts.hpp); the
// colours of the pictures to either side and below and above show which depth agrees (cost_volume.hpp); smoothness
// decides where colour does not (semi_global.hpp). Then all is searched again with what the neighbours were found to
// show, so that pictures agree about surfaces. A ring whose silhouettes contradict this one's, because only each for
// itself is calibrated, is left out. Then every line between two pictures takes over what both have found
// (shape_lines.hpp).

#include "encode/raymap/rings.hpp"
#include "encode/raymap/semi_global.hpp"
#include "encode/raymap/shape_lines.hpp"
#include "encode/set/capture_set.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <string>
#include <vector>

namespace rs::encode {

struct ShapeOptions {
    int working_size_px = 768;       // pictures whose longer side is longer are searched at a whole fraction of it
    int widest_hull_margin_px = 16;  // of the working pictures; the narrowest that fits is taken
    // Levels of depth are so far apart that a point moves by so many pixels of a working picture from one to the next,
    // in the neighbour where it moves most.
    double level_px = 0.3;
    int fewest_levels = 32, most_levels = 256;
    SmoothnessOptions smoothness;
    ShapeLinesOptions lines;
};

// What was found for one picture, for people to look at: distances from the foot in object radii, NaN where there is
// none, at the working size.
struct FoundDepth {
    int view = 0;
    Image<float> hull;   // where the ray enters the visual hull
    Image<float> depth;  // where the surface is
};

struct FoundShapes {
    std::vector<FoundDepth> samples;  // of a few views
    CompletedPictures completed;
    std::vector<std::string> warnings;  // one line each
};

// `object` has its views and rings but their shapes; rig is set.upright in object radii, rings as find_rings() gave
// them. Pictures are read from the set, and stored in the object where `keep_pictures`; so are those of `completed`.
// `set` has no completed pictures yet. Memory: at the working size 8 bytes a pixel and picture, 4 bytes for each whole
// pixel of `completed`, and for each thread about 3 bytes per object pixel and depth level. Deterministic.
Result<FoundShapes> add_shape_maps(const CaptureSet& set, const Rig& rig, const std::vector<ViewRing>& rings,
                                   const ShapeOptions& options, bool keep_pictures, RaySpaceObject& object,
                                   Progress* progress = nullptr);

}  // namespace rs::encode
