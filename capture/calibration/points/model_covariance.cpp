#include "capture/calibration/points/model_covariance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rs::capture {
namespace {

// Derivatives of the axis' position with respect to the camera's numbers, by differences.
std::array<double, kCameraNumbers> axis_slopes(const TurntableModel& model, double at_px) {
    std::array<double, kCameraNumbers> slopes{};
    for (std::size_t k = 0; k < slopes.size(); ++k) {
        const double step = k < 3 ? 1e-3 : 1e-6;
        std::array<double, 2> value{};
        for (std::size_t side = 0; side < 2; ++side) {
            Lens lens = model.lens;
            CameraPose pose = model.pose;
            const std::array<double*, kCameraNumbers> numbers{
                &lens.f_px, &lens.cx, &lens.cy, &lens.k1, &lens.k2, &pose.pan_rad, &pose.tilt_rad, &pose.roll_rad};
            *numbers[k] += side == 0 ? -step : step;
            value[side] = axis_position(lens, pose, at_px).value_or(0);
        }
        slopes[k] = (value[1] - value[0]) / (2 * step);
    }
    return slopes;
}

}  // namespace

NumberPlaces::NumberPlaces(const BundleFreedom& free, const std::vector<bool>& is_seen) {
    const std::array<bool, kCameraNumbers> camera_free{
        free.f, free.principal_point, free.principal_point, free.k1, free.k2, free.pan, free.tilt, free.roll};
    for (std::size_t k = 0; k < kCameraNumbers; ++k) camera[k] = camera_free[k] ? count++ : -1;
    for (std::size_t view = 0; view < is_seen.size(); ++view) {
        const bool is_free = free.angles == AngleFreedom::kEach && view > 0 && is_seen[view];
        angles.push_back(is_free ? count++ : -1);
    }
    if (free.angles == AngleFreedom::kCommonStep) step = count++;
}

TurntableModel stepped(TurntableModel model, const NumberPlaces& places, const Eigen::VectorXd& step) {
    const std::array<double*, kCameraNumbers> numbers{&model.lens.f_px,     &model.lens.cx,      &model.lens.cy,
                                                      &model.lens.k1,       &model.lens.k2,      &model.pose.pan_rad,
                                                      &model.pose.tilt_rad, &model.pose.roll_rad};
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        if (places.camera[k] >= 0) *numbers[k] += step(places.camera[k]);
    }
    for (std::size_t view = 0; view < model.angles_rad.size(); ++view) {
        if (places.angles[view] >= 0) model.angles_rad[view] += step(places.angles[view]);
        if (places.step >= 0) model.angles_rad[view] += static_cast<double>(view) * step(places.step);
    }
    return model;
}

ModelDeviations deviations_of(const TurntableModel& model, const NumberPlaces& places,
                              const Eigen::MatrixXd& covariance, double at_px) {
    if (covariance.size() == 0 && places.count > 0) {
        ModelDeviations unknown;
        unknown.angles_rad.assign(model.angles_rad.size(), std::numeric_limits<double>::infinity());
        return unknown;
    }
    const auto of = [&](const Eigen::VectorXd& gradient) {
        return std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)));
    };
    const auto one = [&](std::size_t number) {
        const int place = places.camera[number];
        return place < 0 ? 0.0 : std::sqrt(std::max(0.0, covariance(place, place)));
    };
    ModelDeviations deviations;
    deviations.f_px = one(CameraNumber::kF);
    deviations.cx = one(CameraNumber::kCx);
    deviations.cy = one(CameraNumber::kCy);
    deviations.k1 = one(CameraNumber::kK1);
    deviations.k2 = one(CameraNumber::kK2);
    deviations.tilt_rad = one(CameraNumber::kTilt);
    deviations.roll_rad = one(CameraNumber::kRoll);
    deviations.axis_direction_rad =
        std::hypot(deviations.tilt_rad, std::cos(model.pose.tilt_rad) * deviations.roll_rad);
    const auto slopes = axis_slopes(model, at_px);
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(covariance.rows());
    for (std::size_t k = 0; k < slopes.size(); ++k) {
        if (places.camera[k] >= 0) gradient(places.camera[k]) = slopes[k];
    }
    deviations.axis_position_px = of(gradient);
    // Angles count from the mean of all views: the first view's own error would otherwise be in every other one.
    const std::size_t views = places.angles.size();
    for (std::size_t view = 0; view < views; ++view) {
        Eigen::VectorXd from_mean = Eigen::VectorXd::Zero(covariance.rows());
        for (std::size_t other = 0; other < views; ++other) {
            const int place = places.angles[other];
            if (place >= 0) from_mean(place) = (other == view ? 1.0 : 0.0) - 1.0 / static_cast<double>(views);
        }
        if (places.step >= 0) {
            from_mean(places.step) = static_cast<double>(view) - 0.5 * static_cast<double>(views - 1);
        }
        deviations.angles_rad.push_back(of(from_mean));
    }
    return deviations;
}

}  // namespace rs::capture
