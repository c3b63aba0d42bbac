#include "encode/raymap/silhouettes/lost_parts.hpp"

#include "encode/set/soft_coverage.hpp"
#include "rayspace/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

namespace rs::encode {
namespace {

constexpr int kDense_px = 2;     // radius of the square in which half of the background must be missing
constexpr int kClosed_px = 3;    // half of the widest gap to close
constexpr int kStraight_px = 4;  // radius of the majority filter that smooths contours
constexpr int kStraightenings = 4;
constexpr int kHalfSide_px = 5;  // half side of the smallest part
constexpr double kMost = 0.7;    // share of a part that must not be occluded for all of it to be painted
constexpr int kSmooth_px = 5;    // radius of the median filter of depths

bool is_object(const WorkView& view, int column, int row) {
    return view.at(column, row).a >= kInside;
}

bool is_lost(const Image<float>& part, int column, int row) {
    return !std::isnan(part(row, column));
}

template <class Each>
void for_each_pixel(const WorkView& view, const Each& each) {
    for (int column = 0; column < view.width; ++column) {
        for (int row = 0; row < view.height; ++row) each(column, row);
    }
}

// Median filter of the depths at the pixels of `mask`; kNoDepth elsewhere.
Image<float> median_filter(const WorkView& view, const Image<float>& depths, const Image<std::uint8_t>& mask) {
    Image<float> smooth(depths.width(), depths.height(), kNoDepth);
    std::vector<float> near;
    for_each_pixel(view, [&](int column, int row) {
        if (mask(row, column) == 0) return;
        for (int radius = kSmooth_px; radius <= 2 * kSmooth_px && near.empty(); ++radius) {
            for_each_around(view, column, row, radius, [&](int c, int r) {
                if (is_lost(depths, c, r)) near.push_back(depths(r, c));
            });
        }
        if (near.empty()) return;
        smooth(row, column) = median_of(std::span(near));
        near.clear();
    });
    return smooth;
}

// The connected components of a mask that contain a pixel of `middles` and have at least half of their border at the
// object.
Image<std::uint8_t> beside_object(const WorkView& view, const Image<std::uint8_t>& mask,
                                  const Image<std::uint8_t>& middles) {
    Image<std::uint8_t> left = mask, kept(mask.width(), mask.height(), 0);
    std::vector<glm::ivec2> pixels;
    for_each_pixel(view, [&](int column, int row) {
        if (left(row, column) == 0) return;
        int border = 0, at_object = 0;
        bool has_middle = false;
        left(row, column) = 0;
        pixels.assign(1, {column, row});
        for (std::size_t n = 0; n < pixels.size(); ++n) {
            has_middle = has_middle || middles(pixels[n].y, pixels[n].x) != 0;
            for (const glm::ivec2& step : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
                const glm::ivec2 at = pixels[n] + step;
                const bool in_frame = at.x >= 0 && at.y >= 0 && at.x < view.width && at.y < view.height;
                if (!in_frame || mask(at.y, at.x) == 0) {
                    ++border;
                    at_object += in_frame && is_object(view, at.x, at.y) ? 1 : 0;
                } else if (left(at.y, at.x) != 0) {
                    left(at.y, at.x) = 0;
                    pixels.push_back(at);
                }
            }
        }
        if (!has_middle || 2 * at_object < border) return;
        for (const glm::ivec2& at : pixels) kept(at.y, at.x) = 1;
    });
    return kept;
}

// Smooths a contour with a majority filter.
Image<std::uint8_t> smooth_contour(const WorkView& view, Image<std::uint8_t> mask) {
    for (int round = 0; round < kStraightenings; ++round) {
        const Image<std::uint8_t> near = dilated(mask, 1);
        Image<std::uint8_t> straight(mask.width(), mask.height(), 0);
        for_each_pixel(view, [&](int column, int row) {
            if (near(row, column) == 0 || is_object(view, column, row)) return;
            int all = 0, there = 0;
            for_each_around(view, column, row, kStraight_px, [&](int c, int r) {
                ++all;
                there += mask(r, c) != 0 || is_object(view, c, r) ? 1 : 0;
            });
            straight(row, column) = 2 * there > all ? 1 : 0;
        });
        mask = std::move(straight);
    }
    return mask;
}

// Blends two colours by coverage.
std::uint8_t blend_by_coverage(std::uint8_t own, double other, double share_of_own) {
    return static_cast<std::uint8_t>(std::lround(own * share_of_own + other * (1 - share_of_own)));
}

// Bilinear interpolation; nullopt where one of the four pixels is not opaque.
std::optional<glm::dvec3> colour_at(const Image<Rgba8>& image, double x, double y) {
    const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
    if (!(left >= 0 && top >= 0 && left + 1 < image.width() && top + 1 < image.height())) return std::nullopt;
    glm::dvec3 sum(0);
    for (int corner = 0; corner < 4; ++corner) {
        const int dx = corner % 2, dy = corner / 2;
        const Rgba8& pixel = image(static_cast<int>(left) + dx, static_cast<int>(top) + dy);
        if (pixel.a < kOpaque) return std::nullopt;
        const double right = x - 0.5 - left, down = y - 0.5 - top;
        sum += glm::dvec3(pixel.r, pixel.g, pixel.b) * ((dx == 1 ? right : 1 - right) * (dy == 1 ? down : 1 - down));
    }
    return sum;
}

}  // namespace

Image<float> select_lost_part(const WorkView& view, const Image<float>& missing) {
    // A part needs at least half of a dense square of missing pixels.
    constexpr int kFewest = (2 * kHalfSide_px + 1) * (2 * kHalfSide_px + 1) / 4;
    if (count_depths(missing) < kFewest) {
        return Image<float>(missing.width(), missing.height(), kNoDepth);
    }
    const auto mask_of = [&](const auto& belongs) {
        Image<std::uint8_t> mask(missing.width(), missing.height(), 0);
        for_each_pixel(view, [&](int column, int row) { mask(row, column) = belongs(column, row) ? 1 : 0; });
        return mask;
    };
    const auto dense = mask_of([&](int column, int row) {
        int beside = 0, gone = 0;
        for_each_around(view, column, row, kDense_px, [&](int c, int r) {
            beside += is_object(view, c, r) ? 0 : 1;
            gone += is_lost(missing, c, r) ? 1 : 0;
        });
        return !is_object(view, column, row) && 2 * gone >= beside;
    });
    // Close gaps inside the part and between it and the object.
    const auto wide =
        dilated(mask_of([&](int c, int r) { return dense(r, c) != 0 || is_object(view, c, r); }), kClosed_px);
    const auto outside = dilated(mask_of([&](int c, int r) { return wide(r, c) == 0; }), kClosed_px);
    const auto near = dilated(dense, kClosed_px);
    const auto lost =
        mask_of([&](int c, int r) { return !is_object(view, c, r) && outside(r, c) == 0 && near(r, c) != 0; });
    // Centres of squares whose pixels are missing (at least half of them) or object.
    const auto middles = mask_of([&](int column, int row) {
        int all = 0, object = 0, gone = 0;
        for_each_around(view, column, row, kHalfSide_px, [&](int c, int r) {
            ++all;
            gone += lost(r, c);
            object += is_object(view, c, r) ? 1 : 0;
        });
        return lost(row, column) != 0 && gone + object == all && 2 * gone >= all;
    });
    const auto large = dilated(middles, 2 * kHalfSide_px);
    const auto part = mask_of([&](int c, int r) { return large(r, c) != 0 && lost(r, c) != 0; });
    return median_filter(view, missing, smooth_contour(view, beside_object(view, part, middles)));
}

double share_of(const Image<float>& part, const WorkView& view) {
    const std::ptrdiff_t lost = count_depths(part);
    if (lost == 0) return 0;
    const std::ptrdiff_t object =
        std::ranges::count_if(view.columns.pixels(), [](const Rgba8& pixel) { return pixel.a >= kInside; });
    return static_cast<double>(lost) / static_cast<double>(std::max(object, std::ptrdiff_t{1}));
}

LostPartPainter::LostPartPainter(const WorkView& view, const Image<float>& part, int scale, Image<Rgba8> image)
    : image_(std::move(image)), scale_(scale) {
    for (int y = 0; y < image_.height(); ++y) {
        for (int x = 0; x < image_.width(); ++x) {
            if (image_(x, y).a == 255) continue;
            // Bilinear interpolation of the coverage by object and part, and of the part's depth.
            const double column = (x + 0.5) / scale, row = (y + 0.5) / scale;
            const int left = static_cast<int>(std::floor(column - 0.5)), top = static_cast<int>(std::floor(row - 0.5));
            double there = 0, lost = 0, depth = 0;
            for (int corner = 0; corner < 4; ++corner) {
                const int c = left + corner % 2, r = top + corner / 2;
                if (c < 0 || r < 0 || c >= view.width || r >= view.height) continue;
                const double weight = (1 - std::abs(column - 0.5 - c)) * (1 - std::abs(row - 0.5 - r));
                if (is_lost(part, c, r)) {
                    lost += weight;
                    depth += weight * static_cast<double>(part(r, c));
                }
                if (is_lost(part, c, r) || is_object(view, c, r)) there += weight;
            }
            // The part's border as a soft edge.
            const double cover = std::clamp(2 * there - 0.5, 0.0, 1.0);
            if (!(lost > 0) || cover * 255 <= image_(x, y).a) continue;
            const HorizontalRay ray = view.ray_of(column);
            depth /= lost;
            left_.push_back({x, y, cover, ray.place_at(depth), view.height_of(row, ray.axial_at(depth))});
        }
    }
    all_ = left_.size();
}

std::optional<glm::dvec3> LostPartPainter::seen_by(const Painter& from, const PaintPixel& spot, bool hidden) const {
    const WorkView& view = from.seen->view;
    const std::optional<ProjectedPoint> at = view.see(spot.place, spot.height);
    if (!at) return std::nullopt;
    if (!hidden) {
        const double depth = view.ray_of(at->whole_column() + 0.5).depth_of(spot.place);
        const auto shown = static_cast<double>(from.seen->depth(at->whole_row(), at->whole_column()));
        if (!(depth - shown < kClearlyInFront)) return std::nullopt;  // occluded, or no depth
    }
    return colour_at(*from.image, at->column * scale_, at->row * scale_);
}

std::size_t LostPartPainter::shown_by(const Painter& from, bool hidden) const {
    return static_cast<std::size_t>(
        std::ranges::count_if(left_, [&](const PaintPixel& spot) { return seen_by(from, spot, hidden).has_value(); }));
}

void LostPartPainter::paint_from(const Painter& from) {
    const bool most = static_cast<double>(shown_by(from, false)) >= kMost * static_cast<double>(shown_by(from, true));
    std::erase_if(left_, [&](const PaintPixel& spot) {
        const auto colour = seen_by(from, spot, most);
        if (!colour) return false;
        Rgba8& pixel = image_(spot.x, spot.y);
        const double share = pixel.a / (255 * spot.cover);
        pixel = {blend_by_coverage(pixel.r, colour->r, share), blend_by_coverage(pixel.g, colour->g, share),
                 blend_by_coverage(pixel.b, colour->b, share),
                 static_cast<std::uint8_t>(std::lround(255 * spot.cover))};
        return true;
    });
}

}  // namespace rs::encode
