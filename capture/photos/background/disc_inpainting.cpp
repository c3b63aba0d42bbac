#include "capture/photos/background/disc_inpainting.hpp"

#include "capture/opencv/connected_components.hpp"
#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/background/background_estimate.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/base/median.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kDirections = 512;

// The disc in polar coordinates.
struct UnrolledDisc {
    struct Gap {  // unknown pixel
        int x, y;
        float circle, direction;
    };
    cv::Mat4f light;  // [circle][direction]: sums of linear R, G, B of the known pixels, and their number
    std::vector<Gap> gaps;
};

UnrolledDisc unroll(const TurntableDisc& disc, const Image<Rgba8>& plate, const Image<std::uint8_t>& known) {
    const DiscPlane plane(disc, plate.width(), plate.height());
    const double unit = plane.unit_per_px();
    const int circles = std::max(1, static_cast<int>(disc.radius / unit));
    UnrolledDisc unrolled{cv::Mat4f(circles, kDirections, cv::Vec4f()), {}};
    const cv::Mat3f linear = linear_mat(plate);
    for (int y = 0; y < plate.height(); ++y) {
        for (int x = 0; x < plate.width(); ++x) {
            const glm::dvec2 px(x + 0.5, y + 0.5);
            if (!plane.is_below_horizon(px)) continue;
            const glm::dvec2 p = plane.plane_from_px(px);
            const double circle = glm::length(p) / unit;
            if (circle >= circles) continue;
            const double turns = std::atan2(p.y, p.x) / (2 * std::numbers::pi);
            const double direction = (turns - std::floor(turns)) * kDirections;
            if (known(x, y) == 0) {
                unrolled.gaps.push_back({x, y, static_cast<float>(circle), static_cast<float>(direction)});
                continue;
            }
            const cv::Vec3f& c = linear(y, x);
            const int column = std::min(kDirections - 1, static_cast<int>(direction));
            unrolled.light(static_cast<int>(circle), column) += cv::Vec4f(c[0], c[1], c[2], 1);
        }
    }
    return unrolled;
}

// Interpolates every circle linearly between its known directions; -1 where a circle has none.
cv::Mat3f interpolated_circles(const cv::Mat4f& unrolled) {
    constexpr float kMinWeight = 0.05F;
    // Along the circle, wrapped: averages noise and closes gaps between samples.
    cv::Mat4f wrapped;
    cv::copyMakeBorder(unrolled, wrapped, 0, 0, kDirections, kDirections, cv::BORDER_WRAP);
    cv::GaussianBlur(wrapped, wrapped, {13, 1}, 4, 0, cv::BORDER_REPLICATE);
    const auto blurred = [&](int row, int column) -> const cv::Vec4f& { return wrapped(row, column + kDirections); };
    const auto at = [](int column) { return static_cast<std::size_t>(column); };
    cv::Mat3f filled(unrolled.rows, kDirections, cv::Vec3f(-1, -1, -1));
    for (int row = 0; row < unrolled.rows; ++row) {
        // Steps to the nearest known direction on either side; correct after the second pass around the circle.
        std::array<int, kDirections> left{};
        std::array<int, kDirections> right{};
        left.fill(kDirections);
        right.fill(kDirections);
        for (int i = 0; i < 2 * kDirections; ++i) {
            const int forth = i % kDirections;
            const int before = (forth + kDirections - 1) % kDirections;
            const int back = kDirections - 1 - forth;
            const int after = (back + 1) % kDirections;
            left[at(forth)] = blurred(row, forth)[3] >= kMinWeight ? 0 : std::min(kDirections, left[at(before)] + 1);
            right[at(back)] = blurred(row, back)[3] >= kMinWeight ? 0 : std::min(kDirections, right[at(after)] + 1);
        }
        for (int column = 0; column < kDirections; ++column) {
            const int to_left = left[at(column)];
            const int to_right = right[at(column)];
            if (to_left >= kDirections) break;  // nothing of this circle is known
            const cv::Vec4f& a = blurred(row, (column + kDirections - to_left) % kDirections);
            const cv::Vec4f& b = blurred(row, (column + to_right) % kDirections);
            const float t =
                to_left + to_right > 0 ? static_cast<float>(to_left) / static_cast<float>(to_left + to_right) : 0;
            const cv::Vec4f mixed = a * ((1 - t) / a[3]) + b * (t / b[3]);
            filled(row, column) = {mixed[0], mixed[1], mixed[2]};
        }
    }
    return filled;
}

// Fills unknown pixels of the disc from the known ones of the same circle and makes them known.
void inpaint_circles(const TurntableDisc& disc, Image<Rgba8>& plate, Image<std::uint8_t>& known) {
    const UnrolledDisc unrolled = unroll(disc, plate, known);
    const cv::Mat3f filled = interpolated_circles(unrolled.light);
    for (const UnrolledDisc::Gap& gap : unrolled.gaps) {
        const auto row = static_cast<int>(gap.circle);
        const auto column = std::min(kDirections - 1, static_cast<int>(gap.direction));
        const cv::Vec3f& c = filled(row, column);
        if (c[0] < 0) continue;
        plate(gap.x, gap.y) = rgba8_from_linear(c, 255);
        known(gap.x, gap.y) = 255;
    }
}

// Circles of the disc, one px wide at its centre, and how much of each is known.
class CircleCoverage {
public:
    CircleCoverage(const TurntableDisc& disc, ConstImageView<std::uint8_t> known, double min_visible_share)
        : min_visible_share_(min_visible_share) {
        const int width = known.width(), height = known.height();
        const DiscPlane plane(disc, width, height);
        const double unit = plane.unit_per_px();
        circles_ = std::max(1, static_cast<int>(disc.radius / unit));
        circle_of_ = Image<int>(width, height, circles_);
        all_.assign(static_cast<std::size_t>(circles_) + 1, 0);
        known_ = all_;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const glm::dvec2 px(x + 0.5, y + 0.5);
                if (!plane.is_below_horizon(px)) continue;
                const double circle = glm::length(plane.plane_from_px(px)) / unit;
                circle_of_(x, y) = static_cast<int>(std::min<double>(circles_, circle));
                const auto i = static_cast<std::size_t>(circle_of_(x, y));
                ++all_[i];
                known_[i] += known(x, y) != 0 ? 1 : 0;
            }
        }
    }
    [[nodiscard]] bool is_on_disc(int x, int y) const { return circle_of_(x, y) < circles_; }
    // True if the object leaves most of the pixel's circle visible.
    [[nodiscard]] bool is_mostly_visible(int x, int y) const {
        const auto i = static_cast<std::size_t>(circle_of_(x, y));
        return known_[i] >= min_visible_share_ * all_[i];
    }

private:
    double min_visible_share_;
    int circles_ = 0;
    Image<int> circle_of_;          // circles_ beyond the disc
    std::vector<int> all_, known_;  // [circle], px
};

// Median colour of the known pixels of mostly visible circles.
std::optional<Rgba8> bare_disc_colour(const CircleCoverage& circles, ConstImageView<Rgba8> colour,
                                      ConstImageView<std::uint8_t> known) {
    std::array<std::vector<std::uint8_t>, 3> codes;  // [channel]
    for (int y = 0; y < colour.height(); ++y) {
        for (int x = 0; x < colour.width(); ++x) {
            if (!circles.is_on_disc(x, y) || known(x, y) == 0 || !circles.is_mostly_visible(x, y)) continue;
            codes[0].push_back(colour(x, y).r);
            codes[1].push_back(colour(x, y).g);
            codes[2].push_back(colour(x, y).b);
        }
    }
    if (codes[0].empty()) return std::nullopt;
    return Rgba8{median(codes[0]), median(codes[1]), median(codes[2]), 255};
}

}  // namespace

Image<std::uint8_t> disc_mask(const TurntableDisc& disc, int width, int height, double reach,
                              const BackgroundParameters::Disc& parameters) {
    const DiscPlane plane(disc, width, height);
    const double unit = plane.unit_per_px();
    const double max_radius = std::max(disc.radius * (1 + reach), disc.radius + parameters.rim_blur_px * unit);
    Image<std::uint8_t> mask(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::dvec2 px(x + 0.5, y + 0.5);
            if (!plane.is_below_horizon(px)) continue;
            mask(x, y) = glm::length(plane.plane_from_px(px)) <= max_radius ? 255 : 0;
        }
    }
    return mask;
}

Image<std::uint8_t> static_foot(const TurntableDisc& disc, ConstImageView<Rgba8> colour,
                                ConstImageView<std::uint8_t> known, ConstImageView<std::uint8_t> swept,
                                const BackgroundParameters& parameters) {
    const int width = colour.width();
    const int height = colour.height();
    const CircleCoverage circles(disc, known, parameters.disc.min_visible_circle_share);
    Image<std::uint8_t> foot(width, height);
    const std::optional<Rgba8> disc_colour = bare_disc_colour(circles, colour, known);
    if (!disc_colour) return foot;
    const LinearRgb bare = linear_rgb(*disc_colour);
    const float max_delta_e = parameters.shadow.explained_delta_e;
    cv::Mat1b candidates(height, width, std::uint8_t{0});  // with the swept region, for the connection to it
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (swept(x, y) != 0) candidates(y, x) = 255;
            if (!circles.is_on_disc(x, y) || known(x, y) == 0 || circles.is_mostly_visible(x, y)) continue;
            const ShadowFit e = fit_shadow(linear_rgb(colour(x, y)), bare, parameters.shadow.min_shade, 1);
            if (e.plain > max_delta_e && e.shaded > max_delta_e) candidates(y, x) = 255;
        }
    }
    cv::morphologyEx(candidates, candidates, cv::MORPH_CLOSE, cv::Mat(), {-1, -1}, 1);
    const ConnectedComponents parts(candidates, 4);
    const auto swept_px = parts.accumulate<int>([&](int x, int y, int& count) { count += swept(x, y) != 0 ? 1 : 0; });
    parts.for_each_pixel([&](int x, int y, int label) {
        if (swept_px[label] > 0 && swept(x, y) == 0) foot(x, y) = 255;
    });
    return foot;
}

void inpaint_gaps(const std::optional<TurntableDisc>& disc, Image<Rgba8>& plate, Image<std::uint8_t>& known,
                  const BackgroundParameters& parameters) {
    RS_CHECK(plate.width() == known.width() && plate.height() == known.height());
    if (!disc) return inpaint_rows(plate, known, parameters.row_inpainting);
    const Image<std::uint8_t> on_disc = disc_mask(*disc, plate.width(), plate.height(), 0, parameters.disc);
    // Rows continue behind the disc.
    Image<Rgba8> without_disc = plate;
    Image<std::uint8_t> known_without_disc = known;
    for (int y = 0; y < known.height(); ++y) {
        for (int x = 0; x < known.width(); ++x) {
            if (on_disc(x, y) != 0) known_without_disc(x, y) = 0;
        }
    }
    inpaint_rows(without_disc, known_without_disc, parameters.row_inpainting);
    inpaint_circles(*disc, plate, known);
    for (int y = 0; y < known.height(); ++y) {
        for (int x = 0; x < known.width(); ++x) {
            if (known(x, y) != 0 || on_disc(x, y) != 0 || known_without_disc(x, y) == 0) continue;
            plate(x, y) = without_disc(x, y);
            known(x, y) = 255;
        }
    }
    inpaint_rows(plate, known, parameters.row_inpainting);
}

}  // namespace rs::capture
