#include "compositor/viewer/placed_object.hpp"

#include "rayspace/object_file.hpp"

#include <map>
#include <utility>

namespace rs::compositor {
namespace {

Result<ViewableObject> read_viewable(const std::filesystem::path& file) {
    Result<RaySpaceObject> read = read_object(file);
    if (!read) return read.error();
    return make_viewable(std::move(*read));
}

}  // namespace

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

Result<std::vector<PlacedObject>> load_objects(Scene& scene, Progress* progress) {
    struct Loaded {
        std::shared_ptr<const ViewableObject> object;  // null where the file cannot be shown
        std::string why;
    };
    std::map<std::filesystem::path, Loaded> loaded;
    std::vector<RaySpaceNode> shown;
    std::vector<PlacedObject> placed;
    if (progress != nullptr) progress->start("reading objects", static_cast<std::int64_t>(scene.objects.size()));
    for (RaySpaceNode& node : scene.objects) {
        const auto [found, is_new] = loaded.try_emplace(node.file);
        Loaded& file = found->second;
        if (is_new) {
            Result<ViewableObject> viewable = read_viewable(node.file);
            if (viewable) {
                file.object = std::make_shared<const ViewableObject>(std::move(*viewable));
            } else {
                file.why = viewable.error().message;
                scene.warnings.push_back(file.why + "; shown without this object");
            }
        }
        if (file.object) {
            placed.push_back(place(file.object, node));
            shown.push_back(std::move(node));
        } else if (node.required) {
            return Error{file.why};
        }
        if (progress != nullptr) progress->advance();
    }
    if (progress != nullptr) progress->finish();
    scene.objects = std::move(shown);
    return placed;
}

}  // namespace rs::compositor
