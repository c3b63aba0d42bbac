#pragma once
// Textures of an object for the reconstruction shader (shader/texture_layout.hpp): the cells of its shape maps, and an
// array of photos whose layers hold the most recently used ones.

#include "compositor/gl/integer_texture.hpp"
#include "compositor/gpu/gpu_object.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace rs::compositor {

/// A pixel reads at most this many photos.
inline constexpr int kMinPhotoLayers = 2;

/// Requires a current gl::Context that outlives it; single-threaded, move-only.
class ObjectTextures {
public:
    /// Uploads the cells.
    /// \param layers  photos that the textures hold at a time, at least kMinPhotoLayers unless the object has fewer
    static Result<ObjectTextures> create(const GpuObject& object, int layers);

    /// Changes the number of photos. They are uploaded again.
    Status resize(const GpuObject& object, int layers);
    [[nodiscard]] int layers() const { return static_cast<int>(photo_of_layer_.size()); }
    /// True if the photos can be loaded without giving up any other.
    [[nodiscard]] bool have_room_for(std::span<const int> photos) const;

    /// Uploads those of the photos that no layer holds, in place of the least recently used ones.
    /// \param photos  different from each other, at most layers()
    void load(const GpuObject& object, std::span<const int> photos);
    /// Layer of a photo of the last load().
    [[nodiscard]] int layer_of(int photo) const { return layer_of_photo_[static_cast<std::size_t>(photo)]; }

    /// Binds the textures of a ring to the units of reconstruction_shader.hpp.
    void bind(int ring) const;

private:
    ObjectTextures(gl::IntegerTexture photos, gl::IntegerTexture details, std::vector<gl::IntegerTexture> cells,
                   int views, int layers);
    void forget_photos(int layers);
    [[nodiscard]] int least_recently_used() const;

    gl::IntegerTexture photos_;
    gl::IntegerTexture details_;
    std::vector<gl::IntegerTexture> cells_;  // [ring]; empty pairs for rings without cells
    std::vector<int> layer_of_photo_;        // -1: in no layer
    std::vector<int> photo_of_layer_;        // -1: none
    std::vector<std::int64_t> last_used_;    // [layer]; time of the load
    std::int64_t now_ = 0;
};

}  // namespace rs::compositor
