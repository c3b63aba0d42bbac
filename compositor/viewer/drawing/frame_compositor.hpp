#pragma once
// Composites frames from the scene's geometry, drawn with a depth buffer, and the engine's images of the ray-space
// nodes, each at the depth of its reference plane.
//
// A frame is a list of passes over one FrameContext (passes/frame_context.hpp):
//
//     object requests -> shadow maps -> reflections -> depth -> opaque -> traced underlay -> objects -> transparent ->
//     weather -> blend
//
// The overlay of light handles is drawn over a copy. The engine renders the objects while geometry is drawn. Objects
// are sorted and blended, not depth-tested against each other: half-transparent rims would cut holes.

#include "compositor/lighting/surface_point.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/viewer/drawing/area_light_renderer.hpp"
#include "compositor/viewer/drawing/background_renderer.hpp"
#include "compositor/viewer/drawing/displayed_nodes.hpp"
#include "compositor/viewer/drawing/frame_statistics.hpp"
#include "compositor/viewer/drawing/lit_geometry.hpp"
#include "compositor/viewer/drawing/object_nodes.hpp"
#include "compositor/viewer/drawing/passes/blend_passes.hpp"
#include "compositor/viewer/drawing/passes/frame_context.hpp"
#include "compositor/viewer/drawing/passes/geometry_passes.hpp"
#include "compositor/viewer/drawing/passes/object_passes.hpp"
#include "compositor/viewer/residency/object_relighting.hpp"
#include "compositor/viewer/residency/placed_object.hpp"
#include "compositor/viewer/views/object_view.hpp"
#include "engine/driver/render_session.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace rs::compositor {

struct FrameOptions {
    int width = 1280;  // px
    int height = 720;
    int samples = 4;          // per pixel, for the edges of geometry
    bool wire_frame = false;  // geometry except for the floor
    bool shadows = false;     // cast by geometry and objects onto geometry and floor (shadow_plan.hpp)
    // Scales lights and the environment by 2^exposure_ev, but not objects that are not relit, other backgrounds and
    // unlit surfaces.
    double exposure_ev = 0;
    Relighting relighting = Relighting::kOff;  // kOn: also of rasterized frames (LitGeometry::irradiance_at)
    ObjectDepth object_depth = ObjectDepth::kPlane;
    int object_samples = kDefaultSamplesAcross;                // ObjectViewOptions::max_samples_across
    std::shared_ptr<const ObjectCartoon> object_cartoon = {};  // look of objects; null: that of their photos
    // Renders objects for an upright camera in the same position and warps the image (upright_image.hpp): faster and
    // supported by boards, but slightly softer.
    bool upright_images = false;
    // Waits for each part to be drawn, so that the times in FrameStatistics do not overlap. Slower.
    bool time_parts = false;
};

/// Requires a current gl::Context that outlives it; single-threaded, move-only.
class FrameCompositor {
public:
    /// \param engine contains the objects of `nodes`; nothing else may submit to it while a frame is drawn.
    /// \param nodes may change between frames, but not in number.
    static Result<FrameCompositor> create(const Scene& scene, std::shared_ptr<engine::RenderSession> engine,
                                          std::shared_ptr<const DisplayedNodes> nodes,
                                          const FrameOptions& options = {});
    /// Compositor of a fixed set of objects, which the software core renders.
    static Result<FrameCompositor> create(const Scene& scene, const std::vector<PlacedObject>& objects,
                                          const FrameOptions& options = {});

    /// Draws a frame and reads it back. Fails if the engine rejects a view; the error names the object.
    /// \param camera in scene coordinates, of size width() x height().
    /// \return opaque image.
    Result<Image<Rgba8>> compose(const Camera& camera);

    /// The same in two steps: the frame stays on the GPU, for show_in_window() or image().
    Status draw(const Camera& camera);
    [[nodiscard]] Image<Rgba8> image() const { return target_.shown().read_image(); }
    void show_in_window(int width, int height) const { target_.shown().show_in_window(width, height); }
    /// Draws light handles over a copy of the frame; image() stays without them.
    Status draw_handles(const std::vector<HandleStroke>& strokes);
    [[nodiscard]] const HandleRenderer* handles() const { return passes_.overlay.handles(); }

    /// Replaces lights, environment, headlight and exposure. Frames are then bit-identical to those of a compositor
    /// created for `scene`. Fails if the driver rejects a shader.
    /// \param scene has the geometry of the scene passed to create().
    Status set_lights(const Scene& scene, double exposure_ev);

    /// Sets the transform of a movable geometry node from the next frame on; nullopt hides it. The mesh is not uploaded
    /// again.
    Status move_geometry(std::size_t index, const std::optional<glm::dmat4>& world_from_node) {
        passes_.depth.invalidate();
        return geometry_.move(index, world_from_node);
    }
    /// Number of geometry meshes and images uploaded since create() began; constant after create().
    [[nodiscard]] int uploads() const { return geometry_.surfaces().uploads(); }
    /// Sets the precipitation of the next frame; nullopt: none. Fog and wet or snowy surfaces are part of the scene
    /// (apply_weather).
    /// \param seconds since the beginning of the sequence
    void set_weather(const std::optional<Weather>& weather, double seconds) {
        weather_ = weather;
        weather_seconds_ = seconds;
    }

    /// Replaces the colours of background and opaque geometry by `image`, of the frame's size; nullptr: they are drawn
    /// again. The background is visible where alpha is below 1. Depths of the geometry are drawn only if something that
    /// is blended, or a query, needs them, and are reused while the view stays the same unless objects write depth.
    /// \param irradiance at the objects, which relights them (TracedRenderer::object_irradiance); null: not relit
    void set_traced(std::shared_ptr<const Image<Rgba8>> image,
                    std::shared_ptr<const LocalIrradiances> irradiance = nullptr) {
        traced_ = std::move(image);
        traced_irradiance_ = std::move(irradiance);
    }

    /// Statistics of the last draw() or compose().
    [[nodiscard]] const FrameStatistics& statistics() const { return statistics_; }

    // Queries of the last frame. If it was traced and has no depths, surface_at, distance_ahead and draw_handles draw
    // it again in the current state of the scene.

    /// Index of the ray-space node that is visible at a pixel.
    [[nodiscard]] std::optional<std::size_t> object_at(int x, int y) const;
    /// Visible surface at a pixel: of geometry, and of objects if they have depth.
    [[nodiscard]] std::optional<SurfacePoint> surface_at(int x, int y);
    /// Axial depth of the geometry at the middle pixel, scene units; nullopt if there is none.
    [[nodiscard]] std::optional<double> distance_ahead();

    [[nodiscard]] int width() const { return target_.drawn.width(); }
    [[nodiscard]] int height() const { return target_.drawn.height(); }
    /// Changes the frame size. Fails, with nothing changed, if the driver cannot allocate the framebuffers.
    Status resize(int width, int height);
    void set_wire_frame(bool wire_frame) {
        if (wire_frame != wire_frame_) passes_.depth.invalidate();
        wire_frame_ = wire_frame;
    }
    /// Fails, with nothing changed, if the driver cannot allocate the maps. Takes some tenths of a second.
    Status set_shadows(bool shadows) { return geometry_.set_shadows(shadows, nodes_.shown()); }
    [[nodiscard]] bool shadows() const { return geometry_.shadows(); }
    /// Rotates a node about its object's axis, relative to its orientation in the scene; counter-clockwise seen from
    /// above.
    void turn_object(std::size_t index, double angle_rad) { nodes_.turn(index, angle_rad); }

private:
    struct Passes {
        ObjectRequestPass object_requests;
        ShadowMapPass shadow_maps;
        ReflectionPass reflections;
        DepthPass depth;
        OpaquePass opaque;
        TracedUnderlayPass underlay;
        ObjectPass objects;
        TransparentPass transparent;
        WeatherPass weather;
        BlendPass blend;
        OverlayPass overlay;
    };
    static Result<Passes> make_passes(const Scene& scene, std::size_t nodes, const FrameOptions& options);
    struct Parts {
        std::shared_ptr<engine::RenderSession> engine;
        ObjectNodes nodes;
        BackgroundRenderer background;
        AreaLightRenderer area_lights;
        LitGeometry geometry;
        FrameTarget target;
        Passes passes;
    };
    FrameCompositor(Parts parts, const std::optional<Fog>& fog, const FrameOptions& options);

    [[nodiscard]] FrameContext context_of(const Camera& camera);
    // At an object that is relit.
    [[nodiscard]] std::optional<IrradianceHarmonics> irradiance_at(const PlacedObject& placed);
    Status draw(const Camera& camera, bool needs_depths);
    // Draws the last frame again if it has no depths.
    Status ensure_depths();
    [[nodiscard]] bool is_opaque_at(std::size_t node, const ObjectView& view, const glm::ivec2& image_pixel) const;

    std::shared_ptr<engine::RenderSession> engine_;
    ObjectNodes nodes_;
    BackgroundRenderer background_;
    AreaLightRenderer area_lights_;
    LitGeometry geometry_;
    FrameTarget target_;
    Passes passes_;
    std::optional<Fog> fog_;
    bool wire_frame_;
    bool time_parts_;
    int samples_;
    Relighting relighting_;
    std::shared_ptr<const Image<Rgba8>> traced_;
    std::shared_ptr<const LocalIrradiances> traced_irradiance_;
    std::optional<Weather> weather_;
    double weather_seconds_ = 0;
    std::optional<Camera> camera_;  // of the last frame
    FrameStatistics statistics_;
};

}  // namespace rs::compositor
