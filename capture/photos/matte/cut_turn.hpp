#pragma once
// The second pass over the photographs: every one is cut out and put by, and what the later stages need of the whole
// turn is gathered on the way. Stands between backdrop and found_rig.

#include "capture/photos/background/backdrop.hpp"
#include "capture/photos/intake/photo_folder.hpp"
#include "capture/photos/matte/cut_pictures.hpp"
#include "capture/photos/matte/outline.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace rs::capture {

// What cutting takes of memory per pixel of the photograph, at most: where every pixel is undecided and becomes a node
// with eight edges of the minimum cut (contrast_cut.hpp). Ordinary photographs take two thirds of it, the
// floating-point colours of both sides of the edge (soft_edge.hpp).
inline constexpr int kCutBytesPerPixel = 170;

// What tells the object from the rest: the backdrop, or, where it is not empty, a folder with one mask per photograph,
// of its name or that name with another picture ending, of its size, white where the object is.
struct CutSource {
    Backdrop backdrop;
    std::filesystem::path masks;
};

struct CutTurn {
    TurnOutline outline;
    std::vector<TurnOutline::Box> boxes;  // [view], of what it shows
    std::vector<Image<Rgba8>> small;      // [view], for find_turning()
    double min_coverage = 1;  // share of the picture's pixels with alpha of 128 and more: smallest of all views
    double max_coverage = 0;  // ... and largest
    std::vector<std::string> notes{};  // one line each: what the user should know
};

// The name of view 0, 1, ... within a set: "images/0000.png".
std::string cut_picture_name(std::size_t view);

// Puts all photographs, cut out, into `cuts`. Fails at a photograph that cannot be read or has changed its size, that
// shows no object, whose mask is missing or of another size, or, unless it brings its own alpha, nothing but the
// object.
Result<CutTurn> cut_turn(const PhotoFolder& folder, const CutSource& source, const CutPictures& cuts,
                         Progress* progress);

}  // namespace rs::capture
