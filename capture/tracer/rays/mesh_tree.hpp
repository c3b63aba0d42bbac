#pragma once
// Embree acceleration structure over meshes in a common coordinate system: one flattened tree. Part of ray_scene.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <memory>
#include <vector>

struct RTCDeviceTy;
struct RTCSceneTy;

namespace rs::capture {

struct ReleaseEmbree {
    void operator()(RTCDeviceTy* device) const;
    void operator()(RTCSceneTy* scene) const;
};
using EmbreeDevice = std::unique_ptr<RTCDeviceTy, ReleaseEmbree>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, ReleaseEmbree>;

class MeshTree {
public:
    /// Geometry m is meshes[m]; meshes without triangles are omitted. Texture holes are excluded from hits. Keeps
    /// references to `scene`, which must contain `meshes`.
    /// \return an error if Embree runs out of memory
    static Result<MeshTree> build(RTCDeviceTy* device, const std::vector<Mesh>& meshes, const Scene& scene);

    [[nodiscard]] RTCSceneTy* embree() const { return embree_.get(); }
    [[nodiscard]] const glm::vec3& lower() const { return lower_; }  // bounds of all vertices used by triangles
    [[nodiscard]] const glm::vec3& upper() const { return upper_; }
    [[nodiscard]] bool empty() const { return lower_.x > upper_.x; }

private:
    struct Cutout {
        const Mesh* mesh;
        const Texture* texture;
    };
    friend struct CutoutFilter;

    EmbreeScene embree_;
    std::vector<std::unique_ptr<Cutout>> cutouts_;  // Embree keeps pointers to the elements
    glm::vec3 lower_{1.0F};
    glm::vec3 upper_{-1.0F};
};

}  // namespace rs::capture
