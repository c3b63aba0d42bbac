#pragma once
/// \file
/// Vertical direction of a scene, from the attitudes of its cameras. Structure from motion leaves the world's
/// orientation free, and Blender's Z is up.

#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"

#include <glm/glm.hpp>

#include <span>
#include <string>
#include <vector>

namespace rs::capture {

/// Direction of --up.
struct UpRequest {
    enum class Kind {
        kAuto,   ///< estimate_up()
        kGiven,  ///< `direction`, in the axes of the cameras' file
        kPhoto,  ///< mean up direction of the photos
    };
    Kind kind = Kind::kAuto;
    glm::dvec3 direction{0, 1, 0};  ///< not 0
};

/// Parses "auto", "photo" or "x,y,z".
Result<UpRequest> parse_up(const std::string& text);

struct UpAxis {
    glm::dvec3 direction{0, 1, 0};  ///< unit vector
    std::string from;               ///< "horizons", "photos", "given"
    double level_share = 0;         ///< share of the photos with a horizon within 10 degrees of level
    std::vector<std::string> notes;
};

/// The direction perpendicular to the horizontal image axes of most cameras. People and tripods hold cameras level, at
/// any height and pitch; photos stored on their side have a level vertical image axis instead. A robust fit
/// (iteratively reweighted least squares, minimum of the scatter matrix) tolerates tilted ones. The sign is that of the
/// photos' up; if all are on their side, cameras are above `target`, the object. If fewer than 70 % of the cameras are
/// level, the mean up direction of the photos is used, with a note. Error: neither is defined.
Result<UpAxis> find_up(const UpRequest& request, std::span<const Camera> cameras, const glm::dvec3& target);

}  // namespace rs::capture
