#pragma once
/// \file
/// Images in memory and on disk.

#include "rayspace/api/result.hpp"
#include "rayspace/api/types/image.hpp"

#include <filesystem>

namespace rs::api {

using rs::ConstImageView;  ///< \copybrief rs::ConstImageView
using rs::Image;           ///< \copybrief rs::Image
using rs::ImageView;       ///< \copybrief rs::ImageView
using rs::Rgba8;           ///< \copybrief rs::Rgba8

/// Similarity of two images. Colours are premultiplied by alpha; only pixels count where either image's alpha is above
/// 0.
struct ImageScore {
    double psnr_db = 0;  ///< peak 255 over R, G and B; 99 if the images are equal or both empty
    double ssim = 0;     ///< mean over R, G and B, window of sigma 1.5 (Wang et al. 2004); 1 if equal
};

/// Reads an image as 8-bit sRGB with straight alpha (255 if the file has none). Thread-safe.
/// \param path  PNG, JPEG, EXR or another format of OpenImageIO, up to 8192 px a side
/// \return the image; an error that names the file if it is missing, damaged or too large
Result<Image<Rgba8>> read_image(const std::filesystem::path& path);

/// Writes a PNG file with straight alpha. The file appears complete or not at all. Thread-safe.
/// \param path   FILE.png
/// \param image  at least one pixel, up to 8192 px a side
Status write_png(const std::filesystem::path& path, ConstImageView<Rgba8> image);

/// Writes an OpenEXR file with one float channel, "Z". The file appears complete or not at all. Thread-safe.
/// \param path   FILE.exr
/// \param depth  at least one pixel, up to 8192 px a side
Status write_depth_exr(const std::filesystem::path& path, ConstImageView<float> depth);

/// Compares two images. Thread-safe.
/// \return an error if the sizes differ
Result<ImageScore> compare_images(ConstImageView<Rgba8> a, ConstImageView<Rgba8> b);

}  // namespace rs::api
