#include "compositor/viewer/residency/placed_object.hpp"

#include "rayspace/format/object_memory.hpp"

#include <utility>

namespace rs::compositor {

std::int64_t ViewableObject::memory_bytes() const {
    const std::int64_t board = for_board ? memory_of(*for_board) : 0;
    return static_cast<std::int64_t>(sizeof(ViewableObject)) + renderer.memory_bytes() + board;
}

Result<ViewableObject> make_viewable(RaySpaceObject object) {
    const BoundingCylinder bounds = bounding_cylinder(object);
    const UprightExtent extent = estimated_extent(object);
    Result<engine::Renderer> renderer = engine::Renderer::create(std::move(object));
    if (!renderer) return renderer.error();
    return ViewableObject{std::move(*renderer), bounds, extent};
}

PlacedObject place(std::shared_ptr<const ViewableObject> object, const RaySpaceNode& node) {
    Similarity world_from_object = world_from_node(node.chain);
    if (node.standing) {
        world_from_object = world_from_object * Similarity{glm::dmat3(1.0), {0, -object->extent.bottom, 0}, 1};
    }
    return {std::move(object), world_from_object};
}

}  // namespace rs::compositor
