#pragma once
// Floor renderer: a checkered disc lit by the scene's directional lights, with shadows.

#include "compositor/gl/program.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/viewer/drawing/surface_tables.hpp"
#include "compositor/viewer/shadows/shadow_plan.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <vector>

namespace rs::compositor {

/// Requires a current gl::Context that outlives it; single-threaded, move-only.
class FloorRenderer {
public:
    /// \param scene must have a floor.
    /// \param shadows if it contains maps, they must be bound (ShadowMaps::bind) for draw().
    static Result<FloorRenderer> create(const Scene& scene, const ShadowPlan& shadows);
    void draw(const FrameView& view) const;

private:
    FloorRenderer(gl::Program program, const Floor& floor) : program_(std::move(program)), floor_(floor), square_(4) {}

    gl::Program program_;
    Floor floor_;
    glm::vec3 light_{0};       // unshadowed irradiance from above
    glm::vec3 background_{0};  // colour at the rim
    std::vector<glm::vec4> shadowed_;
    std::vector<ShadowRow> shadows_;
    gl::VertexArray square_;
};

}  // namespace rs::compositor
