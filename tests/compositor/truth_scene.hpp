#pragma once
// The scene by which composited frames are compared with the truth (truth_image.hpp): a room with a table, a shelf, a
// plinth, pillars and a low screen, procedural objects, and eight viewpoints of a visitor's walk.

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

// Procedural objects that the room shows.
std::vector<std::string> truth_object_names();

// Writes the room as VRML97 with its textures into `folder`, which should hold NAME.rso of all the names, and reads it
// again.
Result<compositor::Scene> write_truth_room(const std::filesystem::path& folder);

struct TruthViewpoint {
    std::string what;  // a few words for tables
    Camera camera;
};
std::vector<TruthViewpoint> truth_walk(int width, int height);

// How an object is photographed for the comparison.
struct TruthCapture {
    std::vector<double> elevations_deg = {4, 10, 16};  // one ring each: about where a visitor's eyes are
    int views = 60;                                    // of each ring
    int side_px = 384;
    int samples = 16;  // per pixel
};

// The procedural object of the recipe NAME.json: mesh, light and camera.
Result<capture::SceneFile> object_of_recipe(const std::string& name);

// Reads the objects of the scene's nodes and places them, in their order.
Result<std::vector<compositor::PlacedObject>> read_placed_objects(const compositor::Scene& scene);

// As the tracer has it in the truth.
Result<std::shared_ptr<const TracedObject>> traced_object(capture::SceneFile object);

// Captures it, encodes it as rs-encode does by default, and writes folder/NAME.rso.
Status write_captured_object(const std::string& name, capture::SceneFile object, const TruthCapture& capture,
                             const std::filesystem::path& folder, Progress* progress = nullptr);

}  // namespace rs::test
