#include "capture/photos/background/exposure_normalized_frames.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace rs::capture {
ExposureNormalizedFrames::ExposureNormalizedFrames(std::span<const Image<Rgba8>> frames)
    : frames_(frames), code_maps_(frames.size()) {
    RS_CHECK(!frames.empty());
    for (CodeMap& map : code_maps_) map.fill(exposure_division_table(1));
    smooth_.resize(index_of(0, height()));
    constexpr int kBand_px = 32;
    for_each_index((height() + kBand_px - 1) / kBand_px, [&](int band) {
        const int top = kBand_px * band, bottom = std::min(height(), top + kBand_px);
        const int from = std::max(0, top - 1), to = std::min(height(), bottom + 1);  // with the filter's support
        cv::Mat4b smooth;
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            cv::GaussianBlur(mat_view(frames_[i]).rowRange(from, to), smooth, {3, 3}, 0, 0,
                             cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
            for (int y = top; y < bottom; ++y) {
                for (int x = 0; x < width(); ++x) {
                    const cv::Vec4b& p = smooth(y - from, x);
                    smooth_[index_of(x, y) + i] = {p[0], p[1], p[2], p[3]};
                }
            }
        }
    });
}

bool ExposureNormalizedFrames::normalize(ConstImageView<Rgba8> background, ConstImageView<std::uint8_t> always_visible,
                                         float min_change) {
    Image<LinearRgb> light(background.width(), background.height());
    for (int y = 0; y < background.height(); ++y) {
        for (int x = 0; x < background.width(); ++x) light(x, y) = linear_rgb(background(x, y));
    }
    std::vector<LinearRgb> gains;
    for (const Image<Rgba8>& frame : frames_) gains.push_back(exposure_gain(frame, light, always_visible));
    const auto change = [&](float LinearRgb::*channel) {
        const auto [min, max] = std::ranges::minmax(gains, {}, channel);
        return max.*channel / min.*channel;
    };
    if (std::max({change(&LinearRgb::r), change(&LinearRgb::g), change(&LinearRgb::b)}) < min_change) return false;
    const std::vector<CodeMap> before = code_maps_;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
        code_maps_[i] = {exposure_division_table(gains[i].r), exposure_division_table(gains[i].g),
                         exposure_division_table(gains[i].b)};
    }
    return code_maps_ != before;
}

}  // namespace rs::capture
