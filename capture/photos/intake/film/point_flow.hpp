#pragma once
// Motion of points between two small grey images: pyramidal Lucas-Kanade (J.-Y. Bouguet, "Pyramidal Implementation of
// the Lucas Kanade Feature Tracker", 2000) with a forward-backward check.

#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace rs::capture {

struct PointFlow {
    glm::dvec2 at_px{};    // in the first image
    glm::dvec2 flow_px{};  // to the second
};

/// Points on a regular grid where `region` is not 0, the image has corners and the patches of both images match.
/// Patches that are equal without any motion are left out: they show the background. \param from, to, region  One size.
/// Motion up to about 12 px is followed.
std::vector<PointFlow> point_flow(const Image<std::uint8_t>& from, const Image<std::uint8_t>& to,
                                  const Image<std::uint8_t>& region);

}  // namespace rs::capture
