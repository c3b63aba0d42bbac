#pragma once
// Renders views of objects by the reconstruction shader (reconstruction_shader.hpp) and reads them back. The images
// equal those of reconstruct_scalar bit for bit.

#include "compositor/gl/integer_texture.hpp"
#include "compositor/gl/program.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/gpu/gpu_object.hpp"
#include "compositor/gpu/shader/reconstruction_shader.hpp"
#include "rayspace/api/types/executor.hpp"
#include "rayspace/base/result.hpp"

#include <optional>

namespace rs::compositor {

/// Requires a current gl::Context that outlives it; single-threaded, move-only.
class GpuRenderer {
public:
    static Result<GpuRenderer> create(ShaderDialect dialect = ShaderDialect::kDesktop);

    /// Renders a view. Upright views take one set-up per column, others one per pixel, computed on the threads of the
    /// calling tbb arena.
    /// \param registers  valid for the object
    /// \param depth      also read the depth back
    Result<engine::ExecutedView> render(const GpuObject& object, const engine::ViewRegisters& registers, bool depth);

private:
    explicit GpuRenderer(gl::Program program);
    Status reserve(const engine::ViewRegisters& registers, int setup_rows);
    void set_uniforms(const RaySpaceObject& object, const engine::ViewRegisters& registers) const;

    gl::Program program_;
    gl::VertexArray triangle_{3};
    int side_limit_;
    std::optional<gl::IntegerTarget> target_;   // at least as large as the last view
    std::optional<gl::IntegerTexture> setups_;  // at least as large as those of the last view
};

}  // namespace rs::compositor
