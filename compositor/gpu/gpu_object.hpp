#pragma once
// An object prepared for the reconstruction shader, on the CPU: its shape maps with the bounds of their columns, and
// its photos, which are decoded when a view needs them. Its textures are object_textures.hpp.

#include "compositor/gpu/shader/photo_texels.hpp"
#include "compositor/gpu/shader/view_setup.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace rs::engine {
class TexelStore;
}

namespace rs::compositor {

/// Immutable; thread-safe.
class GpuObject {
public:
    /// CPU memory for decoded photos, beyond which the least recently used ones are freed.
    static constexpr std::int64_t kDecodedBytes = std::int64_t{64} << 20;

    /// Substitutes missing photos, as the core does. Photos that are not compressed are converted, which takes 5 bytes
    /// per pixel.
    /// \param object valid
    static Result<std::shared_ptr<const GpuObject>> create(RaySpaceObject object);
    GpuObject(const GpuObject&) = delete;
    GpuObject& operator=(const GpuObject&) = delete;
    ~GpuObject();

    /// The object without its photos.
    [[nodiscard]] const RaySpaceObject& object() const { return object_; }
    /// column_bounds() of a ring's shape map.
    [[nodiscard]] std::span<const ColumnBounds> bounds(int ring) const {
        return bounds_[static_cast<std::size_t>(ring)];
    }

    /// Decodes a photo unless it is decoded already, on the threads of the calling tbb arena.
    /// \param view  of a photo that is loaded
    [[nodiscard]] PhotoTexels photo(int view) const;

private:
    GpuObject(RaySpaceObject object, std::unique_ptr<engine::TexelStore> texels);

    RaySpaceObject object_;
    std::unique_ptr<engine::TexelStore> texels_;
    std::vector<std::vector<ColumnBounds>> bounds_;  // [ring]
};

}  // namespace rs::compositor
