#include "capture/photos/background/disc_bridging.hpp"

#include "capture/opencv/connected_parts.hpp"
#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/background/disc_plane.hpp"
#include "capture/photos/background/still_picture.hpp"
#include "capture/photos/intake/colour_difference.hpp"
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

// Gives unknown pixels of the disc the colours of the known ones on the same circle, evenly from one end of the gap to
// the other, and makes them known. Circles of which nothing is known stay as they are.
void bridge_circles(const TurntableDisc& disc, Image<Rgba8>& plate, Image<std::uint8_t>& known) {
    RS_CHECK(plate.width() == known.width() && plate.height() == known.height());
    const DiscPlane plane(disc, plate.width(), plate.height());
    // The disc unrolled: a row per circle, a column per direction.
    const double unit = plane.unit_per_px();
    const int circles = std::max(1, static_cast<int>(disc.radius / unit));
    constexpr int kDirections = 512;
    cv::Mat4f unrolled(circles, kDirections, cv::Vec4f());  // linear light and weight
    struct Place {
        int x, y;
        float circle, direction;
    };
    std::vector<Place> unknown;
    const cv::Mat3f linear = linear_mat(plate);
    for (int y = 0; y < plate.height(); ++y) {
        for (int x = 0; x < plate.width(); ++x) {
            const glm::dvec2 px(x + 0.5, y + 0.5);
            if (!plane.below_horizon(px)) continue;
            const glm::dvec2 p = plane.from_axis(px);
            const double circle = glm::length(p) / unit;
            if (circle >= circles) continue;
            const double turn = std::atan2(p.y, p.x) / (2 * std::numbers::pi);
            const double direction = (turn - std::floor(turn)) * kDirections;
            if (known(x, y) == 0) {
                unknown.push_back({x, y, static_cast<float>(circle), static_cast<float>(direction)});
                continue;
            }
            const cv::Vec3f& c = linear(y, x);
            const int column = std::min(kDirections - 1, static_cast<int>(direction));
            unrolled(static_cast<int>(circle), column) += cv::Vec4f(c[0], c[1], c[2], 1);
        }
    }
    // Noise goes, and gaps between pixels close: a few circles and directions are taken together.
    cv::Mat4f wide;
    cv::copyMakeBorder(unrolled, wide, 0, 0, kDirections, kDirections, cv::BORDER_WRAP);
    cv::GaussianBlur(wide, wide, {13, 1}, 4, 0, cv::BORDER_REPLICATE);
    const auto seen = [&](int row, int column) -> const cv::Vec4f& { return wide(row, column + kDirections); };
    const auto at = [](int column) { return static_cast<std::size_t>(column); };
    constexpr float kSeen = 0.05F;
    cv::Mat3f filled(circles, kDirections, cv::Vec3f(-1, -1, -1));
    for (int row = 0; row < circles; ++row) {
        // Steps to the nearest seen direction either way; the second time around they are right.
        std::array<int, kDirections> left{};
        std::array<int, kDirections> right{};
        left.fill(kDirections);
        right.fill(kDirections);
        for (int i = 0; i < 2 * kDirections; ++i) {
            const int on = i % kDirections;
            const int before = (on + kDirections - 1) % kDirections;
            const int back = kDirections - 1 - on;
            const int after = (back + 1) % kDirections;
            left[at(on)] = seen(row, on)[3] >= kSeen ? 0 : std::min(kDirections, left[at(before)] + 1);
            right[at(back)] = seen(row, back)[3] >= kSeen ? 0 : std::min(kDirections, right[at(after)] + 1);
        }
        for (int column = 0; column < kDirections; ++column) {
            const int to_left = left[at(column)];
            const int to_right = right[at(column)];
            if (to_left >= kDirections) break;  // nothing of this circle is known
            const cv::Vec4f& a = seen(row, (column + kDirections - to_left) % kDirections);
            const cv::Vec4f& b = seen(row, (column + to_right) % kDirections);
            const float t =
                to_left + to_right > 0 ? static_cast<float>(to_left) / static_cast<float>(to_left + to_right) : 0;
            const cv::Vec4f mixed = a * ((1 - t) / a[3]) + b * (t / b[3]);
            filled(row, column) = {mixed[0], mixed[1], mixed[2]};
        }
    }
    for (const Place& place : unknown) {
        const auto row = static_cast<int>(place.circle);
        const auto column = std::min(kDirections - 1, static_cast<int>(place.direction));
        const cv::Vec3f& c = filled(row, column);
        if (c[0] < 0) continue;
        plate(place.x, place.y) = rgba8_from_linear(c, 255);
        known(place.x, place.y) = 255;
    }
}

}  // namespace

Image<std::uint8_t> disc_mask(const TurntableDisc& disc, int width, int height, double reach) {
    constexpr double kBlur_px = 2;
    const DiscPlane plane(disc, width, height);
    const double unit = plane.unit_per_px();
    const double most = std::max(disc.radius * (1 + reach), disc.radius + kBlur_px * unit);
    Image<std::uint8_t> mask(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::dvec2 px(x + 0.5, y + 0.5);
            if (!plane.below_horizon(px)) continue;
            mask(x, y) = glm::length(plane.from_axis(px)) <= most ? 255 : 0;
        }
    }
    return mask;
}

Image<std::uint8_t> still_foot(const TurntableDisc& disc, ConstImageView<Rgba8> still,
                               ConstImageView<std::uint8_t> known, ConstImageView<std::uint8_t> swept) {
    constexpr double kSeenShare = 0.6;  // of a circle: it is not the object that hides the rest
    constexpr float kUnlike_delta_e = 6;
    const int width = still.width();
    const int height = still.height();
    const DiscPlane plane(disc, width, height);
    const double unit = plane.unit_per_px();
    const int circles = std::max(1, static_cast<int>(disc.radius / unit));
    Image<int> circle_of(width, height, circles);
    std::vector<int> all(static_cast<std::size_t>(circles) + 1, 0);
    std::vector<int> seen = all;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::dvec2 px(x + 0.5, y + 0.5);
            if (!plane.below_horizon(px)) continue;
            circle_of(x, y) = static_cast<int>(std::min<double>(circles, glm::length(plane.from_axis(px)) / unit));
            const auto i = static_cast<std::size_t>(circle_of(x, y));
            ++all[i];
            seen[i] += known(x, y) != 0 ? 1 : 0;
        }
    }
    const auto is_seen = [&](int circle) {
        const auto i = static_cast<std::size_t>(circle);
        return seen[i] >= kSeenShare * all[i];
    };
    std::array<std::vector<std::uint8_t>, 3> codes;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (circle_of(x, y) >= circles || known(x, y) == 0 || !is_seen(circle_of(x, y))) continue;
            codes[0].push_back(still(x, y).r);
            codes[1].push_back(still(x, y).g);
            codes[2].push_back(still(x, y).b);
        }
    }
    Image<std::uint8_t> foot(width, height);
    if (codes[0].empty()) return foot;
    const LinearRgb bare = linear_rgb({median(codes[0]), median(codes[1]), median(codes[2]), 255});
    // What does not look like the bare disc, together with what is swept: what hangs together with that is the foot.
    cv::Mat1b joined(height, width, std::uint8_t{0});
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (swept(x, y) != 0) joined(y, x) = 255;
            if (circle_of(x, y) >= circles || known(x, y) == 0 || is_seen(circle_of(x, y))) continue;
            const Explanation e = explain_by_backdrop(linear_rgb(still(x, y)), bare, 0.25F, 1);
            if (e.plain > kUnlike_delta_e && e.shaded > kUnlike_delta_e) joined(y, x) = 255;
        }
    }
    cv::morphologyEx(joined, joined, cv::MORPH_CLOSE, cv::Mat(), {-1, -1}, 1);
    const ConnectedParts parts(joined, 4);
    const auto swept_px = parts.tallied<int>([&](int x, int y, int& count) { count += swept(x, y) != 0 ? 1 : 0; });
    parts.for_each_pixel([&](int x, int y, int label) {
        if (swept_px[label] > 0 && swept(x, y) == 0) foot(x, y) = 255;
    });
    return foot;
}

void bridge_gaps(const std::optional<TurntableDisc>& disc, Image<Rgba8>& plate, Image<std::uint8_t>& known) {
    RS_CHECK(plate.width() == known.width() && plate.height() == known.height());
    if (!disc) return bridge_rows(plate, known);
    const Image<std::uint8_t> on_disc = disc_mask(*disc, plate.width(), plate.height());
    // Around the disc rows run on as if it were not there.
    Image<Rgba8> around = plate;
    Image<std::uint8_t> known_around = known;
    for (int y = 0; y < known.height(); ++y) {
        for (int x = 0; x < known.width(); ++x) {
            if (on_disc(x, y) != 0) known_around(x, y) = 0;
        }
    }
    bridge_rows(around, known_around);
    bridge_circles(*disc, plate, known);
    for (int y = 0; y < known.height(); ++y) {
        for (int x = 0; x < known.width(); ++x) {
            if (known(x, y) != 0 || on_disc(x, y) != 0 || known_around(x, y) == 0) continue;
            plate(x, y) = around(x, y);
            known(x, y) = 255;
        }
    }
    bridge_rows(plate, known);
}

}  // namespace rs::capture
