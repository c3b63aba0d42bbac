#pragma once
// Draws the geometry of a scene: lit (geometry_shaders.hpp), textured, in fog, culled by the frustum. Meshes and
// images are on the GPU from the beginning on, and every kind of surface has its shader. The nearest is drawn
// first, so that light is computed for little that is hidden.

#include "compositor/gl/draw.hpp"
#include "compositor/gl/program.hpp"
#include "compositor/gl/texture.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/viewer/drawing/surface_kind.hpp"
#include "compositor/viewer/drawing/surface_tables.hpp"
#include "compositor/viewer/shadows/shadow_maps.hpp"
#include "compositor/viewer/shadows/shadow_plan.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"
#include "rayspace/base/result.hpp"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace rs::compositor {

enum class OpaquePass {
    kLit,
    kDepthOnly,  // the same depths, and colours that mean nothing: quick
    kNone,       // the frame holds their depths already
};

// Needs a gl::Context that is current, and outlives it; one thread. Move-only.
class SurfaceRenderer {
public:
    // Those lights throw shadows that have maps by `shadows`; where there are any, they are bound (ShadowMaps::bind)
    // when surfaces are drawn.
    static Result<SurfaceRenderer> create(const Scene& scene, const ShadowPlan& shadows = {});

    // The lights, environment and headlight of `scene`, whose geometry is that of the scene that this was made of, and
    // which of them throw shadows. Fails where the driver refuses a shader.
    Status set_lights(const Scene& scene, const ShadowPlan& shadows);

    struct Transparent {
        std::size_t index;
        double distance;  // from the viewpoint to the middle of what is drawn, scene units
    };
    // Draws what is opaque and returns what is not but may be in the image, to be drawn from the farthest on.
    std::vector<Transparent> draw_opaque(const FrameView& view, bool wire_frame, OpaquePass pass = OpaquePass::kLit);
    // The fog before what is opaque, over an image of it that has none. Nothing where there is no fog.
    void draw_fog(const FrameView& view) const;
    void draw_transparent(const Transparent& item, const FrameView& view, bool wire_frame) const;

    // From the next frame on a geometry node that may be moved stands elsewhere, or nowhere. Only its numbers change,
    // unless lights reach it in a number for which there is no shader yet.
    Status move(std::size_t node, const std::optional<glm::dmat4>& world_from_node);
    // Whether it stands there, or nowhere, already.
    [[nodiscard]] bool stands(std::size_t node, const std::optional<glm::dmat4>& world_from_node) const;

    // Whether something is blended, wherever it stands.
    [[nodiscard]] bool has_transparent() const;

    // From where a node throws shadows, in scene coordinates; empty where it throws none.
    [[nodiscard]] BoundingBox caster_bounds(std::size_t node) const;

    // Meshes and images that were given to the driver since create() began, and shaders.
    [[nodiscard]] int uploads() const { return uploads_; }
    [[nodiscard]] int shaders_made() const { return static_cast<int>(programs_.size()); }

    // What throws shadows on a map that has begun: opaque surfaces, with the holes of their images, from the sides
    // from which they are seen.
    void draw_casters(const ShadowPass& pass) const;

    // Of the last draw_opaque(): geometry nodes that the frustum let pass.
    [[nodiscard]] int nodes_in_view() const { return nodes_in_view_; }

private:
    struct Item {
        std::shared_ptr<const gl::VertexArray> mesh;
        std::shared_ptr<const gl::Texture> image;
        std::shared_ptr<const gl::Texture> relief;
        glm::dmat4 world_from_node;
        BoundingBox bounds_in_node;
        BoundingBox bounds;                          // in scene coordinates
        std::size_t node = 0;                        // of Scene::geometry
        AlphaUse alpha = AlphaUse::kNone;            // of its image
        std::shared_ptr<const gl::Program> program;  // of its kind
        std::shared_ptr<const gl::Program> veil;     // the fog before it alone
        MaterialRow material;
        std::vector<LightRow> lights;
        std::vector<ShadowRow> shadows;
        bool throws_shadows = false;
        glm::ivec4 light_counts{0};   // directional ones, points, spots
        glm::ivec4 shadow_counts{0};  // of them those with maps: directional ones, points, narrow spots, wide ones
        glm::mat3 texture_transform{1};
        bool transparent = false;
        bool two_sided = true;
        bool mirrored = false;  // by its matrix
        bool hidden = false;
    };
    SurfaceRenderer(const Scene& scene, const ShadowPlan& shadows) : scene_(scene), shadows_(shadows) {}
    Status make_casters();
    Result<std::shared_ptr<const gl::Program>> program(const SurfaceKind& kind);
    void count_lights(SurfaceKind& kind, Item& item) const;
    Status put(Item& item);
    void survey_lights();
    void set_frame(const FrameView& view) const;
    struct InView {
        std::vector<std::size_t> opaque;  // of items_, what hides others first
        std::vector<Transparent> transparent;
    };
    InView in_view(const FrameView& view);
    void draw(const Item& item, const gl::Program& program, const FrameView& view, gl::DrawState state) const;

    Scene scene_;
    ShadowPlan shadows_;
    std::optional<gl::Program> caster_;
    std::optional<gl::Program> masked_caster_;
    std::map<SurfaceKind, std::shared_ptr<const gl::Program>> programs_;  // one for each kind of surface that there is
    std::vector<Item> items_;
    std::vector<std::optional<std::size_t>> item_of_node_;
    SurfaceKind some_lights_;     // of all the scene's: 1 where there are any, 0 where there are none
    glm::vec3 ambient_light_{0};  // of all directional lights that shine everywhere
    int uploads_ = 0;
    int nodes_in_view_ = 0;
};

}  // namespace rs::compositor
