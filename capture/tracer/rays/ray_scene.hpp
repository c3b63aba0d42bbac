#pragma once
// Ray intersection with a scene: nearest hits and occlusion by Embree's acceleration structures, without texture holes.
//
//     meshes       one flattened tree                                              built once
//     instances    a tree per part, built once; above them a tree of instances, rebuilt when instances move
//     primitives   a tree of their boxes                                           built once
//
// Each ray is tested against the trees in sequence and shortened to the nearest hit so far. The time of a ray, 0 when
// the shutter opens to 1 when it closes, selects the position of moving instances.

#include "capture/tracer/packets/packet.hpp"
#include "capture/tracer/rays/instance_tree.hpp"
#include "capture/tracer/rays/mesh_tree.hpp"
#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

struct RTCIntersectContext;

namespace rs::capture {

// Intersection of a ray with a surface. Normals are unit length and face the ray's origin.
struct SurfacePoint {
    glm::vec3 position;
    // `position` lifted outwards onto the curved surface described by the vertex normals: origin of shadow rays, which
    // avoids faceted shadow terminators on coarse meshes (J. Hanika, "Hacking the Shadow Terminator", Ray Tracing
    // Gems II).
    glm::vec3 lifted_position;
    glm::vec3 geometric_normal;
    glm::vec3 shading_normal;
    glm::vec3 along_u, along_v;  // derivatives of the position by uv; set only if the material has a normal map
    glm::vec2 uv;
    glm::vec3 colour;  // interpolated vertex colour
    float distance;
    int material;
    bool front_side;        // the triangle's winding is counter-clockwise as seen from the ray's origin
    float time;             // of the ray
    bool is_light_sampled;  // LightSet samples its emission; false for instances that move while the shutter is open
    std::uint32_t light_group;  // index into LightScopes::groups
};

class RayScene {
public:
    /// Keeps a reference to `scene`, which must not be moved or changed, except before update().
    /// \param scene must pass check_scene()
    /// \return an error if Embree runs out of memory
    static Result<RayScene> create(const Scene& scene);

    /// Applies changed matrices of these instances. Not thread-safe with tracing.
    void update(std::span<const std::size_t> moved);
    /// Applies changed light scopes. Not thread-safe with tracing.
    void update_scopes();

    // All functions below are const and thread-safe; directions have unit length.

    /// Finds the nearest hit beyond `origin`.
    /// \param time 0..1
    bool intersect(const glm::vec3& origin, const glm::vec3& direction, float time, SurfacePoint& point) const;
    /// Finds the nearest surface that light of a scoped light can hit (LightScopes).
    bool intersect_in_scope(std::uint32_t light, const glm::vec3& origin, const glm::vec3& direction, float time,
                            SurfacePoint& point) const;
    /// Finds the nearest hit that is visible to camera rays, i.e. not of the surroundings (Scene).
    bool intersect_visible(const glm::vec3& origin, const glm::vec3& direction, float time, SurfacePoint& point) const;
    // Distances to the nearest hits of kBundle parallel, nearby rays; infinity for rays without a hit.
    static constexpr int kBundle = 8;
    using Bundle = std::array<float, kBundle>;
    [[nodiscard]] Bundle distances(const std::array<glm::vec3, kBundle>& origins, const glm::vec3& direction,
                                   float time) const;
    // Many rays in Embree's packets of 16, with bit-identical results to single rays; fastest if neighbouring rays are
    // similar.
    struct Ray {
        glm::vec3 origin;
        glm::vec3 direction;  // unit length
        float time;
        float reach;  // maximum distance; may be infinite
    };
    struct Hit {
        float distance = -1.0F;  // below 0: no hit
        float u = 0.0F, v = 0.0F;
        unsigned mesh = 0, triangle = 0;
        unsigned instance = ~0U;  // ~0: static mesh
        [[nodiscard]] bool met() const { return distance >= 0.0F; }
    };
    [[nodiscard]] static Hit hit_of(const RayHitLanes& met, std::size_t lane) {
        const HitLanes& hit = met.hit;
        return {met.ray.reach[lane], hit.u[lane], hit.v[lane], hit.mesh[lane], hit.triangle[lane], hit.instance[lane]};
    }
    /// \param hits one per ray
    void intersect_many(std::span<const Ray> rays, std::span<Hit> hits) const;
    /// \param hidden one per ray: 1 if occluded, primitives included, else 0
    void occluded_many(std::span<const Ray> rays, std::span<std::uint8_t> hidden) const;
    // The active lanes of a packet, initialised by RayHitLanes::begin(); other lanes are unchanged.
    void intersect(const MaskLanes& active, RayHitLanes& met) const;
    void occluded(const MaskLanes& active, RayLanes& rays, const ShadowCasters& casters = {}) const;
    // Copies the triangle hit by a lane to `triangles` and returns its mesh.
    const Mesh& gather_triangle(const RayHitLanes& met, std::size_t lane, TriangleLanes& triangles) const;
    // Surface properties at a hit.
    void surface_at(const Hit& hit, const glm::vec3& direction, float time, SurfacePoint& point) const;
    // Nearest primitive hit within `distance`.
    [[nodiscard]] std::optional<RayPrimitive::Answer> intersect_primitives(const glm::vec3& origin,
                                                                           const glm::vec3& direction,
                                                                           float distance) const;
    // Returns true if a shadow caster lies between origin and origin + direction * distance, primitives included: those
    // of a scoped light if their centre is within the bounds of the surfaces that it illuminates.
    [[nodiscard]] bool occluded(const glm::vec3& origin, const glm::vec3& direction, float distance, float time,
                                const ShadowCasters& casters = {}) const;

    // Returns true if anything moves while the shutter is open; otherwise the time of rays is ignored.
    [[nodiscard]] bool blurred() const { return instances_ && instances_->blurred(); }

    // Number of builds of triangle trees and of the instance tree above them.
    struct Builds {
        std::int64_t triangle_trees = 0;
        std::int64_t instance_trees = 0;
    };
    [[nodiscard]] Builds builds() const;

    // Bounds of all vertices used by triangles and of the boxes of all instances.
    [[nodiscard]] const glm::vec3& lower() const { return lower_; }
    [[nodiscard]] const glm::vec3& upper() const { return upper_; }
    [[nodiscard]] bool empty() const { return lower_.x > upper_.x; }
    // Offset of ray origins from a surface, against self-intersection.
    [[nodiscard]] float step_off() const { return step_off_; }

private:
    RayScene() = default;
    static Result<RayScene> build(const Scene& scene);
    // Corners of a triangle in the mesh's coordinates; place() transforms them to the world.
    struct Corners {
        std::array<glm::vec3, 3> positions;
        std::array<glm::vec3, 3> normals{};  // 0 if the mesh has none
        float winding = 1.0F;                // -1 for a mirroring instance matrix
        Corners(const Mesh& mesh, const glm::uvec3& t)
            : positions{mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]} {
            if (!mesh.normals.empty()) normals = {mesh.normals[t.x], mesh.normals[t.y], mesh.normals[t.z]};
        }
    };
    void place(unsigned instance, float time, Corners& corners) const;
    bool intersect_trees(RTCIntersectContext& context, const glm::vec3& origin, const glm::vec3& direction, float time,
                         SurfacePoint& point) const;
    void add_primitives();
    [[nodiscard]] bool primitive_occludes(const glm::vec3& origin, const glm::vec3& direction, float distance,
                                          float time, const ShadowCasters& casters) const;
    void compute_bounds();

    const Scene* scene_ = nullptr;
    // [index into Scene::lights][primitive] is in the scope of the light; empty for lights without scope.
    std::vector<std::vector<bool>> primitives_in_scope_;
    EmbreeDevice device_;
    std::optional<MeshTree> static_meshes_;
    std::optional<InstanceTree> instances_;  // empty without instances
    EmbreeScene primitives_;                 // null without primitives
    glm::vec3 lower_{1.0F};
    glm::vec3 upper_{-1.0F};
    float step_off_ = 0.0F;
};

}  // namespace rs::capture
