#pragma once
// Two-level acceleration structure for the instances of a scene: one tree per part, built once, and a small tree over
// the instances, the only one rebuilt when instances move. Part of ray_scene.

#include "capture/tracer/rays/mesh_tree.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace rs::capture {

// Transform of an instance at one time.
struct InstanceTransform {
    glm::mat4 world_from_part;
    glm::mat3 normals;  // inverse transpose of its upper left part
};

class InstanceTree {
public:
    /// Keeps a reference to `scene`, whose instance matrices may change before calls of update().
    static Result<InstanceTree> build(RTCDeviceTy* device, const Scene& scene);

    /// Reads the matrices of these instances from the scene. Not thread-safe with tracing.
    void update(std::span<const std::size_t> moved);

    [[nodiscard]] RTCSceneTy* embree() const { return top_.get(); }
    [[nodiscard]] InstanceTransform transform_at(std::size_t instance, float time) const;
    // Returns true if any instance moves while the shutter is open.
    [[nodiscard]] bool blurred() const { return blurred_ > 0; }
    [[nodiscard]] const glm::vec3& lower() const { return lower_; }  // bounds of all instances over the shutter time
    [[nodiscard]] const glm::vec3& upper() const { return upper_; }
    [[nodiscard]] bool empty() const { return lower_.x > upper_.x; }
    [[nodiscard]] std::int64_t top_builds() const { return top_builds_; }

private:
    struct Placement {
        glm::mat4 open{1.0F}, close{1.0F};
        glm::mat3 normals{1.0F};  // for `open`
        bool blurred = false;
        glm::vec3 lower{1.0F}, upper{-1.0F};
    };

    void place(std::size_t instance);
    void commit();

    const Scene* scene_ = nullptr;
    std::vector<MeshTree> trees_;  // [part]
    EmbreeScene top_;
    std::vector<Placement> placements_;
    int blurred_ = 0;
    std::int64_t top_builds_ = 0;
    glm::vec3 lower_{1.0F};
    glm::vec3 upper_{-1.0F};
};

}  // namespace rs::capture
