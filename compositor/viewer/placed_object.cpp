#include "compositor/viewer/placed_object.hpp"

#include "rayspace/object_file.hpp"

#include <map>
#include <utility>

namespace rs::compositor {

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

Result<std::vector<PlacedObject>> load_objects(const Scene& scene, Progress* progress) {
    std::map<std::filesystem::path, std::shared_ptr<const ViewableObject>> loaded;
    std::vector<PlacedObject> placed;
    if (progress != nullptr) progress->start("reading objects", static_cast<std::int64_t>(scene.objects.size()));
    for (const RaySpaceNode& node : scene.objects) {
        std::shared_ptr<const ViewableObject>& object = loaded[node.file];
        if (!object) {
            Result<RaySpaceObject> read = read_object(node.file);
            if (!read) return read.error();
            Result<ViewableObject> viewable = make_viewable(std::move(*read));
            if (!viewable) return viewable.error();
            object = std::make_shared<const ViewableObject>(std::move(*viewable));
        }
        placed.push_back(place(object, node));
        if (progress != nullptr) progress->advance();
    }
    if (progress != nullptr) progress->finish();
    return placed;
}

}  // namespace rs::compositor
