#pragma once
// Composites frames: the scene's geometry with a depth buffer, and the pictures that the engine reconstructs of its
// ray-space nodes, each at the depth of its reference plane.
//
// A frame:  geometry -> floor -> each node that can be seen, the farthest plane first:
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
#include "compositor/viewer/object_view.hpp"
#include "compositor/viewer/placed_object.hpp"
#include "rayspace/image.hpp"
#include "rayspace/result.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace rs::compositor {

struct FrameOptions {
    int width = 1280;  // px
    int height = 720;
    int samples = 4;  // per pixel, for the edges of geometry
};

struct FrameStatistics {
    int nodes_rendered = 0;            // by the engine
    int nodes_not_seen = 0;            // off the screen or too small
    std::int64_t pixels_rendered = 0;  // by the engine
};

// Needs a gl::Context that is current, and outlives it; one thread. Move-only.
class FrameCompositor {
public:
    static Result<FrameCompositor> create(const Scene& scene, std::vector<PlacedObject> objects,
                                          const FrameOptions& options = {});

    // The camera in scene coordinates; its size must be that of the options. The picture is opaque. Fails where the
    // engine refuses the view, naming the object.
    Result<Image<Rgba8>> compose(const Camera& camera);

    // Of the last compose().
    [[nodiscard]] const FrameStatistics& statistics() const { return statistics_; }

private:
    struct GeometryDraw {
        gl::VertexArray triangles;
        glm::vec3 colour;
        Similarity world_from_node;
    };
    struct Programs {
        gl::Program geometry;
        gl::Program floor;
        gl::Program object;
    };
    FrameCompositor(const Scene& scene, std::vector<PlacedObject> objects, Programs programs, gl::Framebuffer frame,
                    gl::Framebuffer resolved);

    void draw_geometry(const glm::dmat4& clip_from_world) const;
    void draw_floor(const glm::dmat4& clip_from_world) const;
    Status draw_object(std::size_t index, const ObjectView& view);

    glm::vec3 background_;
    std::optional<Floor> floor_;
    Lights lights_;
    std::vector<PlacedObject> objects_;
    Programs programs_;
    gl::Framebuffer frame_;
    gl::Framebuffer resolved_;
    gl::VertexArray rectangle_;
    std::vector<GeometryDraw> geometry_;
    std::vector<std::optional<gl::Texture>> textures_;  // [object]
    Image<Rgba8> picture_;                              // what the engine rendered last
    FrameStatistics statistics_;
};

}  // namespace rs::compositor
