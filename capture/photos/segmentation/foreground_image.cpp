#include "capture/photos/segmentation/foreground_image.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/foreground/alpha_estimation.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kHalfCovered = 128;  // alpha code

// Weight of the unmixed colour: 0 up to the first alpha, 1 from the second on, linear between.
constexpr float kUnmixMinAlpha = 0.1F;
constexpr float kUnmixFullAlpha = 0.6F;

// Composites the foreground image over a black layer of the given opacity, straight alpha.
void composite_over_shadow(Image<Rgba8>& foreground, const Image<std::uint8_t>& shadow) {
    RS_CHECK(foreground.width() == shadow.width() && foreground.height() == shadow.height());
    for (int y = 0; y < foreground.height(); ++y) {
        for (int x = 0; x < foreground.width(); ++x) {
            Rgba8& pixel = foreground(x, y);
            const float own = pixel.a / 255.0F;
            const float opacity = own + (1 - own) * shadow(x, y) / 255.0F;
            if (opacity <= own) continue;
            const float kept = own / opacity;  // black adds no light
            const auto darkened = [&](std::uint8_t code) { return srgb8_from_linear(kept * linear_from_srgb8(code)); };
            pixel = {darkened(pixel.r), darkened(pixel.g), darkened(pixel.b),
                     static_cast<std::uint8_t>(std::lround(255 * opacity))};
        }
    }
}

}  // namespace

Image<Rgba8> unmix(ConstImageView<Rgba8> photo, const AlphaEstimate& edge) {
    RS_CHECK(photo.width() == edge.alpha.width() && photo.height() == edge.alpha.height());
    Image<Rgba8> cut(photo.width(), photo.height());
    for (int y = 0; y < photo.height(); ++y) {
        for (int x = 0; x < photo.width(); ++x) {
            const float alpha = edge.alpha(x, y);
            const auto alpha_code = static_cast<std::uint8_t>(std::lround(alpha * 255));
            const Rgba8& pixel = photo(x, y);
            if (alpha_code == 255) {
                cut(x, y) = {pixel.r, pixel.g, pixel.b, 255};
            } else if (alpha_code > 0) {
                const LinearRgb& f = edge.foreground(x, y);
                const LinearRgb& b = edge.background(x, y);
                const float weight =
                    std::clamp((alpha - kUnmixMinAlpha) / (kUnmixFullAlpha - kUnmixMinAlpha), 0.0F, 1.0F);
                const auto colour = [&](std::uint8_t code, float nearby, float background) {
                    const float unmixed =
                        std::clamp((linear_from_srgb8(code) - (1 - alpha) * background) / alpha, 0.0F, 1.0F);
                    return nearby + weight * (unmixed - nearby);
                };
                cut(x, y) = rgba8_from_linear(
                    {colour(pixel.r, f.r, b.r), colour(pixel.g, f.g, b.g), colour(pixel.b, f.b, b.b)}, alpha_code);
            }
        }
    }
    return cut;
}

void bleed_colours(Image<Rgba8>& image) {
    if (image.empty()) return;
    cv::Mat1b covered(image.height(), image.width());
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) covered(y, x) = image(x, y).a >= kHalfCovered ? 255 : 0;
    }
    const cv::Rect near = padded_bounding_box(covered, static_cast<int>(kBleed_px) + 1);
    cv::Mat1b uncovered;
    cv::Mat1f distance;
    cv::Mat1i nearest;
    if (!near.empty()) {
        cv::bitwise_not(covered(near), uncovered);
        cv::distanceTransform(uncovered, distance, nearest, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
    }
    std::vector<Rgba8> colour_of(1);  // label 0 is unused
    for (int y = 0; y < near.height; ++y) {
        for (int x = 0; x < near.width; ++x) {
            if (uncovered(y, x) != 0) continue;
            const auto label = static_cast<std::size_t>(nearest(y, x));
            if (label >= colour_of.size()) colour_of.resize(label + 1);
            colour_of[label] = image(near.x + x, near.y + y);
        }
    }
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            Rgba8& pixel = image(x, y);
            if (pixel.a != 0) continue;
            pixel = {};
            const int u = x - near.x, v = y - near.y;
            if (u < 0 || v < 0 || u >= near.width || v >= near.height || distance(v, u) > kBleed_px) continue;
            const auto label = static_cast<std::size_t>(nearest(v, u));
            if (label >= colour_of.size()) continue;
            pixel = colour_of[label];
            pixel.a = 0;
        }
    }
}

Image<Rgba8> make_foreground_image(ConstImageView<Rgba8> photo, const Segmentation& segmentation,
                                   const ForegroundParameters& parameters) {
    const Image<std::uint8_t>& mask = segmentation.mask;
    RS_CHECK(photo.width() == mask.width() && photo.height() == mask.height());
    Image<Rgba8> foreground;
    if (segmentation.is_alpha) {
        foreground = Image<Rgba8>(photo.width(), photo.height());
        for (int y = 0; y < photo.height(); ++y) {
            for (int x = 0; x < photo.width(); ++x) {
                const Rgba8& p = photo(x, y);
                foreground(x, y) = {p.r, p.g, p.b, mask(x, y)};
            }
        }
    } else {
        const int edge_width_px = expected_edge_width_px(photo.width(), photo.height(), parameters.alpha);
        foreground = unmix(photo, estimate_alpha(photo, mask, edge_width_px, parameters.alpha));
    }
    if (!segmentation.shadow.empty()) composite_over_shadow(foreground, segmentation.shadow);
    bleed_colours(foreground);
    return foreground;
}

}  // namespace rs::capture
