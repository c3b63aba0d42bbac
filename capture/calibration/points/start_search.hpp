#pragma once
// Where the bundle begins: equal steps tried with several lenses, heights of the camera and both senses of turning.

#include "capture/calibration/model/calibration.hpp"
#include "capture/calibration/points/bundle.hpp"

#include <span>

namespace rs::capture {

struct Start {
    TurntableModel model;  // after bundles with one common step
    int agreeing = 0;      // observations within a few pixels of it
    int other_sense = 0;   // the most that agree with a model that turns the other way; 0 where the sense was given
};

// `tracks` in px of the photographs. Nothing where no start explains them.
std::optional<Start> find_start(std::span<const Track> tracks, std::span<const PairOfViews> pairs, int views,
                                const Lens& middle, const KnownInputs& known);

}  // namespace rs::capture
