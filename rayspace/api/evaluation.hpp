#pragma once
/// \file
/// Scores of rendered views against photos. Photos that an object was built from should not be used to score it.

#include "rayspace/api/builder.hpp"
#include "rayspace/api/renderer.hpp"
#include "rayspace/api/result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rs::api {

/// Score of one view.
struct ViewScore {
    std::string photo;  ///< path relative to the set's folder
    ImageScore score;   ///< rendered view against the photo
};

/// Scores of all views.
struct Evaluation {
    std::vector<ViewScore> views;  ///< in the set's order
    double mean_psnr_db = 0;       ///< mean of the views' dB
    double pooled_psnr_db = 0;     ///< dB of all object pixels taken together
    double mean_ssim = 0;          ///< mean of the views' SSIM
};

/// Options of evaluate_held_out().
struct HoldOutOptions {
    int every = 2;                   ///< of each `every` neighbouring photos of a ring the middle one is held out, >= 2
    MapKind map = MapKind::kShape;   ///< of the object that is built from the others
    int planes = 12;                 ///< reference planes, 3..64
    ProgressCallback progress = {};  ///< may be empty
};

/// Renders every pose of a capture set and compares it with the set's photo. Thread-safe.
/// \param renderer  of an object in the set's frame and units
/// \param set       a folder with a transforms.json and RGBA photos
/// \param options   the depth flag is ignored
/// \return scores; an error that names the file
Result<Evaluation> compare_with_photos(const Renderer& renderer, const std::filesystem::path& set,
                                       const RenderOptions& options = {});

/// Builds an object from some photos of a capture set, renders the poses of the others, and compares. Thread-safe.
/// Cost: that of build_object() without compression.
/// \param set      a folder with a transforms.json and RGBA photos
/// \param options  which photos are held out, and what is built
/// \return scores of the photos held out; an error that names the file or the option
Result<Evaluation> evaluate_held_out(const std::filesystem::path& set, const HoldOutOptions& options = {});

}  // namespace rs::api
