#include "encode/raymap/line_grid.hpp"

namespace rs::encode {
namespace {

// The ray from the viewpoint that passes the axis at signed distance p.
HorizontalRay line_ray(const glm::dvec2& viewpoint, double p) {
    const double distance = glm::length(viewpoint);
    const glm::dvec2 inwards = -viewpoint / distance;
    const glm::dvec2 sideways(-inwards.y, inwards.x);
    const double sine = p / distance;
    HorizontalRay ray;
    ray.along = inwards * std::sqrt(std::max(1 - sine * sine, 0.0)) + sideways * sine;
    ray.foot = p * glm::dvec2(-ray.along.y, ray.along.x);
    return ray;
}

}  // namespace

LinePoint project_to_line(const LineGrid& grid, const glm::dvec2& viewpoint, const glm::dvec2& place, double y) {
    const glm::dvec2 along = glm::normalize(place - viewpoint);
    LinePoint point;
    point.p = -place.x * along.y + place.y * along.x;
    point.depth = glm::dot(place, along);
    const double rho = grid.rho(point.p);
    point.h = grid.height + (y - grid.height) * rho / (rho + point.depth);
    return point;
}

CellRay::CellRay(const LineGrid& grid, const glm::dvec2& viewpoint, int p_cell) : grid_(grid) {
    const double p = grid.p_low + (p_cell + 0.5) / grid.cells_per_unit;
    rho_ = grid.rho(p);
    ray_ = line_ray(viewpoint, p);
}

double CellRay::height(int band, int depth) const {
    const double from_camera = grid_.h_low + (band + 0.5) / grid_.bands_per_unit - grid_.height;
    return grid_.height + from_camera * (rho_ - kHalfWidth + depth * kDepthStep) / rho_;
}

double CellRay::bands_at(double height, int depth) const {
    const double per_height = rho_ / (rho_ + (-kHalfWidth + depth * kDepthStep));
    return (grid_.height + (height - grid_.height) * per_height - grid_.h_low) * grid_.bands_per_unit;
}

}  // namespace rs::encode
