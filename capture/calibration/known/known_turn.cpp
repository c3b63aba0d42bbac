#include "capture/calibration/known/known_turn.hpp"

#include "capture/calibration/model/turn_of_cameras.hpp"
#include "capture/calibration/silhouettes/turn_diagnosis.hpp"

#include <cmath>

namespace rs::capture {

Result<double> common_focal_length(double fx_px, double fy_px, const std::string& where) {
    if (!(fx_px > 1e-3 && fy_px > 1e-3 && fx_px < 1e7 && fy_px < 1e7)) {
        return Error{where + ": its focal length is out of range; check that it is in pixels"};
    }
    const double f_px = (fx_px + fy_px) / 2;
    if (std::abs(fx_px - fy_px) > kSquarePixels * f_px) {
        return Error{where + ": its focal lengths " + std::to_string(fx_px) + " and " + std::to_string(fy_px) +
                     " differ by more than 1 %; scale the pictures to square pixels, and calibrate those"};
    }
    return f_px;
}

Status set_turn(KnownInputs& known, std::span<const glm::dmat4> world_from_camera, const std::string& where) {
    const auto turn = turn_of_cameras(world_from_camera, where);
    if (!turn) return turn.error();
    known.pose = turn->pose;
    known.angles_rad = turn->angles_rad;
    known.counter_clockwise = median_step(turn->angles_rad) > 0;
    return {};
}

}  // namespace rs::capture
