#pragma once
// Draws the geometry of a scene: lit (geometry_shaders.hpp), textured, in fog, culled by the frustum. Meshes and
// pictures are on the GPU from the beginning on, and every kind of surface has its shader. The nearest is drawn
// first, so that light is computed for little that is hidden.

#include "compositor/gl/draw.hpp"
#include "compositor/gl/program.hpp"
#include "compositor/gl/texture.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/viewer/drawing/surface_tables.hpp"
#include "compositor/viewer/shadows/shadow_plan.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"
#include "rayspace/base/result.hpp"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

// What the shader of a surface has to do: surfaces of a kind share one (geometry_shaders.hpp). Pure; thread-safe.

struct SurfaceKind {
    int directional = 0;  // lights that reach it
    int points = 0;
    int spots = 0;
    int shadowed_directional = 0;  // the first so many of them throw shadows
    int shadowed_points = 0;
    int narrow_spots = 0;  // the first so many, with a single map; then those with a cube of them
    int wide_spots = 0;
    bool fading = false;  // some of these lights are weaker farther away
    bool headlight = false;
    bool lit = false;
    bool shiny = false;
    int picture = 0;  // 0 none, 1 in place of the material's colour, 2 times it
    AlphaUse picture_alpha = AlphaUse::kNone;
    bool colours = false;  // of its own at the corners
    bool relief = false;   // NormalMap
    int fog = 0;           // 0 none, 1 linear, 2 exponential
    auto operator<=>(const SurfaceKind&) const = default;
};

// `lights`: those that reach it, in any order.
SurfaceKind kind_of(const Scene& scene, const ShadowPlan& shadows, const GeometryNode& node, AlphaUse alpha,
                    const std::vector<std::uint32_t>& lights);

// The head of its fragment shader.
std::string constants_of(const SurfaceKind& kind);

// Needs a gl::Context that is current, and outlives it; one thread. Move-only.
class SurfaceRenderer {
public:
    // Those lights throw shadows that have maps by `shadows`; where there are any, they are bound (ShadowMaps::bind)
    // when surfaces are drawn.
    static Result<SurfaceRenderer> create(const Scene& scene, const ShadowPlan& shadows = {});

    struct Transparent {
        std::size_t index;
        double distance;  // from the viewpoint to the middle of what is drawn, scene units
    };
    // Draws what is opaque and returns what is not but may be in the picture, to be drawn from the farthest on.
    std::vector<Transparent> draw_opaque(const FrameView& view, bool wire_frame);
    void draw_transparent(const Transparent& item, const FrameView& view, bool wire_frame) const;

    // What throws shadows on a map that has begun: opaque surfaces, with the holes of their pictures, from the sides
    // from which they are seen.
    void draw_casters(const ShadowFace& face) const;

    // Of the last draw_opaque(): geometry nodes that the frustum let pass.
    [[nodiscard]] int nodes_in_view() const { return nodes_in_view_; }

private:
    struct Item {
        std::shared_ptr<const gl::VertexArray> mesh;
        std::shared_ptr<const gl::Texture> picture;
        std::shared_ptr<const gl::Texture> relief;
        glm::dmat4 world_from_node;
        BoundingBox bounds;                          // in scene coordinates
        std::shared_ptr<const gl::Program> program;  // of its kind
        MaterialRow material;
        std::vector<LightRow> lights;
        std::vector<ShadowRow> shadows;
        std::vector<std::uint32_t> own_lights;  // GeometryNode::lights
        bool throws_shadows = false;
        bool masked = false;  // its picture cuts holes
        glm::mat3 texture_transform{1};
        bool transparent = false;
        bool two_sided = true;
        bool mirrored = false;  // by its matrix
    };
    SurfaceRenderer() = default;
    void set_frame(const FrameView& view) const;
    void draw(const Item& item, const FrameView& view, gl::DrawState state) const;

    std::optional<gl::Program> caster_;
    std::optional<gl::Program> masked_caster_;
    std::vector<std::uint8_t> everywhere_;                      // [light]
    std::vector<std::shared_ptr<const gl::Program>> programs_;  // one for each kind of surface that there is
    std::vector<Item> items_;
    std::optional<Fog> fog_;
    bool headlight_ = false;
    int nodes_in_view_ = 0;
};

}  // namespace rs::compositor
