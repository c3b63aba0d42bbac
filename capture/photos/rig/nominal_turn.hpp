#pragma once
// What the cut-outs alone say about a turn that nobody calibrates: the axis' column and the sense of turning. The
// nominal rig stands on it, and calibration begins with it.

#include "capture/photos/intake/photo_folder.hpp"
#include "capture/photos/matte/cut_turn.hpp"
#include "capture/photos/rig/nominal_rig.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rs::capture {

struct NominalTurn {
    double step_deg = 0;
    double axis_x_px = 0;
    double axis_spread_px = 0;
    std::string axis_from;  // "silhouettes", "given", "picture middle"
    Turning turning = Turning::kClockwise;
    std::string turning_from;        // "pictures", "given", "assumed"
    std::vector<std::string> notes;  // of what is doubtful, one line each
};

struct NominalTurnRequest {
    std::optional<double> degrees_per_view;
    std::optional<double> axis_x_px;
    std::optional<Turning> turning;
};

NominalTurn find_nominal_turn(const NominalTurnRequest& request, const PhotoFolder& folder, const CutTurn& turn);

}  // namespace rs::capture
