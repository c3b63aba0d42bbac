#pragma once
// Initial model of the bundle: equal steps, tried with several focal lengths, tilts and both directions of turning.

#include "capture/calibration/model/calibration.hpp"
#include "capture/calibration/points/bundle.hpp"

#include <span>

namespace rs::capture {

struct InitialModel {
    TurntableModel model;  // after bundles with one common step
    int agreeing = 0;      // observations within a few pixels of it
    int agreeing_opposite =
        0;  // the largest `agreeing` of models with the other direction; 0 if the direction was given
};

/// `tracks` in px of the photos. Nothing if no start explains them.
std::optional<InitialModel> find_initial_model(std::span<const Track> tracks, std::span<const MatchedPair> pairs,
                                               int views, const Lens& middle, const KnownInputs& known);

}  // namespace rs::capture
