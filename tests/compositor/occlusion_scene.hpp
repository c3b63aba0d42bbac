#pragma once
// Scene of the occlusion tests: an object of coloured blocks that looks different from every side, and occluding
// geometry.

#include "capture/tracer/scene/scene_file.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/viewer/residency/placed_object.hpp"
#include "tests/compositor/truth_image.hpp"

#include <memory>

namespace rs::test {

// A grey base, a red post on its left, a blue arm from the post's top to the right, and a yellow block in front of the
// base. Its height is 1.6 radii, its foot 0.8 below the centre.
capture::SceneFile signpost();

// The signpost, captured with small images and encoded, and its mesh. Created once.
struct Signpost {
    std::shared_ptr<const compositor::ViewableObject> viewable;
    std::shared_ptr<const TracedObject> traced;
};
const Signpost& captured_signpost();

// Light from one side, no geometry, a pale background.
compositor::Scene empty_room();
// Box with sides `size` about `centre`, rotated about Y.
void add_box(compositor::Scene& scene, const glm::dvec3& size, const glm::dvec3& centre, const glm::vec3& colour,
             double turn_rad = 0);

}  // namespace rs::test
