#pragma once
// State of one frame, shared by its passes. Each pass reads the results of the passes before it.

#include "compositor/gl/framebuffer.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/scene/weather.hpp"
#include "compositor/viewer/drawing/area_light_renderer.hpp"
#include "compositor/viewer/drawing/background_renderer.hpp"
#include "compositor/viewer/drawing/frame_statistics.hpp"
#include "compositor/viewer/drawing/lit_geometry.hpp"
#include "compositor/viewer/drawing/object_nodes.hpp"
#include "compositor/viewer/drawing/surface_renderer.hpp"
#include "compositor/viewer/views/engine_views.hpp"
#include "compositor/viewer/views/object_view.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace rs::compositor {

/// The framebuffers of a frame: a multisampled one that is drawn into, and one that its samples are averaged into.
struct FrameTarget {
    gl::Framebuffer drawn;
    std::optional<gl::Framebuffer> resolved;  // only if `drawn` has several samples per pixel

    /// Fails if the driver cannot create framebuffers of this size.
    static Result<FrameTarget> create(int width, int height, int samples);
    /// The framebuffer with one sample per pixel.
    [[nodiscard]] const gl::Framebuffer& shown() const { return resolved ? *resolved : drawn; }
    [[nodiscard]] float depth_at(int x, int y) const { return drawn.depth_at(x, y, shown()); }
};

/// Measures the parts of a frame.
class PartClock {
public:
    /// \param waits wait until everything is drawn before each measurement; otherwise only submission is measured
    explicit PartClock(bool waits) : waits_(waits) {}
    /// Seconds since the last call, or since construction.
    double lap();

private:
    bool waits_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// An object that is visible in the frame.
struct VisibleNode {
    std::size_t index = 0;
    ObjectView view;
};

/// A draw call that blends over what is farther away.
struct BlendedDraw {
    double distance = 0;     // from the camera, scene units
    bool is_object = false;  // ray-space object or its placeholder
    std::function<void()> draw;
};

struct FrameContext {
    // Set by the compositor.
    FrameView view;
    FrameTarget& target;
    LitGeometry& geometry;
    const BackgroundRenderer& background;
    const AreaLightRenderer& area_lights;
    const ObjectNodes& nodes;
    FrameStatistics& statistics;
    EngineViews engine_views;
    PartClock clock;
    const Image<Rgba8>* traced = nullptr;  // of background and opaque geometry; null: they are rasterized
    bool needs_depths = false;             // of geometry, also if nothing in the frame needs them
    bool wire_frame = false;
    std::optional<Weather> weather;
    double weather_s = 0;  // since the beginning of the sequence
    std::optional<Fog> fog;
    // Irradiance at an object, nullopt if it is not relit; empty: none is.
    std::function<std::optional<IrradianceHarmonics>(const PlacedObject&)> irradiance;

    // Set by the passes.
    std::vector<VisibleNode> visible_nodes;                          // ObjectRequestPass
    std::vector<SurfaceRenderer::Transparent> transparent_surfaces;  // DepthPass or OpaquePass
    std::vector<BlendedDraw> blended;                                // ObjectPass, TransparentPass, WeatherPass
};

}  // namespace rs::compositor
