#pragma once
// Photos of the mottled ball from cameras spread over the upper hemisphere.

#include "encode/posed/posed_photo.hpp"
#include "rayspace/base/conventions.hpp"
#include "tests/encode/raymap/striped_ball.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace rs::encode {

/// Camera n of `count`, spread evenly (golden angle) over elevations of 5 degrees to `highest_deg`.
inline Camera posed_camera(int n, int count, int size_px, double highest_deg = 80) {
    constexpr double kDistance = 3.5;
    const double low = std::sin(radians(5.0));
    const double sine = low + (std::sin(radians(highest_deg)) - low) * (n + 0.5) / count;
    const double cosine = std::sqrt(1 - sine * sine);
    const double azimuth = 2.399963 * n;
    const glm::dvec3 eye = kDistance * glm::dvec3(cosine * std::sin(azimuth), sine, cosine * std::cos(azimuth));
    return look_at_camera(eye, {0, 0, 0}, 0.62, size_px, size_px);
}

/// Camera n of a level turn of `count`.
inline Camera turn_camera(int n, int count, double elevation_deg, int size_px) {
    const double azimuth = 2 * kPi * n / count, elevation = radians(elevation_deg);
    const glm::dvec3 direction(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                               std::cos(elevation) * std::cos(azimuth));
    return look_at_camera(3.5 * direction, {0, 0, 0}, 0.62, size_px, size_px);
}

inline std::vector<PosedPhoto> photos_of_ball(int count, int size_px) {
    std::vector<PosedPhoto> photos;
    for (int n = 0; n < count; ++n) {
        const Camera camera = posed_camera(n, count, size_px);
        photos.push_back({"photo " + std::to_string(n), camera, mottled_ball(camera)});
    }
    return photos;
}

}  // namespace rs::encode
