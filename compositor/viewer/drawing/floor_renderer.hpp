#pragma once
// Draws a scene's floor, lit by its directional lights and shadowed by what stands on it.

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

// Needs a gl::Context that is current, and outlives it; one thread. Move-only.
class FloorRenderer {
public:
    // `scene` has a floor. Where lights have maps by `shadows`, these are bound (ShadowMaps::bind) when it is drawn.
    static Result<FloorRenderer> create(const Scene& scene, const ShadowPlan& shadows);
    void draw(const FrameView& view) const;

private:
    FloorRenderer(gl::Program program, const Floor& floor) : program_(std::move(program)), floor_(floor), square_(4) {}

    gl::Program program_;
    Floor floor_;
    glm::vec3 light_{0};       // that falls on it from above, whatever stands there
    glm::vec3 background_{0};  // into which it fades
    std::vector<glm::vec4> shadowed_;
    std::vector<ShadowRow> shadows_;
    gl::VertexArray square_;
};

}  // namespace rs::compositor
