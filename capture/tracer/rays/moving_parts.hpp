#pragma once
// The instances of a scene in Embree: each part is a tree of its own that is built once; above them stands one small
// tree over the instances, and whoever moves an instance touches that only. Part of ray_scene.

#include "capture/tracer/rays/mesh_tree.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace rs::capture {

// How an instance stands at one time.
struct PlacedAt {
    glm::mat4 world_from_part;
    glm::mat3 normals;  // the inverse of its upper left part, transposed
};

class MovingParts {
public:
    // Refers to `scene`, whose matrices may change between calls of update().
    static Result<MovingParts> build(RTCDeviceTy* device, const Scene& scene);

    // Takes the matrices of these instances from the scene. Not while rays are traced.
    void update(std::span<const std::size_t> moved);

    [[nodiscard]] RTCSceneTy* embree() const { return top_.get(); }
    [[nodiscard]] PlacedAt placed_at(std::size_t instance, float time) const;
    // Whether anything moves while the shutter is open.
    [[nodiscard]] bool blurred() const { return blurred_ > 0; }
    [[nodiscard]] const glm::vec3& lower() const { return lower_; }  // of the boxes of all instances, moves included
    [[nodiscard]] const glm::vec3& upper() const { return upper_; }
    [[nodiscard]] bool empty() const { return lower_.x > upper_.x; }
    [[nodiscard]] std::int64_t top_builds() const { return top_builds_; }

private:
    struct Placement {
        glm::mat4 open{1.0F}, close{1.0F};
        glm::mat3 normals{1.0F};  // at the opening
        bool blurred = false;
        glm::vec3 lower{1.0F}, upper{-1.0F};
    };

    void place(std::size_t instance);
    void commit();

    const Scene* scene_ = nullptr;
    std::vector<MeshTree> trees_;  // of the parts
    EmbreeScene top_;
    std::vector<Placement> placements_;
    int blurred_ = 0;
    std::int64_t top_builds_ = 0;
    glm::vec3 lower_{1.0F};
    glm::vec3 upper_{-1.0F};
};

}  // namespace rs::capture
