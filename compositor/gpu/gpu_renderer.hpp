#pragma once
// Renders views of objects by the reconstruction shader (reconstruction_shader.hpp). The images equal those of
// reconstruct_scalar bit for bit.
//
//     GpuObject + ViewRegisters -> set-ups -> blocks whose photos fit into the object's textures
//         -> rectangles that are not transparent (visible_area.hpp) -> draw calls
//
// Textures of objects are created when views need them and hold the photos that were used most recently. Views that
// need more photos than fit are drawn in parts.

#include "compositor/gl/integer_texture.hpp"
#include "compositor/gl/program.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/gpu/gpu_object.hpp"
#include "compositor/gpu/object_textures.hpp"
#include "compositor/gpu/shader/reconstruction_shader.hpp"
#include "compositor/gpu/visible_area.hpp"
#include "rayspace/api/types/executor.hpp"
#include "rayspace/base/result.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace rs::compositor {

struct GpuRendererOptions {
    ShaderDialect dialect = ShaderDialect::kDesktop;
    /// Limit for the textures of all objects; the cells and two photos of an object are kept even beyond it.
    std::int64_t memory_bytes = std::int64_t{2} << 30;
};

/// A view that GpuRenderer::draw() renders in the context of the frame: ExecutedView::deferred of the executor `gpu`.
struct DeferredGpuView final : engine::DeferredView {
    std::shared_ptr<const GpuObject> object;
    engine::ViewRegisters registers;
    std::int64_t memory_bytes = 0;  // GpuRendererOptions::memory_bytes
};

/// Requires a current gl::Context that outlives it; single-threaded, move-only.
class GpuRenderer {
public:
    static Result<GpuRenderer> create(const GpuRendererOptions& options = {});

    /// Renders a view into the top left corner of `target`, whose other pixels become transparent. Upright views take
    /// one set-up per column, others one per pixel, computed on the threads of the calling tbb arena. \param registers
    /// valid for the object \param target     at least as large as the view \return           rectangles, without
    /// overlap, outside of which the view is transparent
    Result<std::vector<PixelRect>> draw(const std::shared_ptr<const GpuObject>& object,
                                        const engine::ViewRegisters& registers, const gl::IntegerTarget& target);

    /// Renders a view and reads it back.
    /// \param depth      also read the depth back
    Result<engine::ExecutedView> render(const std::shared_ptr<const GpuObject>& object,
                                        const engine::ViewRegisters& registers, bool depth);

    /// Memory of the textures of all objects that exist.
    [[nodiscard]] std::int64_t memory_bytes() const;

private:
    struct ObjectEntry {
        std::weak_ptr<const GpuObject> object;
        ObjectTextures textures;
        std::int64_t cell_bytes = 0;
        std::int64_t layer_bytes = 0;
        std::int64_t last_drawn = 0;
        [[nodiscard]] std::int64_t bytes() const { return cell_bytes + textures.layers() * layer_bytes; }
    };
    struct View;

    GpuRenderer(gl::Program program, const GpuRendererOptions& options);
    Status reserve_setups(int width, int setup_rows);
    void set_uniforms(const RaySpaceObject& object, const engine::ViewRegisters& registers) const;
    void forget_evicted_objects();
    Result<ObjectEntry*> entry_of(const std::shared_ptr<const GpuObject>& object);
    Status make_room(const GpuObject& object, ObjectEntry& entry, const std::vector<int>& photos);
    void free_least_recently_drawn(const ObjectEntry& but);
    Status draw_block(View& view, const PixelRect& block);

    gl::Program program_;
    gl::VertexArray triangle_{3};
    gl::TextureLimits limits_;
    std::int64_t memory_bytes_;
    std::map<const GpuObject*, ObjectEntry> objects_;
    std::int64_t now_ = 0;
    std::optional<gl::IntegerTarget> target_;   // of render(); at least as large as its last view
    std::optional<gl::IntegerTexture> setups_;  // at least as large as those of the last view
};

}  // namespace rs::compositor
