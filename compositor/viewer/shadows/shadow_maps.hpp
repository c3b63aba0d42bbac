#pragma once
// The shadow maps of a scene on the GPU. They are drawn once, and again only where something has changed: what never
// moves is kept in maps of its own from the first change on, and copied.

#include "compositor/gl/depth_array.hpp"
#include "compositor/gl/program.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/viewer/residency/placed_object.hpp"
#include "compositor/viewer/shadows/shadow_plan.hpp"
#include "rayspace/base/result.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace rs::compositor {

enum class Casters {
    kAll,
    kStill,   // geometry that stands where it is for good
    kMoving,  // geometry that may be moved
};

// Geometry to be drawn on a map.
struct ShadowPass {
    ShadowFace face;
    Casters casters = Casters::kAll;
    // What lies outside of this projection's image need not be drawn.
    glm::dmat4 area_from_world{1.0};
};

// Needs a gl::Context that is current, and outlives it; one thread. Move-only.
class ShadowMaps {
public:
    using DrawGeometry = std::function<void(const ShadowPass&)>;

    static Result<ShadowMaps> create(ShadowPlan plan);
    [[nodiscard]] const ShadowPlan& plan() const { return plan_; }

    // Before what reads the maps is drawn; other drawing must begin its framebuffer anew. `objects` are those that
    // throw shadows now, [node of the scene] where there is one; the shell of one that was not there before is made,
    // some ten milliseconds. `draw_geometry` draws that of the pass into the framebuffer that has begun, depths only.
    // Returns how many maps were drawn on.
    int update(const std::vector<std::optional<PlacedObject>>& objects, const DrawGeometry& draw_geometry);
    // The shells of objects that another plan's maps have made already.
    void take_shells(const ShadowMaps& from) { objects_ = from.objects_; }
    // Geometry that may be moved has come, moved or gone in this box, scene coordinates: what it may cover on the maps
    // is drawn anew by the next update().
    void touch(const BoundingBox& box);
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
    struct Maps {
        std::optional<gl::DepthArray> all;    // nothing where the plan has none of this kind
        std::optional<gl::DepthArray> still;  // what never moves, from the first change on
    };
    [[nodiscard]] int side_of(const ShadowFace& face) const {
        return face.of_cube ? plan_.cube_side : plan_.plane_side;
    }
    [[nodiscard]] Maps& maps_of(const ShadowFace& face) { return face.of_cube ? cubes_ : planes_; }
    [[nodiscard]] const Maps& maps_of(const ShadowFace& face) const { return face.of_cube ? cubes_ : planes_; }
    void draw_objects(const ShadowPass& pass) const;
    void draw_whole(const ShadowFace& face, const DrawGeometry& draw_geometry) const;
    bool keep_still(std::size_t face, const DrawGeometry& draw_geometry);
    void draw_areas(const ShadowFace& face, const std::vector<gl::TexelArea>& areas,
                    const DrawGeometry& draw_geometry) const;

    ShadowPlan plan_;
    gl::Program program_;
    Maps planes_;
    Maps cubes_;
    std::vector<bool> still_drawn_;  // [face of the plan]
    std::vector<Thrown> objects_;
    std::vector<BoundingBox> touched_;  // since the last update
    bool drawn_ = false;                // else all of them are drawn by the next update
};

}  // namespace rs::compositor
