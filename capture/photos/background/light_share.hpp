#pragma once
// What a photograph has of the plate's light. A soft shadow on a backdrop fades out, while an object has an edge all
// around: from the picture's border one reaches the shadow without crossing an edge, and nothing of the object. Only
// for .cpp files.

#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/image/image.hpp"

#include <opencv2/core.hpp>

namespace rs::capture {

// A copy.
cv::Mat3f light_mat(const Image<LinearRgb>& light);

// Without the noise of single pixels, for which edges would be found.
cv::Mat3f smoothed_light(cv::Mat3f light);

// The logarithm of the share, of means of linear light in pictures of one size. Dark pixels are taken to be a little
// lighter.
cv::Mat1f log_light_share(const cv::Mat3f& photo, const cv::Mat3f& plate);

// 255 where that jumps, 0 elsewhere.
cv::Mat1b edges_of_share(const cv::Mat1f& log_share);

}  // namespace rs::capture
