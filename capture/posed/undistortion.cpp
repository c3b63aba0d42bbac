#include "capture/posed/undistortion.hpp"

#include "capture/photos/segmentation/foreground_image.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/image/premultiplied_sampling.hpp"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rs::capture {
namespace {

constexpr double kMaxOffAxis_rad = radians(80);
constexpr int kFrameMargin_px = 2;  // support of the filter
constexpr int kPointsPerSide = 33;

// OpenCV's origin is the centre of the first pixel.
cv::Matx33d matrix_of(const Camera& camera) {
    return {camera.fl_x, 0, camera.cx - 0.5, 0, camera.fl_y, camera.cy - 0.5, 0, 0, 1};
}

cv::Mat1d coefficients_of(const LensDistortion& lens) {
    const int count = lens.model == LensDistortion::Model::kFisheye ? 4 : 8;
    return cv::Mat1d(count, 1, const_cast<double*>(lens.coefficients.data())).clone();
}

// Distance from the principal point, at focal length 1, at which the lens images the radius `r` of a pinhole image.
// Tangential distortion, which is small, is left out.
double distorted_radius(const LensDistortion& lens, double r) {
    const auto& k = lens.coefficients;
    const double x = lens.model == LensDistortion::Model::kFisheye ? std::atan(r) : r;
    const double q = x * x;
    if (lens.model == LensDistortion::Model::kFisheye) return x * (1 + q * (k[0] + q * (k[1] + q * (k[2] + q * k[3]))));
    return x * (1 + q * (k[0] + q * (k[1] + q * k[4]))) / (1 + q * (k[5] + q * (k[6] + q * k[7])));
}

// Radius of a pinhole image at focal length 1, up to that of kMaxOffAxis_rad, within which the distortion is monotonic.
double valid_radius(const LensDistortion& lens) {
    constexpr int kSteps = 4096;
    const double most = std::tan(kMaxOffAxis_rad);
    double before = 0;
    for (int i = 1; i <= kSteps; ++i) {
        const double at = distorted_radius(lens, most * i / kSteps);
        if (!(at > before)) return most * (i - 1) / kSteps;
        before = at;
    }
    return most;
}

// Points of the photo, with the centre of the first pixel as origin, at focal length 1 without distortion.
// `accuracy_px`: of the iteration.
std::vector<cv::Point2d> undistorted_points(const PosedCamera& photo, const std::vector<cv::Point2d>& positions,
                                            double accuracy_px) {
    std::vector<cv::Point2d> points;
    const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, accuracy_px);
    const cv::Matx33d matrix = matrix_of(photo.camera);
    const cv::Mat1d coefficients = coefficients_of(photo.distortion);
    if (photo.distortion.model == LensDistortion::Model::kFisheye) {
        cv::fisheye::undistortPoints(positions, points, matrix, coefficients);
    } else {
        cv::undistortPoints(positions, points, matrix, coefficients, cv::noArray(), cv::noArray(), until);
    }
    return points;
}

// Points of the border of a box in the photo, at focal length 1, without distortion.
std::vector<cv::Point2d> undistorted_border(const PosedCamera& photo, const TurnSilhouette::Box& box) {
    std::vector<cv::Point2d> border;
    for (int i = 0; i < kPointsPerSide; ++i) {
        const double t = static_cast<double>(i) / (kPointsPerSide - 1);
        // Pixel positions with the centre of the first pixel as origin.
        const double x = box.left + t * (box.right - box.left) - 0.5, left = box.left - 0.5, right = box.right - 0.5;
        const double y = box.top + t * (box.bottom - box.top) - 0.5, top = box.top - 0.5, bottom = box.bottom - 0.5;
        border.insert(border.end(), {{x, top}, {x, bottom}, {left, y}, {right, y}});
    }
    return undistorted_points(photo, border, 1e-9);
}

}  // namespace

Result<Camera> undistorted_camera(const PosedCamera& photo, const TurnSilhouette::Box& visible,
                                  const std::string& name) {
    Camera camera = photo.camera;
    if (photo.distortion.is_pinhole()) return camera;
    const double radius = valid_radius(photo.distortion);
    glm::dvec2 low(0), high(camera.width, camera.height);
    for (const cv::Point2d& p : undistorted_border(photo, visible)) {
        if (!(std::hypot(p.x, p.y) < radius)) {
            return Error{name +
                         ": the lens distortion cannot be undone where the object is (it folds the image, or the view "
                         "is wider than 160 degrees); calibrate the lens again, or take the photo out"};
        }
        const glm::dvec2 px(camera.cx + camera.fl_x * p.x, camera.cy + camera.fl_y * p.y);
        low = glm::min(low, glm::floor(px) - static_cast<double>(kFrameMargin_px));
        high = glm::max(high, glm::ceil(px) + static_cast<double>(kFrameMargin_px));
    }
    const glm::dvec2 size = high - low;
    if (!(std::max(size.x, size.y) <= kMaxImageSide_px)) {
        return Error{name + ": undistorted, it has more than " + std::to_string(kMaxImageSide_px) +
                     " px a side; give a smaller --max-side"};
    }
    camera.width = static_cast<int>(size.x);
    camera.height = static_cast<int>(size.y);
    camera.cx -= low.x;
    camera.cy -= low.y;
    return camera;
}

Image<Rgba8> undistorted(const PosedCamera& photo, const Camera& target, Image<Rgba8> foreground) {
    if (photo.distortion.is_pinhole()) return foreground;
    cv::Mat1f at_x, at_y;
    const cv::Size size(target.width, target.height);
    const cv::Matx33d matrix = matrix_of(photo.camera), target_matrix = matrix_of(target);
    const cv::Mat1d coefficients = coefficients_of(photo.distortion);
    if (photo.distortion.model == LensDistortion::Model::kFisheye) {
        cv::fisheye::initUndistortRectifyMap(matrix, coefficients, cv::Matx33d::eye(), target_matrix, size, CV_32FC1,
                                             at_x, at_y);
    } else {
        cv::initUndistortRectifyMap(matrix, coefficients, cv::noArray(), target_matrix, size, CV_32FC1, at_x, at_y);
    }
    const double radius = valid_radius(photo.distortion);
    const PremultipliedImage from(foreground);
    Image<Rgba8> result(target.width, target.height);
    for (int y = 0; y < target.height; ++y) {
        const double v = (y + 0.5 - target.cy) / target.fl_y;
        for (int x = 0; x < target.width; ++x) {
            const double px = at_x(y, x) + 0.5, py = at_y(y, x) + 0.5;
            if (!(std::hypot((x + 0.5 - target.cx) / target.fl_x, v) < radius)) continue;
            if (!(px >= -1 && py >= -1 && px <= foreground.width() + 1 && py <= foreground.height() + 1)) continue;
            result(x, y) = from.sample(px, py);
        }
    }
    bleed_colours(result);
    return result;
}

cv::Mat1b distorted_mask(const PosedCamera& photo, const Camera& target, const cv::Mat1b& mask) {
    const cv::Size size(photo.camera.width, photo.camera.height);
    cv::Mat2f at(size);
    const double radius = valid_radius(photo.distortion);
    std::vector<cv::Point2d> positions(static_cast<std::size_t>(size.width));
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) positions[static_cast<std::size_t>(x)] = cv::Point2d(x, y);
        const std::vector<cv::Point2d> points = undistorted_points(photo, positions, 0.02);
        for (int x = 0; x < size.width; ++x) {
            const cv::Point2d& p = points[static_cast<std::size_t>(x)];
            const bool is_valid = std::hypot(p.x, p.y) < radius;
            const double u = target.cx + target.fl_x * p.x - 0.5, v = target.cy + target.fl_y * p.y - 0.5;
            at(y, x) = is_valid ? cv::Vec2f(static_cast<float>(u), static_cast<float>(v)) : cv::Vec2f(-9, -9);
        }
    }
    cv::Mat1b resampled;
    cv::remap(mask, resampled, at, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_CONSTANT, 0);
    cv::threshold(resampled, resampled, 127, 255, cv::THRESH_BINARY);
    return resampled;
}

}  // namespace rs::capture
