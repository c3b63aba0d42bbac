#pragma once
// A picture of any projection: which ray each pixel position stands for. For lenses that are not pinholes.

#include <glm/glm.hpp>

#include <functional>

namespace rs::capture {

struct RayPicture {
    int width = 0;  // px
    int height = 0;
    glm::dvec3 centre{0.0};              // all rays start here, in world coordinates
    glm::dvec3 forward{0.0, 0.0, -1.0};  // unit length; axial depth counts along it
    // Direction, of any length, through pixel position (x, y); called from several threads at once.
    std::function<glm::dvec3(double x, double y)> ray;
};

}  // namespace rs::capture
