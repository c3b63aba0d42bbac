#pragma once
// How near a picture is to another: the one metric that every figure of this project uses.
//
// Colours are premultiplied by alpha (8 bit, on black). Only *object pixels* count: those where either picture's alpha
// is above 0. So nobody is paid for empty background, and a silhouette that is off costs what it should.

#include "rayspace/image/image.hpp"

#include <cstdint>
#include <span>

namespace rs {

struct PictureDifference {
    std::int64_t object_pixels = 0;
    double squared_error = 0;  // summed over object pixels and R, G, B; 8-bit units
    double ssim = 1;           // mean over object pixels and R, G, B

    // dB with peak 255 over object pixels and R, G, B; 99 where the pictures are equal or both empty.
    [[nodiscard]] double psnr_db() const;
};

// Of several pictures, all counting alike.
struct DifferenceSummary {
    double mean_psnr_db = 0;    // mean of the pictures' dB
    double pooled_psnr_db = 0;  // dB of all pictures' object pixels taken together; lower where pictures differ
    double mean_ssim = 0;
};
DifferenceSummary summarise(std::span<const PictureDifference> differences);

// Both pictures have the same size. SSIM as in Wang, Bovik, Sheikh, Simoncelli 2004: Gaussian window of sigma 1.5 and
// 11x11 pixels (clipped at the picture's edge and renormalised), K1 = 0.01, K2 = 0.03.
PictureDifference compare_pictures(ConstImageView<Rgba8> a, ConstImageView<Rgba8> b);

// PSNR alone: several times faster.
PictureDifference compare_pictures_psnr(ConstImageView<Rgba8> a, ConstImageView<Rgba8> b);

}  // namespace rs
