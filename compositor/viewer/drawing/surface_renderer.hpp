#pragma once
// Draws scene geometry: lit (geometry_shaders.hpp), textured, with fog, frustum-culled. Meshes and images are uploaded
// at creation; each surface kind has a shader. Surfaces are drawn front to back, so that few hidden pixels are shaded.
// Normals that contradict the winding of their mesh are reversed (with_normals_in_front).

#include "compositor/gl/draw.hpp"
#include "compositor/gl/program.hpp"
#include "compositor/gl/texture.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/scene/light/environment_irradiance.hpp"
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
#include <utility>
#include <vector>

namespace rs::compositor {

enum class OpaqueMode {
    kLit,
    kDepthOnly,     // same depths with undefined colours; fast
    kSurroundings,  // lit, without reflective surfaces and back faces
    kNone,          // the framebuffer already contains the depths
};

/// Requires a current gl::Context that outlives it; single-threaded, move-only.
class SurfaceRenderer {
public:
    /// \param shadows lights with maps; these must be bound (ShadowMaps::bind) when surfaces are drawn.
    /// \param environment of Scene::environment, null without.
    static Result<SurfaceRenderer> create(const Scene& scene, const ShadowPlan& shadows,
                                          const std::optional<IrradianceHarmonics>& environment);

    /// Copies lights, environment and headlight from `scene`, which must have the same geometry as the scene passed to
    /// create(), and sets its shadow-casting lights. Fails if the driver rejects a shader.
    Status set_lights(const Scene& scene, const ShadowPlan& shadows,
                      const std::optional<IrradianceHarmonics>& environment);

    struct Transparent {
        std::size_t index;
        double distance;  // from the viewpoint to the centre of the surface, scene units
    };
    /// Draws opaque surfaces.
    /// \return visible transparent surfaces, to be drawn in order of decreasing distance.
    std::vector<Transparent> draw_opaque(const FrameView& view, bool wire_frame, OpaqueMode mode = OpaqueMode::kLit);
    /// Draws the fog in front of opaque surfaces over an image without fog. Does nothing if the scene has no fog.
    void draw_fog(const FrameView& view) const;
    void draw_transparent(const Transparent& item, const FrameView& view, bool wire_frame) const;

    /// Moves a movable geometry node, or hides it (nullopt). Compiles a shader only if the new number of lights needs
    /// one.
    Status move(std::size_t node, const std::optional<glm::dmat4>& world_from_node);
    /// True if the node already has this transform, or is hidden.
    [[nodiscard]] bool is_at(std::size_t node, const std::optional<glm::dmat4>& world_from_node) const;

    /// Bounds of the reflective surfaces in scene coordinates; empty if there are none.
    [[nodiscard]] BoundingBox reflective_bounds() const;
    /// Sets what they reflect, which must be done before they are drawn.
    /// \param levels of prefilter_reflections()
    void set_reflections(const std::vector<Image<RgbaF>>& levels) {
        reflections_.emplace(levels, gl::TextureWrap{true, false});
    }

    /// True if the scene has blended surfaces, visible or not.
    [[nodiscard]] bool has_transparent() const;

    /// Bounds of the shadow casters of a node in scene coordinates; empty if it casts none.
    [[nodiscard]] BoundingBox caster_bounds(std::size_t node) const;

    /// Number of meshes and images uploaded since create().
    [[nodiscard]] int uploads() const { return uploads_; }

    /// Sets ShadowPlan::cascade_rows() for the next draws.
    void set_cascades(std::vector<glm::vec4> rows) { cascades_ = std::move(rows); }

    /// Draws the shadow casters into the current map: opaque surfaces with their alpha masks, culled as in the image.
    void draw_casters(const ShadowPass& pass) const;

    /// Number of geometry nodes in the frustum in the last draw_opaque().
    [[nodiscard]] int nodes_in_view() const { return nodes_in_view_; }

private:
    struct Item {
        std::shared_ptr<const gl::VertexArray> mesh;
        std::shared_ptr<const gl::Texture> image;
        std::shared_ptr<const gl::Texture> relief;
        glm::dmat4 world_from_node;
        BoundingBox bounds_in_node;
        BoundingBox bounds;                              // scene coordinates
        std::size_t node = 0;                            // index into Scene::geometry
        AlphaUse alpha = AlphaUse::kNone;                // of its texture
        std::shared_ptr<const gl::Program> program;      // shader of its kind
        std::shared_ptr<const gl::Program> fog_program;  // shader of its fog alone
        MaterialRow material;
        std::vector<LightRow> lights;
        std::vector<ShadowRow> shadows;
        bool casts_shadows = false;
        glm::ivec4 light_counts{0};   // directional, point and spot lights
        glm::ivec4 shadow_counts{0};  // those with maps: directional, point, narrow spot, wide spot
        glm::mat3 texture_transform{1};
        bool transparent = false;
        bool traced_glass = false;  // transparent, but part of a traced image
        bool two_sided = true;
        bool reflective = false;
        bool mirrored = false;  // by its transform
        bool hidden = false;
    };
    SurfaceRenderer(const Scene& scene, const ShadowPlan& shadows) : scene_(scene), shadows_(shadows) {}
    Status create_caster_programs();
    Result<std::shared_ptr<const gl::Program>> program(const SurfaceKind& kind);
    void count_lights(SurfaceKind& kind, Item& item) const;
    Status update_item(Item& item);
    void summarize_lights();
    void set_frame(const FrameView& view) const;
    struct VisibleItems {
        std::vector<std::size_t> opaque;  // indices into items_, front to back
        std::vector<Transparent> transparent;
    };
    /// \param traced under a traced image, glass is opaque
    VisibleItems collect_visible(const FrameView& view, bool traced);
    void draw(const Item& item, const gl::Program& program, const FrameView& view, gl::DrawState state) const;

    Scene scene_;
    ShadowPlan shadows_;
    std::optional<IrradianceHarmonics> environment_;
    std::optional<gl::Program> caster_;
    std::optional<gl::Program> masked_caster_;
    std::optional<gl::Texture> reflections_;
    std::map<SurfaceKind, std::shared_ptr<const gl::Program>> programs_;  // one per existing surface kind
    std::vector<Item> items_;
    std::vector<std::optional<std::size_t>> item_of_node_;
    SurfaceKind available_lights_;  // scene-wide: 1 if the scene has such lights, else 0
    std::vector<glm::vec4> cascades_;
    glm::vec3 ambient_light_{0};  // sum over directional lights without scope
    int uploads_ = 0;
    int nodes_in_view_ = 0;
};

}  // namespace rs::compositor
