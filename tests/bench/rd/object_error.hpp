#pragma once
// Error of decoded images over the object's pixels.
//
// Compares straight sRGB colours as stored, where the original's alpha is at least 128; other pixels are ignored. Alpha
// is scored separately. (rayspace/image/image_metrics.hpp compares premultiplied colours, which mixes colour and
// silhouette in one number.)

#include "tests/bench/rd/reference_images.hpp"

namespace rs::bench {

inline constexpr int kObjectAlpha = 128;

/// Integer sums, independent of the order of addition.
struct ObjectError {
    std::int64_t object_pixels = 0;
    std::int64_t squared_error = 0;  // over object pixels and R, G, B; 8-bit units
    std::int64_t block_pixels = 0;   // pixels of the touched blocks inside the image
    std::int64_t alpha_error = 0;    // absolute, over block_pixels

    ObjectError& operator+=(const ObjectError& other);
    [[nodiscard]] double psnr_db() const;    // peak 255; 99 if nothing differs
    [[nodiscard]] double alpha_mae() const;  // 0..255
};

/// \param decoded of the size of the original, view `view` of `images`
ObjectError object_error(const ReferenceImages& images, std::size_t view, ConstImageView<Rgba8> decoded);

}  // namespace rs::bench
