#pragma once
// The meshes of a scene in Embree's acceleration structure: nearest hits and occlusion, with the holes of textures cut
// out.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <memory>
#include <optional>
#include <vector>

struct RTCDeviceTy;
struct RTCSceneTy;

namespace rs::capture {

// Where a ray meets a surface. Normals are unit length and face the ray's origin.
struct SurfacePoint {
    glm::vec3 position;
    // `position` lifted onto the curved surface that the vertex normals describe, outwards only; rays to lights begin
    // here, so that coarse meshes show no faceted shadow line (J. Hanika, "Hacking the Shadow Terminator", Ray Tracing
    // Gems II).
    glm::vec3 lifted_position;
    glm::vec3 geometric_normal;
    glm::vec3 shading_normal;
    glm::vec3 along_u, along_v;  // how the place moves with uv; set where the material has relief only
    glm::vec2 uv;
    glm::vec3 colour;  // of the vertices
    float distance;
    int material;
    bool front_side;  // the side that the triangle's winding calls the outer one
};

class RayScene {
public:
    // Refers to `scene`, which must stay where it is and unchanged. Its indices must be valid (see check_scene). Fails
    // where Embree has no memory.
    static Result<RayScene> create(const Scene& scene);

    // The nearest hit beyond `origin`; `direction` has unit length. Thread-safe, as is occluded().
    bool intersect(const glm::vec3& origin, const glm::vec3& direction, SurfacePoint& point) const;
    // What a primitive answers that is nearer than `distance`.
    [[nodiscard]] std::optional<RayPrimitive::Answer> ask_primitives(const glm::vec3& origin,
                                                                     const glm::vec3& direction, float distance) const;
    // Anything between origin and origin + direction * distance, primitives included.
    [[nodiscard]] bool occluded(const glm::vec3& origin, const glm::vec3& direction, float distance) const;

    [[nodiscard]] const glm::vec3& lower() const { return lower_; }  // of all vertices that triangles use
    [[nodiscard]] const glm::vec3& upper() const { return upper_; }
    [[nodiscard]] bool empty() const { return lower_.x > upper_.x; }
    // By how much to step off a surface before the next ray, against hitting it again.
    [[nodiscard]] float step_off() const { return step_off_; }

private:
    RayScene() = default;
    static Result<RayScene> build(const Scene& scene);
    void add_primitives();

    struct Cutout {
        const Mesh* mesh;
        const Texture* texture;
    };
    struct Release {
        void operator()(RTCDeviceTy* device) const;
        void operator()(RTCSceneTy* scene) const;
    };

    const Scene* scene_ = nullptr;
    std::unique_ptr<RTCDeviceTy, Release> device_;
    std::unique_ptr<RTCSceneTy, Release> embree_scene_;
    std::unique_ptr<RTCSceneTy, Release> primitives_;  // null where there are none
    std::vector<std::unique_ptr<Cutout>> cutouts_;     // fixed addresses: Embree keeps pointers to them
    glm::vec3 lower_{1.0F};
    glm::vec3 upper_{-1.0F};
    float step_off_ = 0.0F;

    friend struct CutoutFilter;
};

}  // namespace rs::capture
