#include "capture/photos/intake/video/frame_copy.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/base/median.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace rs::capture {
namespace {

constexpr std::size_t kTimeSamples = 48;  // frames sampled for statistics per pixel over time

Image<std::uint8_t> compute_luma(ConstImageView<Rgba8> frame) {
    Image<std::uint8_t> luma(frame.width(), frame.height());
    for (int y = 0; y < frame.height(); ++y) {
        const Rgba8* const from = frame.row(y);
        std::uint8_t* const to = luma.row(y);
        for (int x = 0; x < frame.width(); ++x) {
            to[x] = static_cast<std::uint8_t>((77 * from[x].r + 150 * from[x].g + 29 * from[x].b + 128) >> 8);
        }
    }
    return luma;
}

cv::Mat1b mat_of(const Image<std::uint8_t>& image) {
    return {image.height(), image.width(), const_cast<std::uint8_t*>(image.data())};
}

// Squared 4-neighbour Laplacians of a row, summed over the columns of each cell.
void add_laplacians(const Image<std::uint8_t>& luma, int y, double columns_per_cell, std::vector<int>& squares,
                    float* sums, int cells) {
    const std::uint8_t* const above = luma.row(y - 1);
    const std::uint8_t* const row = luma.row(y);
    const std::uint8_t* const below = luma.row(y + 1);
    for (int x = 1; x + 1 < luma.width(); ++x) {
        const int laplacian = 4 * row[x] - row[x - 1] - row[x + 1] - above[x] - below[x];
        squares[static_cast<std::size_t>(x)] = laplacian * laplacian;
    }
    for (int cell = 0; cell < cells; ++cell) {
        const int begin = static_cast<int>(cell * columns_per_cell);
        const int end = std::min(luma.width(), static_cast<int>((cell + 1) * columns_per_cell));
        std::int64_t sum = 0;
        for (int x = begin; x < end; ++x) sum += squares[static_cast<std::size_t>(x)];
        sums[cell] += static_cast<float>(sum);
    }
}

Image<float> compute_detail(const Image<std::uint8_t>& luma, int copy_width, int copy_height) {
    const int width = std::max(1, copy_width / kDetailCell_px), height = std::max(1, copy_height / kDetailCell_px);
    Image<float> detail(width, height);
    if (luma.width() < 3 || luma.height() < 3) return detail;
    const double columns = static_cast<double>(luma.width()) / width;
    const double rows = static_cast<double>(luma.height()) / height;
    std::vector<int> squares(static_cast<std::size_t>(luma.width()), 0);
    for (int y = 1; y + 1 < luma.height(); ++y) {
        const int cell = std::min(height - 1, static_cast<int>(y / rows));
        add_laplacians(luma, y, columns, squares, detail.row(cell), width);
    }
    for (float& sum : detail.pixels()) sum /= static_cast<float>(columns * rows);
    return detail;
}

std::vector<std::size_t> sample_frames(std::size_t count) {
    std::vector<std::size_t> samples;
    const std::size_t sample_count = std::min(count, kTimeSamples);
    for (std::size_t s = 0; s < sample_count; ++s) samples.push_back(s * count / sample_count);
    return samples;
}

// Calls use(x, y, codes) for every pixel with its codes in the sampled frames.
template <class Use>
void for_each_pixel_over_time(const std::vector<FrameCopy>& copies, const Use& use) {
    const std::vector<std::size_t> samples = sample_frames(copies.size());
    const int width = copies.front().luma.width(), height = copies.front().luma.height();
    std::vector<std::uint8_t> codes(samples.size());
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (std::size_t s = 0; s < samples.size(); ++s) codes[s] = copies[samples[s]].luma(x, y);
            use(x, y, codes);
        }
    }
}

float estimate_gain(const Image<std::uint8_t>& luma, const Image<std::uint8_t>& reference) {
    constexpr int kDarkLuma_code = 24;
    constexpr int kClippedLuma_code = 248;
    constexpr std::size_t kMinPixelFraction = 50;  // one in 50 pixels
    std::vector<float> ratios;
    for (std::size_t i = 0; i < luma.pixels().size(); ++i) {
        const int here = luma.pixels()[i], there = reference.pixels()[i];
        if (std::min(here, there) < kDarkLuma_code || std::max(here, there) > kClippedLuma_code) continue;
        ratios.push_back(static_cast<float>(there) / static_cast<float>(here));
    }
    if (ratios.size() < luma.pixels().size() / kMinPixelFraction + 1) return 1;
    return std::clamp(median_of(std::span(ratios)), 0.5F, 2.0F);
}

}  // namespace

FrameCopy make_frame_copy(ConstImageView<Rgba8> frame) {
    RS_CHECK(!frame.empty());
    const Image<std::uint8_t> luma = compute_luma(frame);
    const double scale = std::min(1.0, static_cast<double>(kCopySide_px) / std::max(frame.width(), frame.height()));
    const int width = std::max(1, static_cast<int>(std::lround(frame.width() * scale)));
    const int height = std::max(1, static_cast<int>(std::lround(frame.height() * scale)));
    FrameCopy copy{Image<std::uint8_t>(width, height), compute_detail(luma, width, height)};
    cv::Mat1b to(height, width, copy.luma.data());
    cv::resize(mat_of(luma), to, to.size(), 0, 0, cv::INTER_AREA);
    return copy;
}

void normalize_exposure(std::vector<FrameCopy>& copies) {
    if (copies.size() < 3) return;
    Image<std::uint8_t> reference(copies.front().luma.width(), copies.front().luma.height());
    for_each_pixel_over_time(
        copies, [&](int x, int y, std::vector<std::uint8_t>& codes) { reference(x, y) = median_of(std::span(codes)); });
    for (FrameCopy& copy : copies) {
        constexpr float kNegligible = 0.004F;  // a code of 255
        const float gain = estimate_gain(copy.luma, reference);
        if (std::abs(gain - 1) < kNegligible) continue;
        std::array<std::uint8_t, 256> codes{};
        for (std::size_t code = 0; code < codes.size(); ++code) {
            codes[code] = static_cast<std::uint8_t>(std::min(255.0F, static_cast<float>(code) * gain + 0.5F));
        }
        for (std::uint8_t& code : copy.luma.pixels()) code = codes[code];
        for (float& square : copy.detail.pixels()) square *= gain * gain;
    }
}

Image<std::uint8_t> moving_region(const std::vector<FrameCopy>& copies) {
    RS_CHECK(!copies.empty());
    constexpr int kMinRange_codes = 14;
    Image<std::uint8_t> moving(copies.front().luma.width(), copies.front().luma.height());
    for_each_pixel_over_time(copies, [&](int x, int y, std::vector<std::uint8_t>& codes) {
        std::sort(codes.begin(), codes.end());
        const std::size_t edge = codes.size() / 20;
        moving(x, y) = codes[codes.size() - 1 - edge] - codes[edge] >= kMinRange_codes ? 255 : 0;
    });
    // Removes single pixels, which are noise.
    cv::Mat1b mask = mat_of(moving);
    cv::medianBlur(mask, mask, 3);
    return moving;
}

}  // namespace rs::capture
