#include "capture/calibration/points/patch_image.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <span>

namespace rs::capture {
namespace {

constexpr int kBorder_px = 2;  // of an image; not used
constexpr int kSolid_code = 250;
constexpr int kAround_px = 5;  // margin around solid pixels: reach of the filter and the differences
constexpr std::array<float, 5> kSmoothing{0.03F, 0.235F, 0.47F, 0.235F, 0.03F};

struct SolidBox {
    int left = 0, top = 0, width = 0, height = 0;
};

SolidBox box_around_solid(const Image<std::uint8_t>& alpha) {
    const auto solid = [](std::uint8_t code) { return code > kSolid_code; };
    int left = alpha.width(), right = 0, top = alpha.height(), bottom = 0;
    for (int y = 0; y < alpha.height(); ++y) {
        const std::span<const std::uint8_t> row = alpha.view().row_span(y);
        const auto first = std::find_if(row.begin(), row.end(), solid);
        if (first == row.end()) continue;
        const auto last = std::find_if(row.rbegin(), row.rend(), solid);
        left = std::min(left, static_cast<int>(first - row.begin()));
        right = std::max(right, static_cast<int>(row.rend() - last));
        top = std::min(top, y);
        bottom = y + 1;
    }
    if (left >= right) return {};
    left = std::max(0, left - kAround_px);
    top = std::max(0, top - kAround_px);
    right = std::min(alpha.width(), right + kAround_px);
    bottom = std::min(alpha.height(), bottom + kAround_px);
    return {left, top, right - left, bottom - top};
}

Image<float> smoothed(ConstImageView<std::uint8_t> grey) {
    const int width = grey.width(), height = grey.height();
    std::vector<float> padded(static_cast<std::size_t>(width) + 4);
    Image<float> across(width, height), result(width, height);
    for (int y = 0; y < height; ++y) {
        const std::span<const std::uint8_t> row = grey.row_span(y);
        std::copy(row.begin(), row.end(), padded.begin() + 2);
        std::fill_n(padded.begin(), 2, static_cast<float>(row.front()));
        std::fill_n(padded.end() - 2, 2, static_cast<float>(row.back()));
        const float* const in = padded.data();
        float* const out = across.row(y);
        for (int x = 0; x < width; ++x) {
            out[x] = kSmoothing[0] * in[x] + kSmoothing[1] * in[x + 1] + kSmoothing[2] * in[x + 2] +
                     kSmoothing[3] * in[x + 3] + kSmoothing[4] * in[x + 4];
        }
    }
    for (int y = 0; y < height; ++y) {
        const auto in = [&](int k) { return across.row(std::clamp(y + k, 0, height - 1)); };
        const float *const a = in(-2), *const b = in(-1), *const c = in(0), *const d = in(1), *const e = in(2);
        float* const out = result.row(y);
        for (int x = 0; x < width; ++x) {
            out[x] = kSmoothing[0] * a[x] + kSmoothing[1] * b[x] + kSmoothing[2] * c[x] + kSmoothing[3] * d[x] +
                     kSmoothing[4] * e[x];
        }
    }
    return result;
}

}  // namespace

PatchImage::PatchImage(const CalibrationImage& image) {
    const SolidBox box = box_around_solid(image.alpha);
    left_ = box.left;
    top_ = box.top;
    texels_ = Image<Texel>(box.width, box.height);
    const auto crop = [&](const Image<std::uint8_t>& plane) {
        return plane.view().crop(box.left, box.top, box.width, box.height);
    };
    const Image<float> grey = smoothed(crop(image.grey));
    const ConstImageView<std::uint8_t> alpha = crop(image.alpha);
    const auto inner = [](int at, int count) { return (at >= kBorder_px) & (at < count - kBorder_px); };
    for (int y = 0; y < box.height; ++y) {
        const float* const here = grey.row(y);
        const float* const above = grey.row(std::max(0, y - 1));
        const float* const below = grey.row(std::min(box.height - 1, y + 1));
        const bool row_is_inner = inner(top_ + y, image.alpha.height());
        const std::uint8_t* const codes = alpha.row(y);
        Texel* const texels = texels_.row(y);
        const auto put = [&](int x, int before, int behind) {
            const bool solid = row_is_inner & inner(left_ + x, image.alpha.width()) & (codes[x] > kSolid_code);
            texels[x] = {here[x], 0.5F * (here[behind] - here[before]), 0.5F * (below[x] - above[x]),
                         solid ? 1.0F : 0.0F};
        };
        const int last = box.width - 1;
        put(0, 0, std::min(1, last));
        for (int x = 1; x < last; ++x) put(x, x - 1, x + 1);
        put(last, std::max(0, last - 1), last);
    }
}

bool PatchImage::is_solid(const glm::dvec2& p) const {
    if (!(p.x >= left_ && p.y >= top_ && p.x < left_ + texels_.width() && p.y < top_ + texels_.height())) return false;
    return texels_(static_cast<int>(p.x) - left_, static_cast<int>(p.y) - top_).solid > 0;
}

SeenRow PatchImage::row(const Warp& warp, int j) const {
    SeenRow seen;
    // Relative to a corner up and left of the patch, so that numbers are positive and truncation rounds down.
    constexpr int kReach_px = 64;
    const glm::dvec2 corner = glm::floor(warp.centre) - static_cast<double>(kReach_px);
    const double y2 = 0.5 * j * j;
    const glm::dvec2 start = warp.centre - corner - 0.5 + warp.matrix[1] * static_cast<double>(j) + warp.bent[1] * y2;
    const glm::dvec2 along = warp.matrix[0] + warp.bent[2] * static_cast<double>(j);
    const glm::vec2 s(start), m(along), q(0.5 * warp.bent[0]);
    PatchRow xs, ys;
    for (std::size_t c = 0; c < kPatchColumns; ++c) {
        const float i = static_cast<float>(c) - static_cast<float>(kPatchHalf_px);
        xs[c] = s.x + i * (m.x + i * q.x);
        ys[c] = s.y + i * (m.y + i * q.y);
    }
    const int off_x = static_cast<int>(corner.x) - left_, off_y = static_cast<int>(corner.y) - top_;
    for (std::size_t c = 0; c + 1 < kPatchColumns; ++c) {
        if (!(xs[c] > 0 && xs[c] < 2 * kReach_px && ys[c] > 0 && ys[c] < 2 * kReach_px)) continue;
        const int left = static_cast<int>(xs[c]), top = static_cast<int>(ys[c]);
        const float u = xs[c] - static_cast<float>(left), v = ys[c] - static_cast<float>(top);
        const int x = left + off_x, y = top + off_y;
        if (x < 0 || y < 0 || x + 1 >= texels_.width() || y + 1 >= texels_.height()) continue;
        const Texel* const upper = texels_.row(y) + x;
        const Texel* const lower = texels_.row(y + 1) + x;
        if ((v < 0.5F ? upper : lower)[u < 0.5F ? 0 : 1].solid == 0) continue;
        using Numbers = Eigen::Map<const Eigen::Array4f, Eigen::Aligned16>;
        const Eigen::Array4f a = Numbers(&upper[0].value), b = Numbers(&upper[1].value);
        const Eigen::Array4f d = Numbers(&lower[0].value), e = Numbers(&lower[1].value);
        const Eigen::Array4f over = a + u * (b - a);
        const Eigen::Array4f mixed = over + v * (d + u * (e - d) - over);
        seen.value[c] = mixed[0];
        seen.slope_x[c] = mixed[1];
        seen.slope_y[c] = mixed[2];
        seen.counts[c] = 1;
    }
    return seen;
}

}  // namespace rs::capture
