#pragma once
// Finding one chessboard corner exactly, in a window rectified with the board. Only for .cpp files of this folder: it
// needs OpenCV.

#include <glm/glm.hpp>
#include <opencv2/core.hpp>

#include <optional>

namespace rs::capture {

// `grey` is a slightly smoothed image. `image_from_squares` takes coordinates in squares, the corner near (0, 0),
// to OpenCV's pixels (centres at integers) and is good within about a square; `first_is_black` states whether the
// square at the lower right of the corner is black. `margin` is the share of a square that is free of marker beside an
// edge of a white square. The refined corner in pixels; nothing where the squares around it do not look like a
// chessboard or the window leaves the image.
//
// Principle of cv::cornerSubPix: each gradient is perpendicular to the line from the corner to its pixel. Here the
// window is a cross along the four edges: long enough to average much, and narrow enough to leave the markers out.
std::optional<glm::dvec2> refined_corner(const cv::Mat1f& grey, const cv::Matx33d& image_from_squares,
                                         bool first_is_black, double margin);

}  // namespace rs::capture
