#pragma once
// Reference for composited frames: the same scene with the objects' meshes instead of their images, traced from the
// same camera.
//
// Each sample takes the nearest hit of geometry and meshes. Meshes are traced in their own coordinates with the light
// of their capture, clipped to the range of photos. Geometry is shaded by the formula of VRML97 (ISO/IEC 14772-1,
// 4.14.4), implemented here independently from the standard, with the lights of the scene. There are no shadows between
// the two.

#include "capture/tracer/integrator/surface.hpp"
#include "capture/tracer/light/light_set.hpp"
#include "capture/tracer/rays/ray_scene.hpp"
#include "capture/tracer/scene/scene.hpp"
#include "compositor/scene/scene.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace rs::test {

// Object as it was in front of the capture camera.
class TracedObject {
public:
    // \param object_radius length of the object radius in the mesh's units (capture::SceneFile). The scene must have
    // passed capture::check_scene.
    static Result<std::shared_ptr<const TracedObject>> create(capture::Scene scene, double object_radius);

    [[nodiscard]] double object_radius() const { return object_radius_; }
    [[nodiscard]] const capture::Scene& scene() const { return scene_; }
    [[nodiscard]] const capture::RayScene& rays() const { return *rays_; }
    [[nodiscard]] const capture::LightSet& lights() const { return *lights_; }
    [[nodiscard]] const std::vector<capture::SurfaceModel>& models() const { return models_; }

private:
    TracedObject(capture::Scene scene, double object_radius)
        : scene_(std::move(scene)), object_radius_(object_radius) {}
    capture::Scene scene_;
    double object_radius_;
    std::optional<capture::RayScene> rays_;
    std::optional<capture::LightSet> lights_;
    std::vector<capture::SurfaceModel> models_;
};

struct TracedNode {
    std::shared_ptr<const TracedObject> object;
    compositor::Similarity world_from_object;  // object radii to scene units
};

struct TruthImage {
    Image<Rgba8> image;     // opaque
    Image<float> objects;   // fraction of the pixel covered by objects
    Image<float> unhidden;  // same without geometry
};

struct TruthOptions {
    int samples = 16;          // per pixel, powers of two are stratified best
    int paths_per_sample = 4;  // for samples that hit an object
};

class TruthScene {
public:
    // Uses the scene's geometry, lights and background; geometry must be opaque triangles without vertex colours and
    // fog.
    static Result<TruthScene> create(const compositor::Scene& scene, std::vector<TracedNode> nodes);
    // Multithreaded; the result does not depend on the number of threads.
    [[nodiscard]] TruthImage render(const Camera& camera, const TruthOptions& options) const;

private:
    struct Room;
    TruthScene(std::shared_ptr<const Room> room, std::vector<TracedNode> nodes)
        : room_(std::move(room)), nodes_(std::move(nodes)) {}
    std::shared_ptr<const Room> room_;
    std::vector<TracedNode> nodes_;
};

}  // namespace rs::test
