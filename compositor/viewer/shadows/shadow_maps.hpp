#pragma once
// The shadow maps of a scene on the GPU. They are drawn once, and again only those in which something has changed.

#include "compositor/gl/depth_array.hpp"
#include "compositor/gl/program.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/viewer/residency/placed_object.hpp"
#include "compositor/viewer/shadows/shadow_plan.hpp"
#include "rayspace/base/result.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace rs::compositor {

// Needs a gl::Context that is current, and outlives it; one thread. Move-only.
class ShadowMaps {
public:
    static Result<ShadowMaps> create(ShadowPlan plan);
    [[nodiscard]] const ShadowPlan& plan() const { return plan_; }

    // Before what reads the maps is drawn; other drawing must begin its framebuffer anew. `objects` are those that
    // throw shadows now, [node of the scene] where there is one; the shell of one that was not there before is made,
    // some ten milliseconds. `draw_geometry` draws that of the face into the framebuffer that has begun, depths only.
    // Returns how many maps were drawn.
    int update(const std::vector<std::optional<PlacedObject>>& objects,
               const std::function<void(const ShadowFace&)>& draw_geometry);
    // The shells of objects that another plan's maps have made already.
    void take_shells(const ShadowMaps& from) { objects_ = from.objects_; }
    // Geometry in this box, scene coordinates, has come, moved or gone: the maps that it may be on are drawn anew by
    // the next update().
    void touch(const BoundingBox& box) {
        if (!box.empty()) touched_.push_back(box);
    }
    // For shaders with shadow_shaders.hpp.
    void bind() const;

    // Of a face, for tests.
    [[nodiscard]] Image<float> read(const ShadowFace& face) const;

private:
    // What a node showed when the maps were drawn last.
    struct Thrown {
        bool there = false;
        std::weak_ptr<const ViewableObject> object;  // not held: who walks on frees its memory
        glm::dmat4 world_from_object{1.0};
        BoundingBox box{};
        std::shared_ptr<const gl::VertexArray> shell;  // null: it is empty
    };
    ShadowMaps(ShadowPlan plan, gl::Program program) : plan_(std::move(plan)), program_(std::move(program)) {}
    [[nodiscard]] Thrown thrown_by(const std::optional<PlacedObject>& placed) const;
    void draw_face(const ShadowFace& face, const std::function<void(const ShadowFace&)>& draw_geometry) const;

    ShadowPlan plan_;
    gl::Program program_;
    std::optional<gl::DepthArray> planes_;
    std::optional<gl::DepthArray> cubes_;
    std::vector<Thrown> objects_;
    std::vector<BoundingBox> touched_;  // since the last update
    bool drawn_ = false;
};

}  // namespace rs::compositor
