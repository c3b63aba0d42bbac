#pragma once
// What both sides of a border look like near each pixel of a band along it: means and covariances under a Gaussian
// window, computed only where they are needed. Only for .cpp files of this folder: no header that others include may
// need OpenCV.

#include <opencv2/core.hpp>

#include <functional>

namespace rs::capture {

// What one side of the border looks like near by.
struct Side {
    using Covariance = cv::Vec<float, 6>;  // of red and red, red and green, red and blue, green and green, ...
    cv::Vec3f mean;                        // linear light; 0 where nothing weighs
    Covariance covariance;
};

// How much a pixel's colour is that of its side: little at the border, where both mix, growing to band_px + 1. Not
// nothing at the border either, for of a thin claw there may be no more than that.
float trust(float distance_px, int band_px);

// visit(x, y, object, backdrop) for all pixels less than band_px from the border, row by row. `distance`: in px from
// the border, positive in the object. Windows are Gaussians of sigma band_px + 1 cut off at 4 sigma; beyond the
// picture's edge it goes on mirrored. Time goes with the border's length.
void for_each_in_band(const cv::Mat3f& light, const cv::Mat1f& distance, int band_px,
                      const std::function<void(int x, int y, const Side& object, const Side& backdrop)>& visit);

}  // namespace rs::capture
