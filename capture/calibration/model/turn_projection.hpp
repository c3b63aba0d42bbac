#pragma once
// A turntable model made ready to project many points into many views: sines and cosines are taken once.

#include "capture/calibration/model/turntable_model.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace rs::capture {

class TurnProjection {
public:
    explicit TurnProjection(const TurntableModel& model);

    // Where a point of the object (as it stands at angle 0) appears in a view, px; nothing where it is not before the
    // camera.
    [[nodiscard]] std::optional<glm::dvec2> project(const glm::dvec3& p_in_object, std::size_t view) const;

    // The same, and how it moves with the point.
    struct Moving {
        glm::dvec2 px{0.0};
        glm::dvec3 slope_x{0.0};  // of px.x by the point's coordinates
        glm::dvec3 slope_y{0.0};
    };
    [[nodiscard]] std::optional<Moving> project_moving(const glm::dvec3& p_in_object, std::size_t view) const;

    // In the object's frame: where the camera of a view stands, and the direction, of length 1, that it sees at `px`;
    // nothing where the lens' distortion cannot be undone.
    [[nodiscard]] glm::dvec3 centre(std::size_t view) const;
    [[nodiscard]] std::optional<glm::dvec3> ray(const glm::dvec2& px, std::size_t view) const;

    // p_in_camera = camera_from_object(view) * p_in_object + offset(). What lies at a Z of kNearest and below is before
    // the camera.
    static constexpr double kNearest = -1e-6;
    [[nodiscard]] const glm::dmat3& camera_from_object(std::size_t view) const { return camera_from_object_[view]; }
    [[nodiscard]] const glm::dvec3& offset() const { return offset_; }

private:
    Lens lens_;
    glm::dvec3 offset_;                           // of the camera's axes
    std::vector<glm::dmat3> camera_from_object_;  // [view], rotation
};

}  // namespace rs::capture
