#pragma once
// The surfaces of a scene in Embree's acceleration structures: nearest hits and occlusion, with the holes of textures
// cut out.
//
//     meshes       one flattened tree                                              built once
//     instances    a tree of each part, built once; above them a tree of instances built anew when something moves
//     primitives   a tree of their boxes                                           built once
//
// Each ray asks one after the other, what it met before being its end. Rays have a time, 0 where the shutter opens and
// 1 where it closes, at which they see what moves.

#include "capture/tracer/packets/packet.hpp"
#include "capture/tracer/rays/mesh_tree.hpp"
#include "capture/tracer/rays/moving_parts.hpp"
#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

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
    bool front_side;   // the side that the triangle's winding calls the outer one
    float time;        // of the ray
    bool light_drawn;  // where it shines, LightSet draws points of it: it stands still while the shutter is open
};

class RayScene {
public:
    // Refers to `scene`, which must stay where it is and unchanged, but for update(). Its indices must be valid (see
    // check_scene). Fails where Embree has no memory.
    static Result<RayScene> create(const Scene& scene);

    // After matrices of these instances of the scene have changed. Not while rays are traced.
    void update(std::span<const std::size_t> moved);

    // The nearest hit beyond `origin`; `direction` has unit length, `time` is 0..1. Thread-safe, as is occluded().
    bool intersect(const glm::vec3& origin, const glm::vec3& direction, float time, SurfacePoint& point) const;
    // The nearest hit that is not of what surrounds the object (Scene).
    bool intersect_seen(const glm::vec3& origin, const glm::vec3& direction, float time, SurfacePoint& point) const;
    // How far it is to the nearest hits of kBundle rays of one direction, which are near to each other; infinity where
    // a ray meets nothing.
    static constexpr int kBundle = 8;
    using Bundle = std::array<float, kBundle>;
    [[nodiscard]] Bundle distances(const std::array<glm::vec3, kBundle>& origins, const glm::vec3& direction,
                                   float time) const;
    // The same for many rays, in Embree's packets of 16: the same bits, and the quicker the more alike neighbouring
    // rays are. As many results as rays.
    struct Ray {
        glm::vec3 origin;
        glm::vec3 direction;  // unit length
        float time;
        float reach;  // what is farther away counts nothing; may be infinite
    };
    struct Hit {
        float distance = -1.0F;  // below 0: nothing was met
        float u = 0.0F, v = 0.0F;
        unsigned mesh = 0, triangle = 0;
        unsigned instance = ~0U;  // ~0: a mesh that stands still
        [[nodiscard]] bool met() const { return distance >= 0.0F; }
    };
    [[nodiscard]] static Hit hit_of(const MetLanes& met, std::size_t lane) {
        const HitLanes& hit = met.hit;
        return {met.ray.reach[lane], hit.u[lane], hit.v[lane], hit.mesh[lane], hit.triangle[lane], hit.instance[lane]};
    }
    void intersect_many(std::span<const Ray> rays, std::span<Hit> hits) const;
    // 1 where something is in the way, primitives included; else 0.
    void occluded_many(std::span<const Ray> rays, std::span<std::uint8_t> hidden) const;
    // The same for the lanes `asked` of a packet; the others are left as they are. MetLanes::begin() comes before.
    void intersect(const MaskLanes& asked, MetLanes& met) const;
    void occluded(const MaskLanes& asked, RayLanes& rays) const;
    // The triangle that a lane has met, and its mesh.
    const Mesh& triangle_of(const MetLanes& met, std::size_t lane, TriangleLanes& triangles) const;
    // What is where a ray has met something.
    void surface_at(const Hit& hit, const glm::vec3& direction, float time, SurfacePoint& point) const;
    // What a primitive answers that is nearer than `distance`.
    [[nodiscard]] std::optional<RayPrimitive::Answer> ask_primitives(const glm::vec3& origin,
                                                                     const glm::vec3& direction, float distance) const;
    // Anything between origin and origin + direction * distance, primitives included.
    [[nodiscard]] bool occluded(const glm::vec3& origin, const glm::vec3& direction, float distance, float time) const;

    // Whether anything moves while the shutter is open; else the time of rays counts nothing.
    [[nodiscard]] bool blurred() const { return moving_ && moving_->blurred(); }

    // How often trees of triangles were built, and the tree of instances above them.
    struct Builds {
        std::int64_t of_triangles = 0;
        std::int64_t of_instances = 0;
    };
    [[nodiscard]] Builds builds() const;

    // Of all vertices that triangles use; of instances, of their parts' boxes.
    [[nodiscard]] const glm::vec3& lower() const { return lower_; }
    [[nodiscard]] const glm::vec3& upper() const { return upper_; }
    [[nodiscard]] bool empty() const { return lower_.x > upper_.x; }
    // By how much to step off a surface before the next ray, against hitting it again.
    [[nodiscard]] float step_off() const { return step_off_; }

private:
    RayScene() = default;
    static Result<RayScene> build(const Scene& scene);
    // Of a triangle, as its mesh has it; place() puts it where its instance is.
    struct Corners {
        std::array<glm::vec3, 3> places;
        std::array<glm::vec3, 3> normals{};  // 0 where the mesh has none
        float winding = 1.0F;                // -1 where an instance mirrors
        Corners(const Mesh& mesh, const glm::uvec3& t)
            : places{mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]} {
            if (!mesh.normals.empty()) normals = {mesh.normals[t.x], mesh.normals[t.y], mesh.normals[t.z]};
        }
    };
    [[nodiscard]] const Mesh& mesh_of(unsigned mesh, unsigned instance) const;
    void place(unsigned instance, float time, Corners& corners) const;
    void add_primitives();
    [[nodiscard]] bool primitive_occludes(const glm::vec3& origin, const glm::vec3& direction, float distance,
                                          float time) const;
    void measure();

    const Scene* scene_ = nullptr;
    EmbreeDevice device_;
    std::optional<MeshTree> still_;
    std::optional<MovingParts> moving_;  // nothing where there are no instances
    EmbreeScene primitives_;             // null where there are none
    glm::vec3 lower_{1.0F};
    glm::vec3 upper_{-1.0F};
    float step_off_ = 0.0F;
};

}  // namespace rs::capture
