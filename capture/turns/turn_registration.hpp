#pragma once
/// \file
/// Registration of several turns of one object in a common frame, whose Y is the axis of the first turn: by points of
/// the object that turns share (turn_points.hpp), in any orientation of the object; else by silhouettes
/// (hull_search.hpp); then all turns together (joint_bundle.hpp, joint_silhouettes.hpp).

#include "capture/calibration/model/calibration.hpp"
#include "capture/calibration/points/tracks.hpp"
#include "capture/turns/turn_placement.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rs::capture {

struct TurnToRegister {
    std::string name;  ///< in messages
    TurnImages images;
    /// Nothing if the turn cannot be calibrated alone: its camera's height is then searched.
    std::optional<Calibration> calibration;
    TurntableModel nominal;  ///< assumed lens, pan at the column of the axis, angles
};

enum class RegistrationMethod { kReference, kPoints, kSilhouettes };
std::string to_string(RegistrationMethod method);  ///< "reference", "points", "silhouettes"

struct RegisteredTurn {
    PlacedTurn turn;
    RegistrationMethod method = RegistrationMethod::kReference;
    std::size_t pairs = 0;         ///< points shared with other turns
    std::size_t observations = 0;  ///< of shared points, in photos of this turn
    double rms_px = 0;             ///< of their residuals
    double overlap = 0;            ///< mean intersection over union of its masks and the hull of all turns, 0..1
};

/// At least one turn must be calibrated; it is the reference. Errors, by name of the turn: no placement fits (another
/// object, or laid down otherwise and too little texture); an object whose silhouettes look the same from all sides and
/// that shares no points.
Result<std::vector<RegisteredTurn>> register_turns(std::span<const TurnToRegister> turns, Progress* progress);

}  // namespace rs::capture
