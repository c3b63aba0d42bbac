#pragma once
// Textures of a ray-space object for the reconstruction shader: its photos as RGBA with their detail, one layer per
// view, and the cells of its shape maps (shader/object_textures.hpp).

#include "compositor/gl/integer_texture.hpp"
#include "compositor/gpu/shader/view_setup.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <span>
#include <vector>

namespace rs::compositor {

/// Requires a current gl::Context that outlives it; single-threaded, move-only.
class GpuObject {
public:
    /// Decodes and uploads all photos, on the threads of the calling tbb arena. Missing photos are substituted, as the
    /// core does. Decoding takes 4 bytes per pixel of CPU memory until the object is uploaded.
    /// \param object valid and within the limits
    static Result<GpuObject> create(RaySpaceObject object);

    /// The object without its photos.
    [[nodiscard]] const RaySpaceObject& object() const { return object_; }
    /// column_bounds() of a ring's shape map.
    [[nodiscard]] std::span<const ColumnBounds> bounds(int ring) const {
        return bounds_[static_cast<std::size_t>(ring)];
    }
    /// Binds the textures of a ring to the units of reconstruction_shader.hpp.
    void bind(int ring) const;

private:
    GpuObject(RaySpaceObject object, gl::IntegerTexture photos, gl::IntegerTexture details,
              std::vector<gl::IntegerTexture> cells);

    RaySpaceObject object_;
    gl::IntegerTexture photos_;
    gl::IntegerTexture details_;
    std::vector<std::vector<ColumnBounds>> bounds_;  // [ring]
    std::vector<gl::IntegerTexture> cells_;          // [ring]; empty pairs for rings without cells
};

}  // namespace rs::compositor
