#include "compositor/scene/scene.hpp"

namespace rs::compositor {

BoundingBox bounds_of(const Scene& scene) {
    BoundingBox all;
    for (const GeometryNode& node : scene.geometry) {
        const BoundingBox box = bounds_of(*node.mesh).moved(node.world_from_node);
        if (box.empty()) continue;
        all.include(box.lowest);
        all.include(box.highest);
    }
    return all;
}

}  // namespace rs::compositor
