#pragma once
// Composites frames: the scene's geometry with a depth buffer, and the images that the engine reconstructs of its
// ray-space nodes, each at the depth of its reference plane.
//
// A frame is a list of passes over one FrameContext (passes/frame_context.hpp):
//
//     object requests -> shadow maps -> depth -> opaque -> traced underlay -> objects -> transparent -> weather ->
//     blend
//
// and the overlay of light handles, which is drawn over a copy. The engine renders the objects while geometry is drawn.
// Objects do not hide each other by depth (half-transparent rims would cut holes) but by their order.

#include "compositor/lighting/surface_point.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/viewer/drawing/background_renderer.hpp"
#include "compositor/viewer/drawing/displayed_nodes.hpp"
#include "compositor/viewer/drawing/frame_statistics.hpp"
#include "compositor/viewer/drawing/frame_target.hpp"
#include "compositor/viewer/drawing/lit_geometry.hpp"
#include "compositor/viewer/drawing/object_nodes.hpp"
#include "compositor/viewer/drawing/passes/blend_pass.hpp"
#include "compositor/viewer/drawing/passes/depth_pass.hpp"
#include "compositor/viewer/drawing/passes/object_pass.hpp"
#include "compositor/viewer/drawing/passes/object_request_pass.hpp"
#include "compositor/viewer/drawing/passes/opaque_pass.hpp"
#include "compositor/viewer/drawing/passes/overlay_pass.hpp"
#include "compositor/viewer/drawing/passes/shadow_map_pass.hpp"
#include "compositor/viewer/drawing/passes/traced_underlay_pass.hpp"
#include "compositor/viewer/drawing/passes/transparent_pass.hpp"
#include "compositor/viewer/drawing/passes/weather_pass.hpp"
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
    bool wire_frame = false;  // of the geometry, floor excepted
    bool shadows = false;     // geometry and objects throw them onto geometry and floor (shadow_plan.hpp)
    double exposure_ev = 0;   // the scene's lights are 2^_ times as bright; objects, background, unlit surfaces stay
    ObjectDepth object_depth = ObjectDepth::kPlane;
    int object_samples =
        kDefaultSamplesAcross;  // across a pixel, at most, where objects are far (object_view.hpp); from 1
    // Objects are drawn for a level camera in the same place and looked up (upright_image.hpp): faster, and a board
    // can do it; a touch softer.
    bool upright_images = false;
    // Waits for the drawing of each part, so that the times of FrameStatistics are its own. Slower.
    bool time_parts = false;
};

// Needs a gl::Context that is current, and outlives it; one thread. Move-only.
class FrameCompositor {
public:
    // `nodes` may change from frame to frame, but not in number; their objects are loaded in `engine`, to which nobody
    // else submits while a frame is drawn.
    static Result<FrameCompositor> create(const Scene& scene, std::shared_ptr<engine::RenderSession> engine,
                                          std::shared_ptr<const DisplayedNodes> nodes,
                                          const FrameOptions& options = {});
    // Of objects that are there from the beginning on, drawn by the software core.
    static Result<FrameCompositor> create(const Scene& scene, const std::vector<PlacedObject>& objects,
                                          const FrameOptions& options = {});

    // The camera in scene coordinates; its size must be that of the options. The image is opaque. Fails where the
    // engine refuses the view, naming the object.
    Result<Image<Rgba8>> compose(const Camera& camera);

    // The same in two steps: draw() leaves the frame with the context's device, for show_in_window() or image().
    Status draw(const Camera& camera);
    [[nodiscard]] Image<Rgba8> image() const { return target_.shown().read_image(); }
    void show_in_window(int width, int height) const { target_.shown().show_in_window(width, height); }
    // Handles over a copy of the frame, to be shown in its place; image() is still without.
    Status draw_handles(const std::vector<HandleStroke>& strokes);
    [[nodiscard]] const HandleRenderer* handles() const { return passes_.overlay.handles(); }

    // The lights, environment and headlight of `scene`, whose geometry is that of the scene that this was made of, and
    // another exposure: frames are then those of a compositor made of `scene`, bit for bit. Fails where the
    // driver refuses a shader.
    Status set_lights(const Scene& scene, double exposure_ev);

    // From the next frame on a geometry node that may be moved stands elsewhere, or nowhere. Its mesh stays where it
    // is.
    Status move_geometry(std::size_t index, const std::optional<glm::dmat4>& world_from_node) {
        passes_.depth.invalidate();
        return geometry_.move(index, world_from_node);
    }
    // Meshes and images of geometry given to the driver since create() began: none after it.
    [[nodiscard]] int uploads() const { return geometry_.surfaces().uploads(); }
    // What falls in the next frame, `seconds` after the sequence's beginning; nothing: it is dry. The weather's fog and
    // what it leaves on surfaces are the scene's (apply_weather).
    void set_weather(const std::optional<Weather>& weather, double seconds) {
        weather_ = weather;
        weather_seconds_ = seconds;
    }

    // From now on `image`, of the frame's size, stands for the background and all geometry that is not blended, which
    // give their depth only, once for each view unless objects have depth, and not before something is blended or
    // somebody asks for it; where its alpha is below 1, the background shows. nullptr: they are drawn again.
    void set_traced(std::shared_ptr<const Image<Rgba8>> image) { traced_ = std::move(image); }

    // Of the last draw() or compose(). Who asks it for geometry (surface_at, distance_ahead, draw_handles) after a
    // traced frame without depths has it drawn again, as it would be drawn now.
    [[nodiscard]] const FrameStatistics& statistics() const { return statistics_; }
    // Which ray-space node is seen at a pixel of the last frame.
    [[nodiscard]] std::optional<std::size_t> object_at(int x, int y) const;
    // The surface that is seen at a pixel of the last frame: of geometry, and of objects where they have depth.
    [[nodiscard]] std::optional<SurfacePoint> surface_at(int x, int y);
    // How far geometry is along the middle pixel's ray in the last frame, scene units; nothing where there is none.
    [[nodiscard]] std::optional<double> distance_ahead();

    [[nodiscard]] int width() const { return target_.drawn.width(); }
    [[nodiscard]] int height() const { return target_.drawn.height(); }
    // Frames of another size from now on. Fails, with nothing changed, where the driver cannot.
    Status resize(int width, int height);
    void set_wire_frame(bool wire_frame) {
        if (wire_frame != wire_frame_) passes_.depth.invalidate();
        wire_frame_ = wire_frame;
    }
    // Fails, with nothing changed, where the driver cannot. Some tenths of a second.
    Status set_shadows(bool shadows) { return geometry_.set_shadows(shadows, nodes_.shown()); }
    [[nodiscard]] bool shadows() const { return geometry_.shadows(); }
    // Turns a node about its object's axis: counter-clockwise seen from above, from where the scene has put it.
    void turn_object(std::size_t index, double angle_rad) { nodes_.turn(index, angle_rad); }

private:
    struct Passes {
        ObjectRequestPass object_requests;
        ShadowMapPass shadow_maps;
        DepthPass depth;
        OpaquePass opaque;
        TracedUnderlayPass underlay;
        ObjectPass objects;
        TransparentPass transparent;
        WeatherPass weather;
        BlendPass blend;
        OverlayPass overlay;
    };
    static Result<Passes> make_passes(const Scene& scene, std::size_t nodes, ObjectDepth depth);
    FrameCompositor(const Scene& scene, std::shared_ptr<engine::RenderSession> engine, ObjectNodes nodes,
                    BackgroundRenderer background, LitGeometry geometry, FrameTarget target, Passes passes,
                    const FrameOptions& options);

    [[nodiscard]] FrameContext context_of(const Camera& camera);
    Status draw(const Camera& camera, bool needs_depths);
    // Draws the last frame again if it has no depths.
    Status ensure_depths();
    [[nodiscard]] bool is_opaque_at(std::size_t node, const ObjectView& view, const glm::ivec2& image_pixel) const;

    std::shared_ptr<engine::RenderSession> engine_;
    ObjectNodes nodes_;
    BackgroundRenderer background_;
    LitGeometry geometry_;
    FrameTarget target_;
    Passes passes_;
    std::optional<Fog> fog_;
    bool wire_frame_;
    bool time_parts_;
    int samples_;
    std::shared_ptr<const Image<Rgba8>> traced_;
    std::optional<Weather> weather_;
    double weather_seconds_ = 0;
    std::optional<Camera> camera_;  // of the last frame
    FrameStatistics statistics_;
};

}  // namespace rs::compositor
