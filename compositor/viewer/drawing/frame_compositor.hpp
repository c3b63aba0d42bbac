#pragma once
// Composites frames: the scene's geometry with a depth buffer, and the images that the engine reconstructs of its
// ray-space nodes, each at the depth of its reference plane.
//
// A frame:  views of the nodes that can be seen: camera into the node's coordinates (equation 3), only the pixels that
//           the node can cover -> engine, which draws them while
//           (shadow maps in which something has changed ->) opaque geometry -> floor -> background  are drawn
//           -> transparent geometry and the engine's images, the farthest first: texture -> rectangle at the depth of
//           its planes (object_view.hpp), tested against the geometry, blended over.
//
// Nodes do not hide each other by depth (half-transparent rims would cut holes) but by their order.

#include "compositor/gl/framebuffer.hpp"
#include "compositor/gl/program.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/lighting/surface_point.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/viewer/drawing/background_renderer.hpp"
#include "compositor/viewer/drawing/displayed_nodes.hpp"
#include "compositor/viewer/drawing/handle_renderer.hpp"
#include "compositor/viewer/drawing/lit_geometry.hpp"
#include "compositor/viewer/drawing/object_renderer.hpp"
#include "compositor/viewer/drawing/placeholder_renderer.hpp"
#include "compositor/viewer/drawing/weather_renderer.hpp"
#include "compositor/viewer/residency/placed_object.hpp"
#include "compositor/viewer/views/object_view.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"
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
        kUsualSamplesAcross;  // across a pixel, at most, where objects are far (object_view.hpp); from 1
    // Objects are drawn for a level camera in the same place and looked up (upright_image.hpp): faster, and a board
    // can do it; a touch softer.
    bool upright_images = false;
    // Waits for the drawing of each part, so that the times of FrameStatistics are its own. Slower.
    bool time_parts = false;
};

// Of one ray-space node in one frame.
struct NodeStatistics {
    bool in_view = false;
    int width = 0;  // of the image that the engine drew, px
    int height = 0;
    double engine_s = 0;
    bool by_board = false;
    bool missing = false;  // a placeholder is in view
};

struct FrameStatistics {
    int nodes_rendered = 0;            // by the engine
    int nodes_by_board = 0;            // of them
    int nodes_not_seen = 0;            // off the screen, too small, or not there
    int nodes_missing = 0;             // placeholders in view
    std::int64_t pixels_rendered = 0;  // by the engine
    int geometry_in_view = 0;          // geometry nodes that the frustum lets pass
    bool has_depths = true;            // of geometry; under a traced image only where somebody needed them
    int shadow_maps_drawn = 0;         // because something in them has changed
    double shadows_s = 0;              // of drawing them
    double geometry_s = 0;             // background, geometry, floor
    double engine_s = 0;               // of drawing the views, at the same time as the geometry
    double engine_wait_s = 0;          // the part of it that the frame waited for
    double upload_s = 0;               // of the engine's images
    double composite_s = 0;            // blending, transparent geometry, averaging of samples
    std::vector<NodeStatistics> nodes;
};

// Needs a gl::Context that is current, and outlives it; one thread. Move-only.
class FrameCompositor {
public:
    // `nodes` may change from frame to frame, but not in number; their objects are loaded in `engine`, to which nobody
    // else submits while a frame is drawn.
    static Result<FrameCompositor> create(const Scene& scene, std::shared_ptr<engine::RenderSession> engine,
                                          std::shared_ptr<const ShownNodes> nodes, const FrameOptions& options = {});
    // Of objects that are there from the beginning on, drawn by the software core.
    static Result<FrameCompositor> create(const Scene& scene, const std::vector<PlacedObject>& objects,
                                          const FrameOptions& options = {});

    // The camera in scene coordinates; its size must be that of the options. The image is opaque. Fails where the
    // engine refuses the view, naming the object.
    Result<Image<Rgba8>> compose(const Camera& camera);

    // The same in two steps: draw() leaves the frame with the context's device, for show_in_window() or image().
    Status draw(const Camera& camera);
    [[nodiscard]] Image<Rgba8> image() const { return renderers_.frame.shown().read_image(); }
    void show_in_window(int width, int height) const { renderers_.frame.shown().show_in_window(width, height); }
    // Handles over a copy of the frame, to be shown in its place; image() is still without.
    Status draw_handles(const std::vector<HandleStroke>& strokes);
    [[nodiscard]] const HandleRenderer* handles() const { return handles_ ? &*handles_ : nullptr; }

    // The lights, environment and headlight of `scene`, whose geometry is that of the scene that this was made of, and
    // another exposure: frames are then those of a compositor made of `scene`, bit for bit. Fails where the
    // driver refuses a shader.
    Status set_lights(const Scene& scene, double exposure_ev);

    // From the next frame on a geometry node that may be moved stands elsewhere, or nowhere. Its mesh stays where it
    // is.
    Status move_geometry(std::size_t index, const std::optional<glm::dmat4>& world_from_node) {
        depth_from_.reset();
        return renderers_.lit.move(index, world_from_node);
    }
    // Meshes and images of geometry given to the driver since create() began: none after it.
    [[nodiscard]] int uploads() const { return renderers_.lit.surfaces().uploads(); }
    // What falls in the next frame, `seconds` after the sequence's beginning; nothing: it is dry. The weather's fog and
    // what it leaves on surfaces are the scene's (in_weather).
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

    [[nodiscard]] int width() const { return renderers_.frame.drawn.width(); }
    [[nodiscard]] int height() const { return renderers_.frame.drawn.height(); }
    // Frames of another size from now on. Fails, with nothing changed, where the driver cannot.
    Status resize(int width, int height);
    void set_wire_frame(bool wire_frame) {
        if (wire_frame != wire_frame_) depth_from_.reset();
        wire_frame_ = wire_frame;
    }
    // Fails, with nothing changed, where the driver cannot. Some tenths of a second.
    Status set_shadows(bool shadows) { return renderers_.lit.set_shadows(shadows, *nodes_); }
    [[nodiscard]] bool shadows() const { return renderers_.lit.shadows(); }
    // Turns a node about its object's axis: counter-clockwise seen from above, from where the scene has put it.
    void turn_object(std::size_t index, double angle_rad);

private:
    struct Frame {
        gl::Framebuffer drawn;
        std::optional<gl::Framebuffer> resolved;  // to one sample; only where there are several

        static Result<Frame> create(int width, int height, int samples);
        [[nodiscard]] const gl::Framebuffer& shown() const { return resolved ? *resolved : drawn; }
        [[nodiscard]] float depth_at(int x, int y) const { return drawn.depth_at(x, y, shown()); }
    };
    struct Renderers {
        gl::Program traced;
        ObjectRenderer objects;
        PlaceholderRenderer placeholders;
        BackgroundRenderer background;
        LitGeometry lit;
        WeatherRenderer weather;
        Frame frame;
    };
    FrameCompositor(const Scene& scene, std::shared_ptr<engine::RenderSession> engine,
                    std::shared_ptr<const ShownNodes> nodes, Renderers renderers, const FrameOptions& options);

    struct SeenNode {
        std::size_t index = 0;
        ObjectView view;
        engine::DrawnView drawn;
    };
    [[nodiscard]] std::optional<ObjectView> view_of_node(std::size_t index, const Camera& camera) const;
    [[nodiscard]] std::vector<SeenNode> seen_nodes(const Camera& camera) const;
    enum class TracedDepths { kWhereBlended, kAlways };
    Status draw(const Camera& camera, TracedDepths depths);
    // Of the last frame, where they were left out.
    Status ensure_depths();
    [[nodiscard]] bool blends_something(const std::vector<SeenNode>& seen, const FrameView& view) const;
    void draw_traced(const Camera& camera);
    [[nodiscard]] std::vector<std::optional<PlacedObject>> shadow_casters() const;
    [[nodiscard]] PlacedObject turned(std::size_t index) const;
    void upload(const SeenNode& node);
    void draw_object(const SeenNode& node) const;
    void draw_blended(const std::vector<SurfaceRenderer::Transparent>& surfaces, const std::vector<SeenNode>& nodes,
                      const FrameView& view);

    std::optional<Fog> fog_;
    std::shared_ptr<engine::RenderSession> engine_;
    std::shared_ptr<const ShownNodes> nodes_;
    std::vector<double> turns_rad_;  // [node]: by which the visitor has turned it
    std::optional<Camera> camera_;   // of the last frame
    // How the geometry was seen whose depths the frame holds, and no others.
    std::optional<glm::dmat4> depth_from_;
    Renderers renderers_;
    bool wire_frame_;
    bool time_parts_;
    int samples_;
    ObjectDepth object_depth_;
    int object_samples_;
    bool upright_images_;
    std::shared_ptr<const Image<Rgba8>> traced_;
    std::optional<Weather> weather_;
    double weather_seconds_ = 0;
    gl::VertexArray rectangle_;
    std::optional<HandleRenderer> handles_;  // once there were some
    FrameStatistics statistics_;
};

}  // namespace rs::compositor
