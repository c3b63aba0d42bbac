#pragma once
// Composites frames: the scene's geometry with a depth buffer, and the pictures that the engine reconstructs of its
// ray-space nodes, each at the depth of its reference plane.
//
// A frame:  background -> opaque geometry -> floor -> transparent geometry and each node that can be seen, the farthest
//           first; for a node:
//               camera into the node's coordinates (equation 3) -> engine, only for the pixels that the node can cover
//               -> texture -> rectangle at the depth of its planes (object_view.hpp), tested against the geometry,
//               blended over.
//
// Nodes do not hide each other by depth (half-transparent rims would cut holes) but by their order.

#include "compositor/gl/framebuffer.hpp"
#include "compositor/gl/program.hpp"
#include "compositor/gl/texture.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/viewer/background_renderer.hpp"
#include "compositor/viewer/frustum.hpp"
#include "compositor/viewer/object_view.hpp"
#include "compositor/viewer/placed_object.hpp"
#include "compositor/viewer/surface_renderer.hpp"
#include "rayspace/image.hpp"
#include "rayspace/result.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace rs::compositor {

struct FrameOptions {
    int width = 1280;  // px
    int height = 720;
    int samples = 4;          // per pixel, for the edges of geometry
    bool wire_frame = false;  // of the geometry, floor excepted
    // Waits for the drawing of each part, so that the times of FrameStatistics are its own. Slower.
    bool time_parts = false;
};

// Of one ray-space node in one frame.
struct NodeStatistics {
    bool in_view = false;
    int width = 0;  // of the picture that the engine drew, px
    int height = 0;
    double engine_s = 0;
};

struct FrameStatistics {
    int nodes_rendered = 0;            // by the engine
    int nodes_not_seen = 0;            // off the screen or too small
    std::int64_t pixels_rendered = 0;  // by the engine
    int geometry_in_view = 0;          // geometry nodes that were drawn
    double geometry_s = 0;             // background, geometry, floor
    double engine_s = 0;
    double upload_s = 0;     // of the engine's pictures
    double composite_s = 0;  // blending, transparent geometry, averaging of samples
    std::vector<NodeStatistics> nodes;
};

// Needs a gl::Context that is current, and outlives it; one thread. Move-only.
class FrameCompositor {
public:
    static Result<FrameCompositor> create(const Scene& scene, std::vector<PlacedObject> objects,
                                          const FrameOptions& options = {});

    // The camera in scene coordinates; its size must be that of the options. The picture is opaque. Fails where the
    // engine refuses the view, naming the object.
    Result<Image<Rgba8>> compose(const Camera& camera);

    // The same in two steps: draw() leaves the frame with the context's device, for show_in_window() or picture().
    Status draw(const Camera& camera);
    [[nodiscard]] Image<Rgba8> picture() const { return resolved_.read_picture(); }
    void show_in_window(int width, int height) const { resolved_.show_in_window(width, height); }

    // Of the last draw() or compose().
    [[nodiscard]] const FrameStatistics& statistics() const { return statistics_; }
    // Which ray-space node is seen at a pixel of the last frame.
    [[nodiscard]] std::optional<std::size_t> object_at(int x, int y) const;
    // How far geometry is along the middle pixel's ray in the last frame, scene units; nothing where there is none.
    [[nodiscard]] std::optional<double> distance_ahead() const;

    [[nodiscard]] int width() const { return frame_.width(); }
    [[nodiscard]] int height() const { return frame_.height(); }
    // Frames of another size from now on. Fails, with nothing changed, where the driver cannot.
    Status resize(int width, int height);
    void set_wire_frame(bool wire_frame) { wire_frame_ = wire_frame; }
    // Turns a node about its object's axis: counter-clockwise seen from above, from where the scene has put it.
    void turn_object(std::size_t index, double angle_rad);

private:
    struct Programs {
        gl::Program floor;
        gl::Program object;
    };
    FrameCompositor(const Scene& scene, std::vector<PlacedObject> objects, Programs programs,
                    BackgroundRenderer background, SurfaceRenderer surfaces, gl::Framebuffer frame,
                    gl::Framebuffer resolved, const FrameOptions& options);

    void draw_floor(const FrameView& view) const;
    Status draw_object(std::size_t index, const ObjectView& view);

    std::optional<Floor> floor_;
    glm::vec3 floor_light_{0};       // that falls on it from above
    glm::vec3 floor_background_{0};  // into which it fades
    std::optional<Fog> fog_;
    std::vector<PlacedObject> objects_;
    std::vector<Similarity> first_places_;  // [object]: as the scene has put it
    std::optional<Camera> camera_;          // of the last frame
    Programs programs_;
    BackgroundRenderer background_;
    SurfaceRenderer surfaces_;
    bool wire_frame_;
    bool time_parts_;
    int samples_;
    gl::Framebuffer frame_;
    gl::Framebuffer resolved_;
    gl::VertexArray rectangle_;
    std::vector<std::optional<gl::Texture>> textures_;  // [object]
    Image<Rgba8> picture_;                              // what the engine rendered last
    FrameStatistics statistics_;
};

}  // namespace rs::compositor
