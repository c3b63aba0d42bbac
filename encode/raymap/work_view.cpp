#include "encode/raymap/work_view.hpp"

#include <algorithm>

namespace rs::encode {
namespace {

Rgba8 block_mean(ConstImageView<Rgba8> picture, int x0, int y0, int side) {
    int r = 0, g = 0, b = 0, a = 0;
    for (int y = y0; y < y0 + side; ++y) {
        for (int x = x0; x < x0 + side; ++x) {
            const Rgba8 pixel = picture(x, y);
            r += pixel.r * pixel.a;
            g += pixel.g * pixel.a;
            b += pixel.b * pixel.a;
            a += pixel.a;
        }
    }
    if (a == 0) return {};
    const auto mean = [](int sum, int weight) { return static_cast<std::uint8_t>((sum + weight / 2) / weight); };
    return {mean(r, a), mean(g, a), mean(b, a), mean(a, side * side)};
}

}  // namespace

HorizontalRay WorkView::ray_of(double column) const {
    HorizontalRay ray;
    const glm::dvec2 direction = forward + right * ((column - cx) / fl_x);
    ray.horizontal_per_axial = glm::length(direction);
    ray.along = direction / ray.horizontal_per_axial;
    ray.to_foot = -glm::dot(centre, ray.along);
    ray.foot = centre + ray.to_foot * ray.along;
    return ray;
}

SeenColumn WorkView::see(const glm::dvec2& place) const {
    const glm::dvec2 from_centre = place - centre;
    const double axial = glm::dot(from_centre, forward);
    return {axial, cx + fl_x * glm::dot(from_centre, right) / axial};
}

WorkView make_work_view(const Camera& camera, ConstImageView<Rgba8> picture, int reduction) {
    WorkView view;
    view.width = picture.width() / reduction;
    view.height = picture.height() / reduction;
    view.fl_x = camera.fl_x / reduction;
    view.fl_y = camera.fl_y / reduction;
    view.cx = camera.cx / reduction;
    view.cy = camera.cy / reduction;
    view.centre = {camera.centre().x, camera.centre().z};
    view.centre_y = camera.centre().y;
    view.right = {camera.right().x, camera.right().z};
    view.forward = {camera.forward().x, camera.forward().z};
    view.columns = Image<Rgba8>(view.height, view.width);
    for (int column = 0; column < view.width; ++column) {
        for (int row = 0; row < view.height; ++row) {
            view.columns(row, column) = block_mean(picture, column * reduction, row * reduction, reduction);
        }
    }
    return view;
}

}  // namespace rs::encode
