#pragma once
// Shadow maps of a scene on the GPU, redrawn only where casters changed: from the first change on, static geometry is
// cached in separate maps and copied.

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
    kStatic,  // geometry without GeometryNode::moving
    kMoving,  // geometry with GeometryNode::moving
};

/// Geometry pass of one map.
struct ShadowPass {
    ShadowFace face;
    Casters casters = Casters::kAll;
    // Geometry outside this projection's image may be skipped.
    glm::dmat4 area_from_world{1.0};
};

/// Requires a current gl::Context that outlives it; single-threaded, move-only.
class ShadowMaps {
public:
    using DrawGeometry = std::function<void(const ShadowPass&)>;

    static Result<ShadowMaps> create(ShadowPlan plan);
    [[nodiscard]] const ShadowPlan& plan() const { return plan_; }

    /// Redraws outdated maps; call it before drawing what reads them, and begin() the framebuffer again afterwards.
    /// \param eye viewpoint of the frame, in whose surroundings cascades are.
    /// \param objects [node of the scene] current shadow casters; nullopt for none. The shell of a new object is built
    /// here, in about 10 ms.
    /// \param draw_geometry draws the casters of a pass into the current framebuffer, depth only.
    /// \return number of redrawn maps.
    int update(const glm::dvec3& eye, const std::vector<std::optional<PlacedObject>>& objects,
               const DrawGeometry& draw_geometry);
    /// Reuses the object shells of another instance.
    void reuse_shells(const ShadowMaps& from) { objects_ = from.objects_; }
    /// Marks a box (scene coordinates) in which movable geometry appeared, moved or vanished; the next update() redraws
    /// the map areas that it covers.
    void invalidate(const BoundingBox& box);
    /// Binds the maps for shaders with shadow_shaders.hpp.
    void bind() const;

    /// Reads back one map; for tests.
    [[nodiscard]] Image<float> read(const ShadowFace& face) const;

private:
    // Caster of a node when the maps were last drawn.
    struct CasterState {
        bool there = false;
        std::weak_ptr<const ViewableObject> object;  // weak: evicted objects free their memory
        glm::dmat4 world_from_object{1.0};
        BoundingBox box{};
        std::shared_ptr<const gl::VertexArray> shell;  // null if empty
    };
    ShadowMaps(ShadowPlan plan, gl::Program program) : plan_(std::move(plan)), program_(std::move(program)) {}
    [[nodiscard]] CasterState caster_state(const std::optional<PlacedObject>& placed) const;
    struct Maps {
        std::optional<gl::DepthArray> all;              // empty if the plan has no such maps
        std::optional<gl::DepthArray> static_geometry;  // static geometry, from the first change on
    };
    [[nodiscard]] int side_of(const ShadowFace& face) const {
        return face.of_cube ? plan_.cube_side : plan_.plane_side;
    }
    [[nodiscard]] Maps& maps_of(const ShadowFace& face) { return face.of_cube ? cubes_ : planes_; }
    [[nodiscard]] const Maps& maps_of(const ShadowFace& face) const { return face.of_cube ? cubes_ : planes_; }
    void draw_objects(const ShadowPass& pass) const;
    std::vector<BoundingBox> take_changed_boxes(const std::vector<std::optional<PlacedObject>>& objects);
    bool update_map(std::size_t face, const std::vector<BoundingBox>& changed, const DrawGeometry& draw_geometry);
    void redraw_map(const ShadowFace& face, const DrawGeometry& draw_geometry) const;
    bool cache_static_geometry(std::size_t face, const DrawGeometry& draw_geometry);
    void draw_areas(const ShadowFace& face, const std::vector<gl::TexelArea>& areas,
                    const DrawGeometry& draw_geometry) const;

    ShadowPlan plan_;
    gl::Program program_;
    Maps planes_;
    Maps cubes_;
    std::vector<bool> valid_;          // [face of the plan] false: the next update() draws the whole map
    std::vector<bool> static_cached_;  // [face of the plan]
    std::vector<CasterState> objects_;
    std::vector<BoundingBox> invalid_boxes_;  // since the last update
};

}  // namespace rs::compositor
