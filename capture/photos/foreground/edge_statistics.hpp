#pragma once
/// \file
/// Local colour statistics on both sides of a contour: means and covariances under a Gaussian window, for every pixel
/// of a band along the contour (the unknown region of a trimap). Input of estimate_alpha().
///
/// Only for .cpp files of this folder: no header that others include may need OpenCV.

#include <opencv2/core.hpp>

#include <functional>

namespace rs::capture {

/// Weighted mean and covariance of the colours on one side of the contour, linear light.
struct ColourStatistics {
    using Covariance = cv::Vec<float, 6>;  ///< upper triangle: rr, rg, rb, gg, gb, bb
    cv::Vec3f mean;                        ///< 0 where the total weight is 0
    Covariance covariance;
};

/// Weight of a pixel in the statistics of its side: `mixed_weight` at the contour, where both sides mix, growing with
/// the square of the distance up to band_px + 1. It is positive at the contour, because a thin structure has no other
/// pixels.
float purity_weight(float distance_px, int band_px, float mixed_weight);

/// Calls visit(x, y, foreground, background) for all pixels less than `band_px` from the contour, row by row. Windows
/// are Gaussians with sigma band_px + 1 px, cut off at 4 sigma, with the image mirrored at its border. Time grows with
/// the contour's length. \param light linear light, \param distance signed distance from the contour in px, positive in
/// the foreground
void for_each_band_pixel(const cv::Mat3f& light, const cv::Mat1f& distance, int band_px, float mixed_weight,
                         const std::function<void(int x, int y, const ColourStatistics& foreground,
                                                  const ColourStatistics& background)>& visit);

}  // namespace rs::capture
