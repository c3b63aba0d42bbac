#include "capture/calibration/silhouettes/distance_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rs::capture {

DistanceField::DistanceField(ConstImageView<float> distance_px)
    : width_(distance_px.width()), height_(distance_px.height()) {
    RS_CHECK(width_ >= 2 && height_ >= 2);
    row_of_tiles_ =
        column(width_ - 1) / (kTileWidth * kTileHeight) * (kTileWidth * kTileHeight) + kTileWidth * kTileHeight;
    tiles_.resize((row(height_ - 1) / row_of_tiles_ + 1) * row_of_tiles_ / (kTileWidth * kTileHeight));
    std::int16_t* const samples = tiles_.front().data();
    using Limits = std::numeric_limits<std::int16_t>;
    for (int y = 0; y < height_; ++y) {
        for (int x = 0; x < width_; ++x) {
            const float units = std::round(distance_px(x, y) / kPxPerUnit);
            samples[row(y) + column(x)] = static_cast<std::int16_t>(
                std::clamp(units, static_cast<float>(Limits::min()), static_cast<float>(Limits::max())));
        }
    }
}

}  // namespace rs::capture
