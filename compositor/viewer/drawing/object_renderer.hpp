#pragma once
// Draws the images of ray-space nodes into a frame: what they show (shown_parts.hpp), at the depth of the node's
// reference plane (object_view.hpp), tested against the geometry and blended over.
//
// With a depth for every pixel, objects, and objects and geometry, reach into each other as their surfaces do. Then
// pixels that are at least half covered also hide what is drawn later and lies behind them; the others, rims, do not,
// for they would cut holes.

#include "compositor/gl/program.hpp"
#include "compositor/gl/texture.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/viewer/views/object_view.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace rs::compositor {

enum class ObjectDepth {
    kPlane,  // one for all of an object
    kPixel,  // the engine's, of every pixel
};

// Needs a gl::Context that is current, and outlives it; one thread. Move-only.
class ObjectRenderer {
public:
    // For nodes 0 .. nodes - 1.
    static Result<ObjectRenderer> create(std::size_t nodes, ObjectDepth depth = ObjectDepth::kPlane);

    // Gives the image of a node to the GPU, at least one pixel; that of the view, which is drawn next. A node has two
    // textures, taken in turns, so that one may still be drawn from while the other is filled. Of kPixel, `depths` has
    // the image's size and holds axial depths in the units of the object's rig (engine::depth_image).
    void upload(std::size_t node, const ObjectView& view, ConstImageView<Rgba8> image,
                ConstImageView<float> depths = {});

    struct Appearance {
        glm::ivec2 screen_px{0};  // size of the frame
        glm::vec3 fog{0};         // its colour, linear light
        float own_light = 1;      // what fog leaves of the object's, 0 .. 1
        float opacity = 1;        // 0 .. 1, times that of the image
    };
    // Draws what was uploaded last, an image of the view.
    void draw(std::size_t node, const ObjectView& view, const Appearance& appearance) const;

    // Gives the textures of a node back.
    void release(std::size_t node);

private:
    // Smooth, then [samples across - 1].
    struct Programs {
        std::vector<gl::Program> opaque;
        std::vector<gl::Program> blended;
    };
    ObjectRenderer(Programs programs, std::size_t nodes, ObjectDepth depth);

    struct Textures {
        std::array<std::optional<gl::Texture>, 2> in_turns;
        std::array<std::optional<gl::Texture>, 2> depths;
        std::size_t filled_last = 0;
        std::optional<gl::VertexArray> opaque;  // parts of the image
        std::optional<gl::VertexArray> blended;
    };
    const gl::Program& set_up(const std::vector<gl::Program>& programs, const ObjectView& view,
                              const Appearance& appearance) const;
    void draw_blended_parts(const gl::VertexArray& parts, const gl::Program& program, bool there) const;

    ObjectDepth depth_;
    Programs programs_;
    std::vector<Textures> textures_;  // [node]
};

}  // namespace rs::compositor
