#include "capture/photos/segmentation/turn_silhouette.hpp"

#include "rayspace/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rs::capture {
namespace {

constexpr int kVisible = 8;  // alpha codes
constexpr int kSolid = 128;
constexpr std::size_t kMinRows = 8;

}  // namespace

TurnSilhouette::TurnSilhouette(int width, int height)
    : width_(width),
      left_(static_cast<std::size_t>(height), width),
      right_(static_cast<std::size_t>(height), -1),
      visible_{width, 0, height, 0} {}

void TurnSilhouette::add(ConstImageView<Rgba8> foreground) {
    RS_CHECK(foreground.width() == width_ && static_cast<std::size_t>(foreground.height()) == left_.size());
    for (int y = 0; y < foreground.height(); ++y) {
        const auto row = static_cast<std::size_t>(y);
        for (int x = 0; x < foreground.width(); ++x) {
            const int alpha = foreground(x, y).a;
            if (alpha >= kSolid) {
                left_[row] = std::min(left_[row], x);
                right_[row] = std::max(right_[row], x);
            }
            if (alpha >= kVisible) {
                visible_ = {std::min(visible_.left, x), std::max(visible_.right, x + 1), std::min(visible_.top, y),
                            std::max(visible_.bottom, y + 1)};
            }
        }
    }
}

void TurnSilhouette::merge(const TurnSilhouette& other) {
    RS_CHECK(width_ == other.width_ && left_.size() == other.left_.size());
    for (std::size_t row = 0; row < left_.size(); ++row) {
        left_[row] = std::min(left_[row], other.left_[row]);
        right_[row] = std::max(right_[row], other.right_[row]);
    }
    visible_ = {std::min(visible_.left, other.visible_.left), std::max(visible_.right, other.visible_.right),
                std::min(visible_.top, other.visible_.top), std::max(visible_.bottom, other.visible_.bottom)};
}

std::optional<TurnSilhouette::Axis> TurnSilhouette::axis() const {
    std::vector<double> middles;
    for (std::size_t row = 0; row < left_.size(); ++row) {
        if (left_[row] <= right_[row] && left_[row] > 0 && right_[row] < width_ - 1) {
            middles.push_back((left_[row] + right_[row] + 1) / 2.0);
        }
    }
    if (middles.size() < kMinRows) return std::nullopt;
    Axis axis;
    axis.x_px = median(middles);
    for (double& middle : middles) middle = std::abs(middle - axis.x_px);
    axis.spread_px = median(middles);
    return axis;
}

}  // namespace rs::capture
