#include "rayspace/geometry/rig_conventions.hpp"

#include "rayspace/base/conventions.hpp"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace rs {
namespace {

constexpr std::size_t kMinTurnViews = 5;
constexpr double kMaxDeviation_deg = 2;  // of a camera's attitude to the axis
constexpr double kMaxDeviation = 0.02;   // of a camera's place, of its distance
constexpr double kMinAim = 0.5;          // cosine of the azimuth between the optical axis and the direction to the axis
constexpr double kMaxMeanRotation2 = 0.85;  // squared length of a mean direction in the plane of the turn: 80 degrees
constexpr double kNegligible_deg = 1;
constexpr double kNegligible = 0.02;  // of the distance

glm::dmat3 rotation_of(const RigView& view) {
    return glm::dmat3(view.camera.world_from_camera);
}

// Horizontal distance by which the optical axis approaches the axis through `point` per unit; negative if it looks
// away.
double approach(const Camera& camera, const glm::dvec3& axis, const glm::dvec3& point) {
    const glm::dvec3 forward = camera.forward() - glm::dot(camera.forward(), axis) * axis;
    return glm::dot(forward, point - camera.centre());
}

// Eigenvector of the largest eigenvalue of a positive semidefinite matrix, by repeated squaring.
glm::dvec3 dominant_eigenvector(glm::dmat3 m) {
    constexpr int kSquarings = 12;
    for (int i = 0; i < kSquarings; ++i) {
        m = m * m;
        m = m / (m[0][0] + m[1][1] + m[2][2]);
    }
    const glm::dvec3* longest = &m[0];
    for (int i = 1; i < 3; ++i) {
        if (glm::length(m[i]) > glm::length(*longest)) longest = &m[i];
    }
    return glm::normalize(*longest);
}

// Means over all cameras: of rotations R and centres p, and of R^T p.
struct PoseMeans {
    glm::dmat3 rotation{0};
    glm::dvec3 centre{0};
    glm::dvec3 centre_in_camera{0};
};

PoseMeans pose_means(const Rig& rig) {
    PoseMeans mean;
    const auto count = static_cast<double>(rig.views.size());
    for (const RigView& view : rig.views) {
        const glm::dmat3 rotation = rotation_of(view);
        mean.rotation += rotation / count;
        mean.centre += view.camera.centre() / count;
        mean.centre_in_camera += glm::transpose(rotation) * view.camera.centre() / count;
    }
    return mean;
}

// Least squares of p_i + R_i a = point over all cameras, with a and the point perpendicular to the axis: a is the
// axis' place in the camera, which is the same for all. `in_camera` is the axis' direction there.
glm::dvec3 axis_point(const PoseMeans& mean, const glm::dvec3& axis, const glm::dvec3& in_camera) {
    const glm::dmat3 back = glm::transpose(mean.rotation);
    const glm::dmat3 normal = glm::dmat3(1) - back * mean.rotation + glm::outerProduct(in_camera, in_camera);
    const glm::dvec3 a = glm::inverse(normal) * (back * mean.centre - mean.centre_in_camera);
    const glm::dvec3 point = mean.centre + mean.rotation * a;
    return point - glm::dot(point, axis) * axis;
}

// Sets the distance and the height of aim; false if a camera is not on the circle or does not look at the axis.
bool measure_turn(const Rig& rig, const glm::dvec3& in_camera, TurnAxis& turn) {
    const auto count = static_cast<double>(rig.views.size());
    double height = 0, towards = 0;
    std::vector<glm::dvec2> places;  // distance from the axis, height
    for (const RigView& view : rig.views) {
        const Camera& camera = view.camera;
        const glm::dvec3 off = camera.centre() - turn.point;
        const double along = glm::dot(off, turn.direction);
        const double distance = glm::length(off - along * turn.direction);
        places.emplace_back(distance, along);
        turn.distance += distance / count;
        height += along / count;
        const double pitch = glm::dot(camera.forward(), turn.direction);
        const double level = std::sqrt(std::max(0.0, 1 - pitch * pitch));
        const double nearing = approach(camera, turn.direction, turn.point);
        if (!(std::abs(nearing) > kMinAim * distance * level)) return false;
        towards += nearing > 0 ? 1 : -1;
        turn.aim_height += (along + pitch * nearing / (level * level)) / count;
        const glm::dvec3 seen = glm::transpose(rotation_of(view)) * turn.direction;
        if (glm::dot(seen, in_camera) < std::cos(radians(kMaxDeviation_deg))) return false;
    }
    return std::abs(towards) == count && std::ranges::all_of(places, [&](const glm::dvec2& place) {
               return glm::length(place - glm::dvec2(turn.distance, height)) < kMaxDeviation * turn.distance;
           });
}

// Up in the photos, or along the frame's own upper side if photos are stored on their side.
void orient_axis(const Rig& rig, TurnAxis& turn) {
    constexpr double kMinUp = 0.1;
    glm::dvec3 up(0);
    for (const RigView& view : rig.views) {
        const bool is_away = approach(view.camera, turn.direction, turn.point) < 0;  // OpenCV's axes: Y is down
        up += (is_away ? -1.0 : 1.0) * view.camera.up() / static_cast<double>(rig.views.size());
    }
    double side = glm::dot(up, turn.direction);
    if (std::abs(side) < kMinUp) side = turn.direction.y + turn.direction.z;
    if (side >= 0) return;
    turn.direction = -turn.direction;
    turn.aim_height = -turn.aim_height;
}

std::string point_text(const glm::dvec3& p) {
    std::string text;
    for (int i = 0; i < 3; ++i) {
        char number[32];
        const bool is_rounding = std::abs(p[i]) < 1e-6 * glm::length(p);
        std::snprintf(number, sizeof number, "%.4g", is_rounding ? 0.0 : p[i]);
        text += (i == 0 ? "(" : ", ") + std::string(number);
    }
    return text + ")";
}

}  // namespace

std::optional<TurnAxis> find_turn_axis(const Rig& rig) {
    if (rig.views.size() < kMinTurnViews) return std::nullopt;
    // A rotation about an axis leaves it in its place in the camera: the mean of the rotations keeps its length, and
    // shortens all directions across.
    const PoseMeans mean = pose_means(rig);
    const glm::dmat3 scatter = mean.rotation * glm::transpose(mean.rotation);
    const double across = (scatter[0][0] + scatter[1][1] + scatter[2][2] - 1) / 2;
    if (!(across < kMaxMeanRotation2)) return std::nullopt;
    TurnAxis turn;
    turn.direction = dominant_eigenvector(scatter);
    const glm::dvec3 in_camera = glm::transpose(mean.rotation) * turn.direction;
    if (!(glm::length(in_camera) > std::cos(radians(kMaxDeviation_deg)))) return std::nullopt;
    turn.point = axis_point(mean, turn.direction, glm::normalize(in_camera));
    if (!measure_turn(rig, glm::normalize(in_camera), turn)) return std::nullopt;
    orient_axis(rig, turn);
    return turn;
}

std::string align_turn_axis(Rig& rig) {
    const auto posed = rig.extras.find(kPosedKey);
    const bool is_posed = posed != rig.extras.end() && posed->is_boolean() && posed->get<bool>();
    if (rig.object_radius > 0 || rig.foot_height || is_posed) return {};
    const std::optional<TurnAxis> turn = find_turn_axis(rig);
    if (!turn) return {};
    const double tilt_rad = std::acos(std::clamp(turn->direction.y, -1.0, 1.0));
    const bool is_tilted = tilt_rad > radians(kNegligible_deg);
    if (!is_tilted && glm::length(turn->point) <= kNegligible * turn->distance) return {};
    const bool is_aside = std::abs(turn->aim_height) > turn->distance;
    const glm::dvec3 origin = turn->point + (is_aside ? turn->aim_height : 0.0) * turn->direction;
    const glm::dquat rotation(turn->direction, glm::dvec3(0, 1, 0));
    for (RigView& view : rig.views) {
        const glm::dvec3 centre = rotation * (view.camera.centre() - origin);
        view.camera.world_from_camera = glm::dmat4(glm::mat3_cast(rotation) * rotation_of(view));
        view.camera.world_from_camera[3] = glm::dvec4(centre, 1);
    }
    std::string text =
        "the cameras are one turn about another axis than Y; the frame's origin is moved to " + point_text(origin);
    if (is_tilted) text += ", and the axis " + point_text(turn->direction) + " becomes Y";
    return text;
}

bool convert_opencv_axes(Rig& rig) {
    const auto looks_away = [](const RigView& view) {
        return approach(view.camera, glm::dvec3(0, 1, 0), glm::dvec3(0)) < 0;
    };
    if (rig.views.size() < 3 || !std::ranges::all_of(rig.views, looks_away)) return false;
    for (RigView& view : rig.views) {
        for (const int axis : {1, 2}) view.camera.world_from_camera[axis] = -view.camera.world_from_camera[axis];
    }
    return true;
}

std::vector<std::string> apply_rig_conventions(Rig& rig) {
    std::vector<std::string> messages;
    if (std::string aligned = align_turn_axis(rig); !aligned.empty()) messages.push_back(std::move(aligned));
    if (convert_opencv_axes(rig)) {
        messages.emplace_back("all cameras look away from the object; their axes are taken as OpenCV's (Y down)");
    }
    return messages;
}

}  // namespace rs
