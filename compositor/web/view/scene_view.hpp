#pragma once
// One object in a scene on a page: its image and depth from an eye point, from the fast core. The geometry is that of
// the desktop compositor (compositor/viewer/views/object_view.hpp). Not thread-safe.

#include "compositor/viewer/views/object_view.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace rs::web {

/// An object in a scene, and the eye. Images depend on the eye alone, not on the direction of sight.
struct SceneSight {
    glm::dmat4 world_from_node{1.0};  // similarity; the object's radius is 1 in the node
    bool standing = true;             // RaySpaceNode::standing
    glm::dvec3 eye{0};
    double focal_px = 1;         // focal length of the page's camera
    int max_pixels = 1'000'000;  // of the screen rectangle; larger ones are rendered at lower resolution
};

/// A view towards the object's middle. `screen` is the virtual screen that `view` refers to, in scene coordinates.
struct SceneView {
    Camera screen;
    compositor::ObjectView view;
    Image<Rgba8> image;   // straight alpha
    Image<float> depths;  // axial depths of the image's camera, rig units; 0 where transparent
};

class SceneObject {
public:
    /// Opens an .rso file in memory. `name` begins the messages of errors. Bounds are measured in the photos of the
    /// first progressive level.
    static Result<SceneObject> open(std::vector<std::byte> file, const std::string& name);

    [[nodiscard]] const compositor::ViewableObject& object() const { return *object_; }

    /// Renders what the eye sees. \return false if it sees nothing (view_of_object); error if the sight is out of range
    Result<bool> render(const SceneSight& sight, SceneView& rendered) const;

private:
    explicit SceneObject(std::shared_ptr<const compositor::ViewableObject> object) : object_(std::move(object)) {}

    std::shared_ptr<const compositor::ViewableObject> object_;
};

}  // namespace rs::web
