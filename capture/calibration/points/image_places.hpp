#pragma once
// Images that were moved and scaled one by one (image_place.hpp): no turn before a still camera explains them,
// until each is put back to where it was. Stands between tracks and track_calibration.

#include "capture/calibration/model/calibration.hpp"
#include "capture/calibration/model/image_place.hpp"
#include "capture/calibration/model/turntable_model.hpp"
#include "capture/calibration/points/bundle.hpp"
#include "capture/calibration/points/tracks.hpp"

#include <optional>
#include <span>
#include <vector>

namespace rs::capture {

struct PlacedTurn {
    std::vector<ImagePlace> places;  // [view]
    TurntableModel model;            // of the images with their places undone, with equal steps
    double agreeing = 0;             // share of the observations within a few pixels, places undone
};

// From tracks in px of the photographs, whose lens has `lens`' frame and middle. Several lenses, heights of the camera
// and both senses of turning are tried. What shifts and scales cannot tell from another place of the axis, or of the
// camera, is settled by the least of them. Nothing where no adjustment succeeds. Works on all cores.
std::optional<PlacedTurn> find_places(std::span<const Track> tracks, const Lens& lens, std::size_t views, int reduction,
                                      const KnownInputs& known);

// What `bundle`, of the images put back, shows of how far their places are still off: [view], to be taken before
// theirs. `limit_px` is how far its observations may disagree. Nothing where the adjustment fails.
std::optional<std::vector<ImagePlace>> remaining_places(const Bundle& bundle, double limit_px,
                                                        const KnownInputs& known);

// The images as a still camera would have seen them; what an image does not show is transparent.
TurnImages put_back(const TurnImages& turn, std::span<const ImagePlace> places);

}  // namespace rs::capture
