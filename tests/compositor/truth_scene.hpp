#pragma once
// Scene of the comparison with references (truth_image.hpp): a room with a table, a shelf, a plinth, pillars and a low
// screen, procedural objects, and eight viewpoints of a visitor's walk.

#include "capture/tracer/scene/scene_file.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/viewer/residency/placed_object.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"
#include "tests/compositor/truth_image.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace rs::test {

// Names of the procedural objects in the room.
std::vector<std::string> truth_object_names();

// Writes the room as VRML97 with its textures into `folder`, which should contain NAME.rso for all names, and reads it
// back.
Result<compositor::Scene> write_truth_room(const std::filesystem::path& folder);

struct TruthViewpoint {
    std::string what;  // short label for tables
    Camera camera;
};
std::vector<TruthViewpoint> truth_walk(int width, int height);

// Capture parameters of the objects.
struct TruthCapture {
    std::vector<double> elevations_deg = {4, 10, 16};  // one ring each: about the heights of a visitor's eyes
    int views = 60;                                    // per ring
    int side_px = 384;
    int samples = 16;  // per pixel
};

// Procedural object of the recipe NAME.json: mesh, light and camera.
Result<capture::SceneFile> object_of_recipe(const std::string& name);

// Reads and places the objects of the scene's nodes, in their order.
Result<std::vector<compositor::PlacedObject>> read_placed_objects(const compositor::Scene& scene);

// Object for the tracer of the reference.
Result<std::shared_ptr<const TracedObject>> traced_object(capture::SceneFile object);

// Captures the object, encodes it with the defaults of rs-encode, and writes folder/NAME.rso.
Status write_captured_object(const std::string& name, capture::SceneFile object, const TruthCapture& capture,
                             const std::filesystem::path& folder, Progress* progress = nullptr);

}  // namespace rs::test
