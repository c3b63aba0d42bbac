#include "capture/photos/background/evened_samples.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "rayspace/base/check.hpp"
#include "rayspace/base/parallel_loop.hpp"
#include "rayspace/image/linear_light.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace rs::capture {
namespace {

std::array<std::uint8_t, 256> divided_by(float gain) {
    std::array<std::uint8_t, 256> codes{};
    for (std::size_t code = 0; code < codes.size(); ++code) {
        const auto own = static_cast<std::uint8_t>(code);
        codes[code] = srgb8_from_linear(linear_from_srgb8(own) / gain);
    }
    codes[255] = 255;  // a clipped value may have been anything
    return codes;
}

}  // namespace

EvenedSamples::EvenedSamples(std::span<const Image<Rgba8>> samples) : samples_(samples), codes_(samples.size()) {
    RS_CHECK(!samples.empty());
    for (Codes& codes : codes_) codes.fill(divided_by(1));
    smooth_.resize(place(0, height()));
    constexpr int kBand_px = 32;
    for_each_index((height() + kBand_px - 1) / kBand_px, [&](int band) {
        const int top = kBand_px * band, bottom = std::min(height(), top + kBand_px);
        const int from = std::max(0, top - 1), behind = std::min(height(), bottom + 1);  // with what is smoothed over
        cv::Mat4b smooth;
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            cv::GaussianBlur(mat_over(samples_[i]).rowRange(from, behind), smooth, {3, 3}, 0, 0,
                             cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
            for (int y = top; y < bottom; ++y) {
                for (int x = 0; x < width(); ++x) {
                    const cv::Vec4b& p = smooth(y - from, x);
                    smooth_[place(x, y) + i] = {p[0], p[1], p[2], p[3]};
                }
            }
        }
    });
}

bool EvenedSamples::even_out(ConstImageView<Rgba8> still, ConstImageView<std::uint8_t> untouched, float least_change) {
    Image<LinearRgb> plate(still.width(), still.height());
    for (int y = 0; y < still.height(); ++y) {
        for (int x = 0; x < still.width(); ++x) plate(x, y) = linear_rgb(still(x, y));
    }
    std::vector<LinearRgb> gains;
    for (const Image<Rgba8>& sample : samples_) gains.push_back(exposure_gain(sample, plate, untouched));
    const auto change = [&](float LinearRgb::*channel) {
        const auto [least, most] = std::ranges::minmax(gains, {}, channel);
        return most.*channel / least.*channel;
    };
    if (std::max({change(&LinearRgb::r), change(&LinearRgb::g), change(&LinearRgb::b)}) < least_change) return false;
    const std::vector<Codes> before = codes_;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        codes_[i] = {divided_by(gains[i].r), divided_by(gains[i].g), divided_by(gains[i].b)};
    }
    return codes_ != before;
}

}  // namespace rs::capture
