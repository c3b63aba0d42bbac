#include "compositor/viewer/drawing/object_nodes.hpp"

#include "compositor/viewer/drawing/placeholder_renderer.hpp"

namespace rs::compositor {

PlacedObject ObjectNodes::turned(std::size_t index) const {
    PlacedObject placed = *(*nodes_)[index].object;
    const double angle = placed.world_from_object.mirrors() ? -turns_rad_[index] : turns_rad_[index];
    placed.world_from_object = placed.world_from_object * NodeTransform{.angle_rad = angle}.parent_from_node();
    return placed;
}

std::optional<ObjectView> ObjectNodes::view_of(std::size_t index, const Camera& camera) const {
    const DisplayedNode& node = (*nodes_)[index];
    if (!node.object || node.hidden) return std::nullopt;
    return view_of_object(turned(index), camera, {object_samples_, upright_});
}

bool ObjectNodes::placeholder_in_view(std::size_t index, const FrameView& view) const {
    const DisplayedNode& node = (*nodes_)[index];
    return node.placeholder && !node.hidden && can_be_visible(bounds_of(*node.placeholder), view.clip_from_world);
}

std::vector<std::optional<PlacedObject>> ObjectNodes::shadow_casters() const {
    constexpr float kLeastOpacity = 0.5F;  // of an object that fades in
    std::vector<std::optional<PlacedObject>> objects(nodes_->size());
    for (std::size_t i = 0; i < nodes_->size(); ++i) {
        const DisplayedNode& node = (*nodes_)[i];
        if (node.object && !node.hidden && node.opacity >= kLeastOpacity) objects[i] = turned(i);
    }
    return objects;
}

}  // namespace rs::compositor
