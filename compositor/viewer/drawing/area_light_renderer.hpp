#pragma once
// Draws area lights as unlit shapes of their radiance, one-sided, as traced renderers show them
// (capture::RenderOptions::show_areas). They hide nothing in the depth buffer, so that a light that is dragged is not
// placed on itself.

#include "compositor/gl/program.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/light/light.hpp"

#include <optional>
#include <vector>

namespace rs::compositor {

/// Requires a current gl::Context that outlives it; single-threaded, move-only.
class AreaLightRenderer {
public:
    static Result<AreaLightRenderer> create();

    /// \param lights of any kind, before their conversion to raster lights.
    void set_lights(const std::vector<Light>& lights, double exposure_ev);

    /// Draws over geometry and background, back to front; tests depth.
    void draw(const FrameView& view, const std::optional<Fog>& fog) const;

private:
    explicit AreaLightRenderer(gl::Program program) : program_(std::move(program)), square_(4) {}

    gl::Program program_;
    gl::VertexArray square_;
    std::vector<Light> areas_;  // colours scaled by the exposure
};

}  // namespace rs::compositor
