#pragma once
// Synthetic turns of a point cloud with ground truth, for tests of point-based calibration.

#include "capture/calibration/model/turntable_model.hpp"
#include "capture/calibration/points/bundle.hpp"
#include "rayspace/base/conventions.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace rs::test {

// 1000 x 800 px, elevation 20 degrees, equal steps.
inline capture::TurntableModel turn_model(int views, double step_rad, double roll_rad = 0.02) {
    capture::TurntableModel model;
    model.lens = {1000, 800, 1700, 500, 400, -0.1, 0};
    model.pose = {0.012, radians(20), roll_rad};
    for (int i = 0; i < views; ++i) model.angles_rad.push_back(i * step_rad);
    return model;
}

struct SurfacePoint {
    glm::dvec3 p{0.0};  // on the object at angle 0
    double facing_rad = 0;
};

// Points on an upright body at the centre of turn_model()'s image, at various distances from the axis.
inline std::vector<SurfacePoint> surface_points(int count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0, 1);
    std::vector<SurfacePoint> points;
    for (int i = 0; i < count; ++i) {
        const double facing = 2 * kPi * share(random);
        const double radius = 0.07 + 0.11 * share(random);
        const double height = -std::tan(radians(20)) + 0.24 * (share(random) - 0.5);
        points.push_back({{radius * std::sin(facing), height, radius * std::cos(facing)}, facing});
    }
    return points;
}

// Camera of view i, if the views have different cameras.
using ModelOfView = std::vector<capture::TurntableModel>;

// Points are visible within 65 degrees of facing the camera. Result: [point]; points with fewer than three views have
// no track.
inline std::vector<capture::Track> tracks_of(const ModelOfView& models, const std::vector<SurfacePoint>& points,
                                             double noise_px, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, 1);
    std::vector<capture::Track> tracks;
    for (const SurfacePoint& point : points) {
        capture::Track track;
        for (std::size_t view = 0; view < models.size(); ++view) {
            const capture::TurntableModel& model = models[view];
            const double angle = model.angles_rad[view];
            if (std::cos(point.facing_rad + angle) < std::cos(radians(65))) continue;
            const auto p = capture::project(model.lens, model.pose, capture::turned(point.p, angle));
            if (!p || p->x < 0 || p->y < 0 || p->x > model.lens.width || p->y > model.lens.height) continue;
            const double dx = noise_px * noise(random), dy = noise_px * noise(random);
            track.seen.push_back({static_cast<int>(view), *p + glm::dvec2(dx, dy), glm::dmat2(1.0)});
        }
        if (track.seen.size() >= 3) tracks.push_back(std::move(track));
    }
    return tracks;
}

inline std::vector<capture::Track> tracks_of(const capture::TurntableModel& model,
                                             const std::vector<SurfacePoint>& points, double noise_px,
                                             std::uint32_t seed) {
    return tracks_of(ModelOfView(model.angles_rad.size(), model), points, noise_px, seed);
}

// Pairs of neighbouring views as a matcher would report them.
inline std::vector<capture::MatchedPair> pairs_of(const std::vector<capture::Track>& tracks) {
    std::map<std::pair<int, int>, capture::MatchedPair> pairs;
    for (const capture::Track& track : tracks) {
        for (std::size_t i = 1; i < track.seen.size(); ++i) {
            const capture::Observation &a = track.seen[i - 1], &b = track.seen[i];
            capture::MatchedPair& pair = pairs[{a.view, b.view}];
            pair.first = a.view;
            pair.second = b.view;
            ++pair.matches;
            pair.spread_x_px += std::abs(b.p.x - a.p.x);
            pair.spread_y_px += std::abs(b.p.y - a.p.y);
        }
    }
    std::vector<capture::MatchedPair> all;
    for (auto& [views, pair] : pairs) {
        pair.spread_x_px /= pair.matches;
        pair.spread_y_px /= pair.matches;
        all.push_back(pair);
    }
    return all;
}

// A bundle with a slightly wrong start.
inline capture::TurntableModel disturbed(capture::TurntableModel model) {
    model.lens.f_px *= 1.08;
    model.lens.k1 = 0;
    model.pose.pan_rad += 0.01;
    model.pose.tilt_rad += 0.05;
    model.pose.roll_rad -= 0.02;
    for (std::size_t i = 1; i < model.angles_rad.size(); ++i) model.angles_rad[i] += i % 2 == 0 ? 0.02 : -0.015;
    return model;
}

// "000.jpg", ...
inline std::vector<std::string> photograph_names(std::size_t views) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < views; ++i) {
        char name[32];
        std::snprintf(name, sizeof name, "%03zu.jpg", i);
        names.emplace_back(name);
    }
    return names;
}

}  // namespace rs::test
