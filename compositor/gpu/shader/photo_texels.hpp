#pragma once
// A photo of an object as the reconstruction shader reads it.

#include "rayspace/image/image.hpp"

#include <cstdint>

namespace rs::engine {
class TexelStore;
}

namespace rs::compositor {

/// RGBA, and details (engine/core/definition/texel_detail.hpp).
struct PhotoTexels {
    Image<Rgba8> colours;
    Image<std::int8_t> details;
};

/// Decodes a photo unless it is decoded already, on the threads of the calling tbb arena.
/// \param photo          number of a view whose photo is loaded
/// \param width, height  of the object's photos
PhotoTexels photo_texels(const engine::TexelStore& store, int photo, int width, int height);

}  // namespace rs::compositor
