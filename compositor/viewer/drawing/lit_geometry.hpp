#pragma once
// Scene geometry and floor with their lighting and shadow maps. Keeps the maps and the surface tables consistent when
// lights change or nodes move.

#include "compositor/scene/light/environment_irradiance.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/viewer/drawing/displayed_nodes.hpp"
#include "compositor/viewer/drawing/floor_renderer.hpp"
#include "compositor/viewer/drawing/surface_renderer.hpp"
#include "compositor/viewer/residency/placed_object.hpp"
#include "compositor/viewer/shadows/shadow_maps.hpp"
#include "rayspace/base/result.hpp"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace rs::compositor {

/// Requires a current gl::Context that outlives it; single-threaded, move-only. Scenes contain raster lights
/// (scene_lights.hpp) and an environment scaled by the exposure.
class LitGeometry {
public:
    static Result<LitGeometry> create(const Scene& scene, const DisplayedNodes& nodes, bool shadows);

    /// Copies lights, environment and headlight from `scene`, which must have the same geometry as the scene passed to
    /// create(). Fails if the driver rejects a shader.
    Status set_lights(const Scene& scene, const DisplayedNodes& nodes);
    Status set_shadows(bool shadows, const DisplayedNodes& nodes);
    [[nodiscard]] bool shadows() const { return shadows_.has_value(); }
    /// See SurfaceRenderer::move().
    Status move(std::size_t node, const std::optional<glm::dmat4>& world_from_node);

    /// Updates the shadow maps and binds them; call it before drawing lit surfaces. Requires shadows().
    /// \param eye, objects see ShadowMaps::update().
    /// \return number of redrawn maps.
    int draw_shadows(const glm::dvec3& eye, const std::vector<std::optional<PlacedObject>>& objects);

    [[nodiscard]] const std::optional<EnvironmentLight>& environment() const { return scene_.environment; }
    /// Irradiance at a position, without shadows and lights with a scope; nullopt if only the headlight shines.
    std::optional<IrradianceHarmonics> irradiance_at(const glm::dvec3& position);

    [[nodiscard]] SurfaceRenderer& surfaces() { return surfaces_; }
    [[nodiscard]] const SurfaceRenderer& surfaces() const { return surfaces_; }
    [[nodiscard]] const FloorRenderer* floor() const { return floor_ ? &*floor_ : nullptr; }

private:
    LitGeometry(const Scene& scene, EnvironmentIrradiance irradiance, SurfaceRenderer surfaces)
        : scene_(scene), irradiance_(std::move(irradiance)), surfaces_(std::move(surfaces)) {}
    Status rebuild_lighting(bool shadows, const DisplayedNodes& nodes);
    Status light_floor(const ShadowPlan& plan, const std::optional<IrradianceHarmonics>& environment);

    Scene scene_;
    EnvironmentIrradiance irradiance_;
    SurfaceRenderer surfaces_;
    std::optional<FloorRenderer> floor_;
    std::optional<ShadowMaps> shadows_;
};

}  // namespace rs::compositor
