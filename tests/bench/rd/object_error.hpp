#pragma once
// How far decoded images are from the originals, over the object's pixels only.
//
// Colours are compared as they are stored: straight sRGB, where the original's alpha is at least 128; a codec is free
// to leave anything where nobody looks. (rayspace/image/image_metrics.hpp compares what is *shown*, premultiplied,
// which would mix colour and silhouette in one number; here alpha is scored apart.)

#include "tests/bench/rd/reference_images.hpp"

namespace rs::bench {

inline constexpr int kObjectAlpha = 128;

// Sums are integers: the order of adding does not matter.
struct ObjectError {
    std::int64_t object_pixels = 0;
    std::int64_t squared_error = 0;  // over object pixels and R, G, B; 8-bit units
    std::int64_t block_pixels = 0;   // of the touched blocks, as far as they lie in the image
    std::int64_t alpha_error = 0;    // absolute, over block_pixels

    ObjectError& operator+=(const ObjectError& other);
    [[nodiscard]] double psnr_db() const;    // peak 255; 99 where nothing differs
    [[nodiscard]] double alpha_mae() const;  // 0..255
};

// `decoded` has the size of the original, which is view `view` of `images`.
ObjectError object_error(const ReferenceImages& images, std::size_t view, ConstImageView<Rgba8> decoded);

}  // namespace rs::bench
