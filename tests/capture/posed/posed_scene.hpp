#pragma once
// Photos of an object of known shape, by cameras anywhere, with lens distortion as OpenCV defines it.

#include "capture/posed/cameras/posed_camera.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/image/image.hpp"

#include <opencv2/calib3d.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace rs::test {

/// Similarity from the frame of the object (Y up, origin within it) to the world of the cameras.
struct PosedWorld {
    glm::dmat3 rotation{1.0};
    double scale = 1;
    glm::dvec3 shift{0};

    [[nodiscard]] glm::dmat4 pose(const glm::dmat4& in_object) const {
        glm::dmat4 moved(rotation * glm::dmat3(in_object));
        moved[3] = glm::dvec4(rotation * glm::dvec3(in_object[3]) * scale + shift, 1);
        return moved;
    }
};

/// Z up, elsewhere and in another unit.
inline PosedWorld z_up_world() {
    return {glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0)), 0.4, {5, -3, 2}};
}

/// Level cameras around the object at several heights, the poses in the frame of the object.
inline std::vector<capture::PosedCamera> posed_cameras(int count, int width, int height) {
    std::vector<capture::PosedCamera> cameras;
    for (int i = 0; i < count; ++i) {
        const double turn = 2.399963 * i, rise = radians(-10 + 65.0 * i / std::max(1, count - 1));
        const double distance = 5.5 + 0.5 * std::sin(3.0 * i);
        const glm::dvec3 eye =
            distance * glm::dvec3(std::cos(rise) * std::sin(turn), std::sin(rise), std::cos(rise) * std::cos(turn));
        capture::PosedCamera posed;
        posed.photo = (i < 10 ? "0" : "") + std::to_string(i) + ".png";
        posed.camera = look_at_camera(eye, {0.1 * std::sin(i), 0.1, 0}, radians(48), width, height);
        if (height > width) posed.camera.fl_x = posed.camera.fl_y = posed.camera.fl_y * width / height * 1.3;
        posed.camera.cx += 2.25;
        posed.camera.cy -= 1.5;
        cameras.push_back(posed);
    }
    return cameras;
}

/// Colour and coverage along a ray in the frame of the object: an ellipsoid with half axes 1, 1.3 and 0.8, and a ball
/// of radius 0.3 at (1, 0.4, 0), with smooth patterns.
inline bool hit_object(const glm::dvec3& origin, const glm::dvec3& direction, glm::dvec3& point) {
    double nearest = 1e30;
    const auto ball = [&](const glm::dvec3& centre, const glm::dvec3& axes) {
        const glm::dvec3 o = (origin - centre) / axes, d = direction / axes;
        const double a = glm::dot(d, d), b = glm::dot(o, d), c = glm::dot(o, o) - 1;
        const double root = b * b - a * c;
        if (root < 0) return;
        const double t = (-b - std::sqrt(root)) / a;
        if (t > 0) nearest = std::min(nearest, t);
    };
    ball({0, 0, 0}, {1, 1.3, 0.8});
    ball({1, 0.4, 0}, glm::dvec3(0.3));
    point = origin + nearest * direction;
    return nearest < 1e29;
}

/// Directions of the rays through the given positions of the distorted photo, at a depth of 1, y down.
inline std::vector<cv::Point2d> undistorted_positions(const capture::PosedCamera& posed,
                                                      const std::vector<cv::Point2d>& positions) {
    const Camera& lens = posed.camera;
    const cv::Matx33d matrix(lens.fl_x, 0, lens.cx - 0.5, 0, lens.fl_y, lens.cy - 0.5, 0, 0, 1);
    std::vector<cv::Point2d> rays;
    const auto& k = posed.distortion.coefficients;
    const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 200, 1e-10);
    if (posed.distortion.model == capture::LensDistortion::Model::kFisheye) {
        cv::fisheye::undistortPoints(positions, rays, matrix, cv::Vec4d(k[0], k[1], k[2], k[3]));
    } else {
        cv::undistortPoints(positions, rays, matrix, std::vector<double>(k.begin(), k.end()), cv::noArray(),
                            cv::noArray(), until);
    }
    return rays;
}

/// The photo of a camera whose pose is in the frame of the object, with 9 rays per pixel; transparent background.
inline Image<Rgba8> posed_photo(const capture::PosedCamera& posed) {
    constexpr int kSub = 3;
    const Camera& camera = posed.camera;
    Image<Rgba8> photo(camera.width, camera.height);
    for (int y = 0; y < camera.height; ++y) {
        std::vector<cv::Point2d> positions;
        for (int x = 0; x < camera.width; ++x) {
            for (int s = 0; s < kSub * kSub; ++s) {
                positions.emplace_back(x + (s % kSub + 0.5) / kSub - 0.5, y + (s / kSub + 0.5) / kSub - 0.5);
            }
        }
        const auto rays = undistorted_positions(posed, positions);
        for (int x = 0; x < camera.width; ++x) {
            glm::dvec3 light(0);
            int hits = 0;
            for (int s = 0; s < kSub * kSub; ++s) {
                const cv::Point2d& ray = rays[static_cast<std::size_t>(x * kSub * kSub + s)];
                const glm::dvec3 direction = camera.forward() + camera.right() * ray.x - camera.up() * ray.y;
                glm::dvec3 p(0);
                if (!hit_object(camera.centre(), direction, p)) continue;
                ++hits;
                light += 0.5 + 0.4 * glm::sin(p * glm::dvec3(5, 4, 6) + glm::dvec3(0, 1, 2));
            }
            if (hits == 0) continue;
            const auto code = [&](double value) { return static_cast<std::uint8_t>(255 * value / hits); };
            photo(x, y) = {code(light.x), code(light.y), code(light.z),
                           static_cast<std::uint8_t>(255 * hits / (kSub * kSub))};
        }
    }
    return photo;
}

}  // namespace rs::test
