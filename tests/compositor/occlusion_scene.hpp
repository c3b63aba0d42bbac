#pragma once
// What the tests of occlusion show: an object of coloured blocks that looks different from everywhere, and geometry of
// which it is hidden.

#include "capture/tracer/scene/scene_file.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/viewer/residency/placed_object.hpp"
#include "tests/compositor/truth_image.hpp"

#include <memory>

namespace rs::test {

// A grey base, a red post on its left, a blue arm from the post's top to the right, and a yellow block before the base.
// It stands 1.6 radii high, its foot 0.8 below the middle.
capture::SceneFile signpost();

// The signpost, captured with small images and encoded, and as the truth has it. Made once.
struct Signpost {
    std::shared_ptr<const compositor::ViewableObject> viewable;
    std::shared_ptr<const TracedObject> traced;
};
const Signpost& captured_signpost();

// Light from one side, no geometry, a pale background.
compositor::Scene empty_room();
// A box with sides `size` about `centre`, turned about Y.
void add_box(compositor::Scene& scene, const glm::dvec3& size, const glm::dvec3& centre, const glm::vec3& colour,
             double turn_rad = 0);

}  // namespace rs::test
