#pragma once
// Image difference metrics, used for all figures of this project.
//
// Colours are premultiplied by alpha (8 bit, on black). Only *object pixels* count: those with alpha above 0 in either
// image. So empty background does not raise the score, and silhouette errors lower it.

#include "rayspace/image/image.hpp"

#include <cstdint>
#include <span>

namespace rs {

struct ImageDifference {
    std::int64_t object_pixels = 0;
    double squared_error = 0;  // summed over object pixels and R, G, B; 8-bit units
    double ssim = 1;           // mean over object pixels and R, G, B

    /// dB with peak 255 over object pixels and R, G, B; 99 if the images are equal or both empty.
    [[nodiscard]] double psnr_db() const;
};

/// Summary of several images with equal weights.
struct DifferenceSummary {
    double mean_psnr_db = 0;    // mean of the images' dB
    double pooled_psnr_db = 0;  // dB over all images' object pixels together; lower if images differ in quality
    double mean_ssim = 0;
};
DifferenceSummary summarise(std::span<const ImageDifference> differences);

/// PSNR and SSIM of two images of the same size. SSIM as in Wang, Bovik, Sheikh, Simoncelli 2004: Gaussian window of
/// sigma 1.5 and 11x11 pixels (clipped at the image's edge and renormalised), K1 = 0.01, K2 = 0.03.
ImageDifference compare_images(ConstImageView<Rgba8> a, ConstImageView<Rgba8> b);

/// PSNR only; several times faster.
ImageDifference compare_images_psnr(ConstImageView<Rgba8> a, ConstImageView<Rgba8> b);

}  // namespace rs
