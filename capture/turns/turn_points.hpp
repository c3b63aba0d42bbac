#pragma once
/// \file
/// Registration of turns by object points: points that are triangulated within each turn are matched by their
/// descriptors, and a consensus of the pairs gives the placement.

#include "capture/calibration/points/descriptor_products.hpp"
#include "capture/calibration/points/tracks.hpp"
#include "capture/turns/turn_placement.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace rs::capture {

/// Object points of a calibrated turn, in its object frame.
struct TurnPoints {
    std::vector<Track> tracks;          ///< observations in px of the photos
    std::vector<glm::dvec3> points;     ///< [track]
    Descriptors descriptors;            ///< of up to three observations per track
    std::vector<std::size_t> track_of;  ///< [descriptor]
};

/// Tracks features by guided matching and triangulates them. Error: OpenCV fails.
Result<TurnPoints> find_turn_points(const TurnImages& turn, const TurntableModel& model);

struct PointPair {
    std::size_t first = 0;   ///< track of the first turn
    std::size_t second = 0;  ///< track of the second turn
};

/// Pairs of points with similar descriptors, by Lowe's ratio test between points. Some are wrong.
std::vector<PointPair> match_points(const TurnPoints& first, const TurnPoints& second);

struct PointRegistration {
    TurnPlacement placement;       ///< of the second turn, relative to the frame of the first points
    std::vector<PointPair> pairs;  ///< those that agree with it
};

/// Placement about the common axis with the most agreeing pairs. `first_points` are in the common frame. Each pair
/// alone determines azimuth, scale and height, so all hypotheses are tested. Nothing if fewer than kFewestPairs agree.
std::optional<PointRegistration> register_points(std::span<const glm::dvec3> first_points,
                                                 std::span<const glm::dvec3> second_points,
                                                 std::span<const PointPair> pairs);

/// Placement of a turn for which the object was laid down otherwise: the similarity with the most agreeing pairs, by
/// RANSAC over three pairs. Nothing if fewer than kFewestReorientedPairs agree, or if its axis is within
/// kLeastAxisTilt_deg of the common one.
std::optional<PointRegistration> register_reoriented_points(std::span<const glm::dvec3> first_points,
                                                            std::span<const glm::dvec3> second_points,
                                                            std::span<const PointPair> pairs);

/// Pairs whose points, both in the common frame, are near each other.
std::vector<PointPair> pairs_near(std::span<const glm::dvec3> first_points, std::span<const glm::dvec3> second_points,
                                  std::span<const PointPair> pairs);

inline constexpr std::size_t kFewestPairs = 12;
inline constexpr std::size_t kFewestReorientedPairs = 16;  ///< more numbers are free
inline constexpr double kLeastAxisTilt_deg = 5;

}  // namespace rs::capture
