#pragma once
// The geometry of a scene with its floor, as the scene's lights light it and their shadows darken it; what moves and
// what is lit anew keep each other up to date.

#include "compositor/scene/scene.hpp"
#include "compositor/viewer/drawing/floor_renderer.hpp"
#include "compositor/viewer/drawing/shown_parts.hpp"
#include "compositor/viewer/drawing/surface_renderer.hpp"
#include "compositor/viewer/residency/placed_object.hpp"
#include "compositor/viewer/shadows/shadow_maps.hpp"
#include "rayspace/base/result.hpp"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace rs::compositor {

// Needs a gl::Context that is current, and outlives it; one thread. Move-only. Scenes have raster's lights
// (raster_lights.hpp).
class LitGeometry {
public:
    static Result<LitGeometry> create(const Scene& scene, const ShownNodes& nodes, bool shadows);

    // The lights, environment and headlight of `scene`, whose geometry is that of the scene that this was made of.
    // Fails where the driver refuses a shader.
    Status set_lights(const Scene& scene, const ShownNodes& nodes);
    Status set_shadows(bool shadows, const ShownNodes& nodes);
    [[nodiscard]] bool shadows() const { return shadows_.has_value(); }
    // As SurfaceRenderer::move().
    Status move(std::size_t node, const std::optional<glm::dmat4>& world_from_node);

    // Before what is lit: brings the maps up to date and binds them. `objects` as ShadowMaps::update() takes them.
    // Returns how many maps were drawn. There must be shadows.
    int draw_shadows(const std::vector<std::optional<PlacedObject>>& objects);

    [[nodiscard]] SurfaceRenderer& surfaces() { return surfaces_; }
    [[nodiscard]] const SurfaceRenderer& surfaces() const { return surfaces_; }
    [[nodiscard]] const FloorRenderer* floor() const { return floor_ ? &*floor_ : nullptr; }

private:
    LitGeometry(const Scene& scene, SurfaceRenderer surfaces) : scene_(scene), surfaces_(std::move(surfaces)) {}
    Status light_anew(bool shadows, const ShownNodes& nodes);
    Status make_floor(const ShadowPlan& plan);

    Scene scene_;
    SurfaceRenderer surfaces_;
    std::optional<FloorRenderer> floor_;
    std::optional<ShadowMaps> shadows_;
};

}  // namespace rs::compositor
