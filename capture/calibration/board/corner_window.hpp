#pragma once
// Subpixel refinement of one chessboard corner in a window rectified with the board. Only for .cpp files of this
// folder: it needs OpenCV.

#include <glm/glm.hpp>
#include <opencv2/core.hpp>

#include <optional>

namespace rs::capture {

/// `grey` is a slightly smoothed image. `image_from_squares` maps coordinates in squares, the corner near (0, 0), to
/// OpenCV's pixels (centres at integers) and is accurate to about a square; `first_is_black` states whether the square
/// at the lower right of the corner is black. `margin` is the marker-free width along the edges of a white square, in
/// squares. Returns the refined corner in pixels; nothing if the surrounding squares do not match a chessboard or the
/// window leaves the image.
///
/// Principle of cv::cornerSubPix: each gradient is perpendicular to the line from the corner to its pixel. The window
/// here is a cross along the four edges: long enough to average many gradients, and narrow enough to exclude the
/// markers.
std::optional<glm::dvec2> refine_corner(const cv::Mat1f& grey, const cv::Matx33d& image_from_squares,
                                        bool first_is_black, double margin);

}  // namespace rs::capture
