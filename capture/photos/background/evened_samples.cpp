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

EvenedSamples::EvenedSamples(std::span<const Image<Rgba8>> samples)
    : samples_(samples), smooth_(samples.size()), codes_(samples.size()) {
    RS_CHECK(!samples.empty());
    for (Codes& codes : codes_) codes.fill(divided_by(1));
    for_each_index(samples.size(), [&](std::size_t i) {
        smooth_[i] = Image<Rgba8>(samples[i].width(), samples[i].height());
        cv::Mat smooth = writable_mat_over(smooth_[i]);
        cv::GaussianBlur(mat_over(samples[i]), smooth, {3, 3}, 0, 0, cv::BORDER_REPLICATE);
    });
}

void EvenedSamples::even_out(ConstImageView<Rgba8> still, ConstImageView<std::uint8_t> untouched, float least_change) {
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
    if (std::max({change(&LinearRgb::r), change(&LinearRgb::g), change(&LinearRgb::b)}) < least_change) return;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        codes_[i] = {divided_by(gains[i].r), divided_by(gains[i].g), divided_by(gains[i].b)};
    }
}

}  // namespace rs::capture
