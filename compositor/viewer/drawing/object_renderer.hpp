#pragma once
// Draws the images of ray-space nodes into a frame: the covered parts of each image (image_coverage.hpp), depth-tested
// at the node's reference plane (object_view.hpp) and blended.
//
// The image of a node is uploaded, or drawn on the GPU into a target of the node.
//
// With per-pixel depth, objects intersect each other and the geometry along their surfaces. Pixels with alpha of at
// least 0.5 then also write depth; edge pixels below do not, which would leave holes behind them.

#include "compositor/gl/integer_texture.hpp"
#include "compositor/gl/program.hpp"
#include "compositor/gl/texture.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/gpu/visible_area.hpp"
#include "compositor/viewer/residency/object_relighting.hpp"
#include "compositor/viewer/views/object_view.hpp"
#include "engine/core/definition/view_registers.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace rs::compositor {

enum class ObjectDepth {
    kPlane,  // one reference plane per object
    kPixel,  // per-pixel depth of the engine
};

/// Requires a current gl::Context that outlives it; single-threaded, move-only.
class ObjectRenderer {
public:
    /// Renders nodes 0 .. nodes - 1.
    static Result<ObjectRenderer> create(std::size_t nodes, ObjectDepth depth = ObjectDepth::kPlane);

    /// UploadCache the image of a node for the next draw(). Each node has two textures used in turn, so that one can be
    /// filled while the GPU reads the other.
    /// \param image at least 1 x 1 px, rendered for `view`.
    /// \param depths_q20 for ObjectDepth::kPixel: axial depths of the image's size, object radii. Fails if the driver
    /// has no memory for them.
    Status upload(std::size_t node, const ObjectView& view, const Image<Rgba8>& image,
                  const Image<std::int32_t>& depths_q20 = {});

    /// In place of upload(): the target whose top left corner receives the image of a node and its depths, of the size
    /// of view.camera, before set_drawn(). Fails if the driver has no memory for it.
    Result<const gl::IntegerTarget*> target(std::size_t node, const ObjectView& view);
    /// \param visible  parts of the image outside of which it is transparent
    void set_drawn(std::size_t node, const ObjectView& view, std::span<const PixelRect> visible);

    /// Gain by the normals of an ellipsoid (object_relighting.hpp), in the space in which it is the unit sphere.
    struct Relight {
        IrradianceHarmonics gain;        // by the normal in the object's axes
        glm::vec3 eye{0};                // viewpoint
        glm::mat3 ray_from_screen{1};    // direction through position (x, y, 1) of the whole screen
        glm::vec3 normal_from_point{1};  // factors that make a point of the sphere a normal of the ellipsoid
    };
    static Relight relight_of(const PlacedObject& placed, const Camera& camera, const IrradianceHarmonics& scene);

    struct Appearance {
        glm::ivec2 screen_px{0};  // frame size
        glm::vec3 fog{0};         // fog colour, linear light
        float own_light = 1;      // fraction of the object's light that passes the fog, 0 .. 1
        float opacity = 1;        // 0 .. 1, multiplies the image's alpha
        std::optional<Relight> relight{};
        engine::DepthScale depth_scale{};  // of the object in view.camera; for ObjectDepth::kPixel
    };
    /// Draws the last image of the node.
    void draw(std::size_t node, const ObjectView& view, const Appearance& appearance) const;

    /// Releases the textures of a node.
    void release(std::size_t node);

private:
    // Element 0 interpolates bilinearly; element n takes n samples across.
    struct Programs {
        std::vector<gl::Program> opaque;
        std::vector<gl::Program> blended;
    };
    ObjectRenderer(Programs programs, std::size_t nodes, ObjectDepth depth);

    struct Textures {
        std::array<std::optional<gl::Texture>, 2> in_turns;
        std::array<std::optional<gl::IntegerTexture>, 2> depths;
        std::size_t filled_last = 0;
        std::optional<gl::IntegerTarget> drawn;
        bool is_drawn = false;                  // the last image is in `drawn`
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
