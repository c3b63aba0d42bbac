#pragma once
// The truth of a photographed turn as a transforms.json; see photo_session.hpp.

#include "capture/tracer/photo_session.hpp"
#include "rayspace/rig.hpp"

namespace rs::capture {

// `dimming` is the factor on the scene's lights; `photo_of_view` names the photographs, relative to the
// transforms.json.
Rig truth_rig(const SessionPlan& plan, const Plate& plate, double object_radius, const PhotoOptions& options,
              double dimming, const std::vector<std::string>& photo_of_view);

}  // namespace rs::capture
