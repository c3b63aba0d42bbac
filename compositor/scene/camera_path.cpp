#include "compositor/scene/camera_path.hpp"

#include "rayspace/api/types/check.hpp"

#include <algorithm>
#include <cmath>

namespace rs::compositor {
namespace {

// Uniform Catmull-Rom segment from b (t = 0) to c (t = 1).
glm::dvec3 catmull_rom(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d, double t) {
    return 0.5 * (2.0 * b + t * ((c - a) + t * ((2.0 * a - 5.0 * b + 4.0 * c - d) + t * (3.0 * (b - c) + d - a))));
}

}  // namespace

std::vector<CameraPose> poses_along(const CameraPath& path) {
    RS_CHECK(!path.keys.empty() && path.frames >= 1);
    const int count = static_cast<int>(path.keys.size());
    const auto key = [&](int i) -> const CameraPose& {
        const int wrapped = path.closed ? ((i % count) + count) % count : std::clamp(i, 0, count - 1);
        return path.keys[static_cast<std::size_t>(wrapped)];
    };
    const double steps = path.closed ? path.frames : std::max(path.frames - 1, 1);
    const double segments = path.closed ? count : count - 1;
    std::vector<CameraPose> poses;
    for (int frame = 0; frame < path.frames; ++frame) {
        const double place = segments * frame / steps;
        const int i = static_cast<int>(std::floor(place));
        const double t = place - i;
        poses.push_back({catmull_rom(key(i - 1).eye, key(i).eye, key(i + 1).eye, key(i + 2).eye, t),
                         catmull_rom(key(i - 1).at, key(i).at, key(i + 1).at, key(i + 2).at, t)});
    }
    return poses;
}

std::vector<CameraPose> poses_around(const CameraPose& pose, int count) {
    RS_CHECK(count >= 1);
    const glm::dvec3 arm = pose.eye - pose.at;
    std::vector<CameraPose> poses;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * kPi * i / count;
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        poses.push_back({pose.at + glm::dvec3(c * arm.x + s * arm.z, arm.y, c * arm.z - s * arm.x), pose.at});
    }
    return poses;
}

}  // namespace rs::compositor
