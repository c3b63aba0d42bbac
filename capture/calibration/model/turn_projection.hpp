#pragma once
// Turntable model with precomputed rotations, for projecting many points into many views.

#include "capture/calibration/model/turntable_model.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace rs::capture {

class TurnProjection {
public:
    explicit TurnProjection(const TurntableModel& model);

    /// Projects a point of the object (in the object frame at angle 0) into a view, px; nothing if it is not in front
    /// of the camera.
    [[nodiscard]] std::optional<glm::dvec2> project(const glm::dvec3& p_in_object, std::size_t view) const;

    /// The projection and its derivatives by the point.
    struct ProjectionJacobian {
        glm::dvec2 px{0.0};
        glm::dvec3 slope_x{0.0};  // derivatives of px.x by the point's coordinates
        glm::dvec3 slope_y{0.0};
    };
    [[nodiscard]] std::optional<ProjectionJacobian> project_with_jacobian(const glm::dvec3& p_in_object,
                                                                          std::size_t view) const;

    /// Centre of a view's camera, and the unit direction of the ray through pixel position `px`, in the object frame;
    /// nothing if the lens distortion cannot be inverted there.
    [[nodiscard]] glm::dvec3 centre(std::size_t view) const;
    [[nodiscard]] std::optional<glm::dvec3> ray(const glm::dvec2& px, std::size_t view) const;

    /// p_in_camera = camera_from_object(view) * p_in_object + offset(). Points with Z <= kNearest are in front of the
    /// camera.
    static constexpr double kNearest = -1e-6;
    [[nodiscard]] const glm::dmat3& camera_from_object(std::size_t view) const { return camera_from_object_[view]; }
    [[nodiscard]] const glm::dvec3& offset() const { return offset_; }

private:
    Lens lens_;
    glm::dvec3 offset_;                           // in the camera's axes
    std::vector<glm::dmat3> camera_from_object_;  // [view], rotation
};

}  // namespace rs::capture
