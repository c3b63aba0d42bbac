#pragma once
/// \file
/// Log ratio of a photo's light to the background's, and its edges.
///
/// A soft shadow fades into the background without an edge in this ratio, while the object has an edge all around: a
/// flood fill from the image border that stops at edges reaches shadows but not the object. Used by the background
/// gradient, the shadow-free rows and segment_by_edges(). Has OpenCV types, so only .cpp files include it.

#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/image/image.hpp"

#include <opencv2/core.hpp>

namespace rs::capture {

/// Converts to CV_32FC3 in the order R, G, B; copies.
cv::Mat3f light_mat(const Image<LinearRgb>& light);

/// Gaussian blur, sigma 1 px, so that noise of single pixels causes no edges.
cv::Mat3f smoothed_light(cv::Mat3f light);

/// Natural logarithm of photo / background, by the mean of the three channels of linear light; both have one size.
/// Means below 0.001 are raised to that.
cv::Mat1f log_ratio(const cv::Mat3f& photo, const cv::Mat3f& background);

/// 255 where the gradient (Sobel 3 x 3) of the log ratio exceeds `min_gradient_per_px`, else 0.
cv::Mat1b edges_of_log_ratio(const cv::Mat1f& ratio, float min_gradient_per_px = 0.02F);

}  // namespace rs::capture
