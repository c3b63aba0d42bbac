#include "tests/bench/ball_image.hpp"

#include "tests/support/sphere_object.hpp"

#include <algorithm>
#include <cmath>

namespace rs::bench {

Image<Rgba8> ball_image(const Camera& camera) {
    const test::Sphere ball{{0, 0, 0}, 0.85};
    Image<Rgba8> image(camera.width, camera.height);
    for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
            const glm::dvec3 ray = camera.ray(x + 0.5, y + 0.5);
            const auto met = test::hit(ball, camera.centre(), ray);
            if (!met) continue;
            const glm::dvec3 p = camera.centre() + met->enters * ray;
            const double fine = 18 * std::sin(61 * p.x + 9 * std::sin(23 * p.y)) * std::sin(53 * p.z + 31 * p.y);
            const double light = 0.7 + 0.3 * glm::dot(glm::normalize(p), glm::normalize(camera.centre()));
            const auto byte = [](double value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0)); };
            const double grey = test::grey_at(p) + fine;
            image(x, y) = {byte(grey * light), byte((0.8 * grey + 40 * std::sin(7 * p.z)) * light),
                           byte((200 - 0.6 * grey) * light), 255};
        }
    }
    return image;
}

}  // namespace rs::bench
