#include "engine/model/limits/board_limits.hpp"

#include <algorithm>

namespace rs::engine {
namespace {

Error over(const RaySpaceObject& object, const std::string& what, std::int64_t value, std::int64_t limit,
           const std::string& remedy) {
    return Error{object.name + ": " + what + " " + std::to_string(value) + ", more than the board's " +
                 std::to_string(limit) + "; " + remedy};
}

}  // namespace

Status within_limits(const RaySpaceObject& object, const BoardLimits& limits) {
    const auto images = static_cast<std::int64_t>(object.views.size());
    if (images > limits.images_per_object) {
        return over(object, "images:", images, limits.images_per_object, "use fewer views");
    }
    if (std::max(object.width, object.height) > limits.image_side_px) {
        return over(object, "image side:", std::max(object.width, object.height), limits.image_side_px,
                    "scale the images down");
    }
    for (const Ring& ring : object.rings) {
        if (ring.planes > limits.planes) {
            return over(object, "reference planes:", ring.planes, limits.planes, "encode it with fewer --planes");
        }
        if (std::max(ring.x_cells, ring.u_cells) > limits.map_side) {
            return over(object, "RS map side:", std::max(ring.x_cells, ring.u_cells), limits.map_side,
                        "encode it with fewer --cells");
        }
        if (ring.shape.bands > limits.shape_bands) {
            return over(object, "bands of height in its shape map:", ring.shape.bands, limits.shape_bands,
                        "encode it from smaller images, or with --raymap plane");
        }
    }
    if (object.rings.size() > 1) {
        return over(object, "rings of views:", static_cast<std::int64_t>(object.rings.size()), 1,
                    "encode each ring as an object of its own");
    }
    return {};
}

std::uint64_t image_buffer_bytes(const BoardLimits& limits) {
    const auto side = static_cast<std::uint64_t>(limits.image_buffer_side_px);
    return 2 * static_cast<std::uint64_t>(limits.views_per_cycle) * side * side * sizeof(Rgba8);
}

}  // namespace rs::engine
