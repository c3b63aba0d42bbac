#pragma once
// The ray-space nodes of a frame, with the angles by which the user has turned them. No OpenGL; one thread.

#include "compositor/viewer/drawing/displayed_nodes.hpp"
#include "compositor/viewer/residency/placed_object.hpp"
#include "compositor/viewer/views/object_view.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"
#include "rayspace/geometry/camera.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace rs::compositor {

class ObjectNodes {
public:
    /// \param object_samples most samples across a pixel, for distant objects (object_view.hpp)
    /// \param upright render objects for a level camera in the same place and resample (upright_image.hpp)
    ObjectNodes(std::shared_ptr<const DisplayedNodes> nodes, int object_samples, bool upright)
        : nodes_(std::move(nodes)), turns_rad_(nodes_->size()), object_samples_(object_samples), upright_(upright) {}

    [[nodiscard]] std::size_t size() const { return nodes_->size(); }
    [[nodiscard]] const DisplayedNodes& shown() const { return *nodes_; }
    [[nodiscard]] const DisplayedNode& operator[](std::size_t index) const { return (*nodes_)[index]; }

    /// Turns a node about its object's axis, counter-clockwise seen from above, relative to the scene.
    void turn(std::size_t index, double angle_rad) { turns_rad_[index] = angle_rad; }
    /// The node's object as it is turned; the node must have one.
    [[nodiscard]] PlacedObject turned(std::size_t index) const;

    /// The view of the node's object; nullopt if it is hidden, not loaded or not visible.
    [[nodiscard]] std::optional<ObjectView> view_of(std::size_t index, const Camera& camera) const;
    [[nodiscard]] bool placeholder_in_view(std::size_t index, const FrameView& view) const;

    /// The objects that cast shadows, by node; nullopt for hidden, missing and mostly transparent ones.
    [[nodiscard]] std::vector<std::optional<PlacedObject>> shadow_casters() const;

private:
    std::shared_ptr<const DisplayedNodes> nodes_;
    std::vector<double> turns_rad_;  // [node]
    int object_samples_;
    bool upright_;
};

}  // namespace rs::compositor
