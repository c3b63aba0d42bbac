#pragma once
// Draws the geometry of a scene: lit (geometry_shaders.hpp), textured, in fog, culled by the frustum. Meshes, pictures,
// materials and lights are on the GPU from the beginning on; a draw only names them.

#include "compositor/gl/buffer.hpp"
#include "compositor/gl/draw.hpp"
#include "compositor/gl/program.hpp"
#include "compositor/gl/texture.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/scene/scene.hpp"
#include "compositor/viewer/frustum.hpp"
#include "rayspace/result.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace rs::compositor {

// Needs a gl::Context that is current, and outlives it; one thread. Move-only.
class SurfaceRenderer {
public:
    static Result<SurfaceRenderer> create(const Scene& scene);

    struct Transparent {
        std::size_t index;
        double distance;  // from the viewpoint to the middle of what is drawn, scene units
    };
    // Draws what is opaque and returns what is not but may be in the picture, to be drawn from the farthest on.
    std::vector<Transparent> draw_opaque(const FrameView& view, bool wire_frame);
    void draw_transparent(const Transparent& item, const FrameView& view, bool wire_frame) const;

    // Of the last draw_opaque(): geometry nodes that the frustum let pass.
    [[nodiscard]] int nodes_in_view() const { return nodes_in_view_; }

private:
    struct Item {
        std::shared_ptr<const gl::VertexArray> mesh;
        std::shared_ptr<const gl::Texture> picture;
        glm::dmat4 world_from_node;
        BoundingBox bounds;  // in scene coordinates
        int material = 0;
        glm::ivec4 material_flags{0};
        glm::mat3 texture_transform{1};
        glm::ivec2 light_range{0};
        bool transparent = false;
        bool two_sided = true;
        bool mirrored = false;  // by its matrix
    };
    explicit SurfaceRenderer(gl::Program program) : program_(std::move(program)) {}
    void set_frame(const FrameView& view) const;
    void draw(const Item& item, const FrameView& view, gl::DrawState state) const;

    gl::Program program_;
    std::vector<Item> items_;
    std::optional<gl::Buffer> lights_;
    std::optional<gl::Buffer> light_lists_;
    std::optional<gl::Buffer> materials_;
    std::optional<Fog> fog_;
    bool headlight_ = false;
    int nodes_in_view_ = 0;
};

}  // namespace rs::compositor
