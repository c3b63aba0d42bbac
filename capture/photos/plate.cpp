#include "capture/photos/plate.hpp"

#include "capture/photos/opencv_image.hpp"

#include <tbb/parallel_for.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace rs::capture {
namespace {

constexpr int kAgreement_codes = 14;

bool agree(const Rgba8& a, const Rgba8& b) {
    return std::abs(a.r - b.r) <= kAgreement_codes && std::abs(a.g - b.g) <= kAgreement_codes &&
           std::abs(a.b - b.b) <= kAgreement_codes;
}

struct Group {
    Rgba8 mean;
    std::size_t size = 0;
};

Group largest_group(std::span<const Rgba8> values) {
    std::size_t best = 0;
    std::size_t best_size = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        std::size_t size = 0;
        for (const Rgba8& other : values) size += agree(values[i], other) ? 1 : 0;
        if (size > best_size) {
            best_size = size;
            best = i;
        }
        if (size == values.size()) break;  // a still pixel, the usual case
    }
    std::array<std::size_t, 3> sum{};
    for (const Rgba8& value : values) {
        if (!agree(values[best], value)) continue;
        sum[0] += value.r;
        sum[1] += value.g;
        sum[2] += value.b;
    }
    const auto mean = [&](std::size_t s) { return static_cast<std::uint8_t>((s + best_size / 2) / best_size); };
    return {{mean(sum[0]), mean(sum[1]), mean(sum[2]), 255}, best_size};
}

}  // namespace

StillPicture agree_over_time(std::span<const Image<Rgba8>> samples) {
    RS_CHECK(!samples.empty());
    const int width = samples[0].width();
    const int height = samples[0].height();
    StillPicture still{Image<Rgba8>(width, height), Image<float>(width, height)};
    tbb::parallel_for(0, height, [&](int y) {
        std::vector<Rgba8> values(samples.size());
        for (int x = 0; x < width; ++x) {
            for (std::size_t i = 0; i < samples.size(); ++i) values[i] = samples[i](x, y);
            const Group group = largest_group(values);
            still.colour(x, y) = group.mean;
            still.agreement(x, y) = static_cast<float>(group.size) / static_cast<float>(values.size());
        }
    });
    return still;
}

void fill_unknown(Image<Rgba8>& picture, const Image<std::uint8_t>& known) {
    RS_CHECK(picture.width() == known.width() && picture.height() == known.height());
    // Weighted colours, halved until one pixel is left (push) ...
    std::vector<cv::Mat4f> levels(1, cv::Mat4f(picture.height(), picture.width()));
    const cv::Mat3f linear = linear_mat(picture);
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            const cv::Vec3f& c = linear(y, x);
            levels[0](y, x) = known(x, y) != 0 ? cv::Vec4f(c[0], c[1], c[2], 1) : cv::Vec4f();
        }
    }
    while (levels.back().cols > 1 || levels.back().rows > 1) {
        cv::Mat4f half;
        cv::resize(levels.back(), half, {(levels.back().cols + 1) / 2, (levels.back().rows + 1) / 2}, 0, 0,
                   cv::INTER_AREA);
        levels.push_back(half);
    }
    if (levels.back()(0, 0)[3] <= 0) return;
    // ... then every level takes from the coarser one what it does not know itself (pull).
    cv::Mat4f filled(1, 1, levels.back()(0, 0) * (1 / levels.back()(0, 0)[3]));
    for (std::size_t level = levels.size() - 1; level-- > 0;) {
        cv::Mat4f finer;
        cv::resize(filled, finer, levels[level].size(), 0, 0, cv::INTER_LINEAR);
        for (int y = 0; y < finer.rows; ++y) {
            for (int x = 0; x < finer.cols; ++x) {
                const cv::Vec4f& own = levels[level](y, x);
                const float share = std::min(1.0F, own[3]);
                cv::Vec4f& out = finer(y, x);
                out = own + out * (1 - share);
                out *= 1 / out[3];
            }
        }
        filled = finer;
    }
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            if (known(x, y) != 0) continue;
            const cv::Vec4f& c = filled(y, x);
            picture(x, y) = rgba8_from_linear({c[0], c[1], c[2]}, 255);
        }
    }
}

}  // namespace rs::capture
