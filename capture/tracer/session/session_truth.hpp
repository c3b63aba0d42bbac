#pragma once
// The truth of a photographed turn as a transforms.json; see photo_session.hpp.

#include "capture/calibration/model/picture_place.hpp"
#include "capture/tracer/session/photo_session.hpp"
#include "rayspace/geometry/rig.hpp"

#include <span>
#include <string>
#include <vector>

namespace rs::capture {

// `dimming` is the factor on the scene's lights; `photo_of_view` names the photographs, relative to the
// transforms.json. `places` is empty where photographs are as the still camera took them.
Rig truth_rig(const SessionPlan& plan, const Plate& plate, double object_radius, const PhotoOptions& options,
              double dimming, const std::vector<std::string>& photo_of_view, std::span<const PicturePlace> places);

}  // namespace rs::capture
