#pragma once
// Floor renderer: a checkered disc that fades into the background, lit like other surfaces (kLighting), with shadows.
// It has no fog and no weather cover. Scoped lights do not reach it.

#include "compositor/gl/program.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/scene/light/environment_irradiance.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/viewer/drawing/surface_kind.hpp"
#include "compositor/viewer/drawing/surface_tables.hpp"
#include "compositor/viewer/shadows/shadow_plan.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <optional>
#include <utility>
#include <vector>

namespace rs::compositor {

/// Requires a current gl::Context that outlives it; single-threaded, move-only.
class FloorRenderer {
public:
    /// \param scene must have a floor.
    /// \param shadows if it contains maps, they must be bound (ShadowMaps::bind) for draw().
    /// \param environment of Scene::environment, null without.
    static Result<FloorRenderer> create(const Scene& scene, const ShadowPlan& shadows,
                                        const std::optional<IrradianceHarmonics>& environment);
    /// Compiles a shader only if the numbers of lights change. Of more than kMaxCountedLights lights the last ones are
    /// ignored.
    Status set_lights(const Scene& scene, const ShadowPlan& shadows,
                      const std::optional<IrradianceHarmonics>& environment);
    /// Sets ShadowPlan::cascade_rows() for the next draws.
    void set_cascades(std::vector<glm::vec4> rows) { cascades_ = std::move(rows); }
    void draw(const FrameView& view) const;

private:
    explicit FloorRenderer(const Floor& floor) : floor_(floor), square_(4) {}

    std::optional<gl::Program> program_;
    SurfaceKind kind_;  // of program_
    Floor floor_;
    MaterialRow material_;
    std::vector<LightRow> lights_;
    std::vector<ShadowRow> shadows_;
    std::vector<glm::vec4> cascades_;
    std::optional<IrradianceHarmonics> environment_;
    glm::vec3 background_{0};  // colour at the rim
    gl::VertexArray square_;
};

}  // namespace rs::compositor
