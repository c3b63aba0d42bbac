#include "engine/core/views/depth_image.hpp"

#include "engine/core/definition/view_registers.hpp"

#include <cmath>

namespace rs::engine {

Image<float> depth_image(const RaySpaceObject& object, const Camera& camera, ConstImageView<std::int32_t> lambda_q20) {
    const glm::dvec3 centre = camera.centre() / object.units_per_radius;
    const double to_viewpoint = glm::dot(prepared_viewpoint(object, camera) - centre, camera.forward());
    Image<float> depth(lambda_q20.width(), lambda_q20.height());
    for (int j = 0; j < depth.height(); ++j) {
        for (int i = 0; i < depth.width(); ++i) {
            const std::int32_t lambda = lambda_q20(i, j);
            if (lambda == 0) continue;
            depth(i, j) = static_cast<float>((std::ldexp(static_cast<double>(lambda), -20) + to_viewpoint) *
                                             object.units_per_radius);
        }
    }
    return depth;
}

}  // namespace rs::engine
