#include "capture/posed/cameras/posed_camera.hpp"

#include "rayspace/base/printable.hpp"
#include "rayspace/image_io/photo_size.hpp"

#include <algorithm>
#include <cmath>

namespace rs::capture {

Status check_lens(const PosedCamera& camera, const std::string& place) {
    constexpr double kMinFocal_px = 1e-3, kMaxFocal_px = 1e7;
    constexpr double kMinFocal_sides = 0.05;  // a fisheye with a circle of 180 degrees has more than 0.15
    constexpr int kMinSideForCorner_px = 8;
    constexpr double kMaxPrincipal_px = 1e6;
    constexpr double kMaxCoefficient = 1e6;
    const Camera& lens = camera.camera;
    if (lens.width < 1 || lens.height < 1 || lens.width > kMaxPhotoSide_px || lens.height > kMaxPhotoSide_px) {
        return Error{place + ": its image size is not 1.." + std::to_string(kMaxPhotoSide_px) +
                     " px a side; check the file"};
    }
    // Negated comparisons refuse NaN, too.
    for (const double focal : {lens.fl_x, lens.fl_y}) {
        if (!(focal >= kMinFocal_px && focal <= kMaxFocal_px)) {
            return Error{place + ": its focal length is out of range; check that it is in pixels"};
        }
    }
    const int side = std::max(lens.width, lens.height);
    if (std::max(lens.fl_x, lens.fl_y) < kMinFocal_sides * side) {
        return Error{place + ": its focal length is below " + format_fixed(100 * kMinFocal_sides, 0) +
                     " % of the image's side; give it in pixels"};
    }
    const auto is_share = [](double x) { return x >= 0 && x <= 1; };
    if (side >= kMinSideForCorner_px && is_share(lens.cx) && is_share(lens.cy)) {
        return Error{place + ": its principal point is the image's corner; give cx and cy in pixels"};
    }
    if (!(std::abs(lens.cx) <= kMaxPrincipal_px && std::abs(lens.cy) <= kMaxPrincipal_px)) {
        return Error{place + ": its principal point is out of range; check that it is in pixels"};
    }
    const auto is_usable = [](double k) { return std::abs(k) <= kMaxCoefficient; };
    if (!std::ranges::all_of(camera.distortion.coefficients, is_usable)) {
        return Error{place + ": its distortion coefficients are out of range; calibrate the lens again"};
    }
    return {};
}

glm::dmat4 world_from_opencv_camera(const glm::dmat3& rows, const glm::dvec3& translation) {
    glm::dmat4 pose(1.0);
    pose[0] = glm::dvec4(rows[0], 0);
    pose[1] = glm::dvec4(-rows[1], 0);
    pose[2] = glm::dvec4(-rows[2], 0);
    pose[3] = glm::dvec4(-(rows[0] * translation.x + rows[1] * translation.y + rows[2] * translation.z), 1);
    return pose;
}

}  // namespace rs::capture
