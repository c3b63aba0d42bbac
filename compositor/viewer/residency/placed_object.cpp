#include "compositor/viewer/residency/placed_object.hpp"

#include "rayspace/base/json_text.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/light/capture_irradiance.hpp"

#include <utility>

namespace rs::compositor {
namespace {

Result<std::optional<IrradianceHarmonics>> capture_irradiance_of(const RaySpaceObject& object) {
    std::optional<IrradianceHarmonics> irradiance;
    if (object.rig_json.find(kCaptureIrradianceKey) == std::string::npos) return irradiance;
    RS_ASSIGN_OR_RETURN(const nlohmann::json rig, parse_json(object.rig_json, object.name + " (its rig)"));
    const auto key = rig.find(kCaptureIrradianceKey);
    if (key == rig.end()) return irradiance;
    RS_ASSIGN_OR_RETURN(irradiance, irradiance_from_json(*key, object.name + " (its rig): " + kCaptureIrradianceKey));
    return irradiance;
}

}  // namespace

std::int64_t ViewableObject::memory_bytes() const {
    const std::int64_t board = for_board ? object_memory_bytes(*for_board) : 0;
    return static_cast<std::int64_t>(sizeof(ViewableObject)) + renderer.memory_bytes() + board;
}

Result<ViewableObject> make_viewable(RaySpaceObject object) {
    const BoundingCylinder bounds = bounding_cylinder(object);
    const UprightExtent extent = estimated_extent(object);
    RS_ASSIGN_OR_RETURN(const std::optional<IrradianceHarmonics> irradiance, capture_irradiance_of(object));
    RS_ASSIGN_OR_RETURN(engine::Renderer renderer, engine::Renderer::create(std::move(object)));
    ViewableObject viewable{std::move(renderer), bounds, extent};
    viewable.capture_irradiance = irradiance;
    return viewable;
}

PlacedObject place(std::shared_ptr<const ViewableObject> object, const RaySpaceNode& node) {
    Similarity world_from_object = world_from_node(node.chain);
    if (node.standing) {
        world_from_object = world_from_object * Similarity{glm::dmat3(1.0), {0, -object->extent.bottom, 0}, 1};
    }
    return {std::move(object), world_from_object};
}

}  // namespace rs::compositor
