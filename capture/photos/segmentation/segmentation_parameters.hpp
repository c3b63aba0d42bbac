#pragma once
/// \file
/// Collects all thresholds of segmentation, with an override by a JSON file for experiments.
///
/// The defaults are what the import uses. A file states what differs, by the names of the fields:
/// {"foreground": {"score": {"background_delta_e": 3}}, "checks": {"max_coverage": 0.7}}.

#include "capture/photos/background/background_parameters.hpp"
#include "capture/photos/foreground/foreground_parameters.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>

namespace rs::capture {

/// Fusion of a network with the background model (network_segmenter.hpp).
struct FusionParameters {
    double min_static_share = 0.03;  ///< of the image: less static foreground is part of the object
    double min_component = 0.01;     ///< of the largest component's area; smaller components are removed
};

/// Checks of the result (segmentation_checks.hpp).
struct CheckParameters {
    double max_coverage = 0.6;       ///< share of the image, median over the turn
    double max_at_border = 0.5;      ///< share of the photos whose object reaches the image border
    double max_contradicting = 0.1;  ///< share of the photos whose silhouette contradicts its neighbours
    double plate_factor = 1.5;       ///< times the change of area of a rotating flat plate is tolerated ...
    double area_margin = 0.05;       ///< ... and this share of the largest area
};

struct SegmentationParameters {
    BackgroundParameters background{};
    ForegroundParameters foreground{};
    FusionParameters fusion{};
    CheckParameters checks{};
};

/// Reads a JSON file of overrides, at most 1 MiB. Errors: not JSON, a name that is no parameter (with its path), a
/// value of another type.
Result<SegmentationParameters> read_segmentation_parameters(const std::filesystem::path& file);

/// All parameters with their values, as such a file.
std::string to_json_text(const SegmentationParameters& parameters);

}  // namespace rs::capture
