#include "capture/photos/matte/cut_out.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/background/light_share.hpp"
#include "capture/photos/intake/exposure.hpp"
#include "capture/photos/intake/survey.hpp"
#include "capture/photos/matte/enclosed_parts.hpp"
#include "capture/photos/matte/grey_parts.hpp"
#include "capture/photos/matte/soft_edge.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kHalfCovered = 128;

// The unmixed colour counts from this alpha on, and counts alone from that.
constexpr float kUnmixFrom = 0.1F;
constexpr float kUnmixAlone = 0.6F;

}  // namespace

Image<Rgba8> unmix(ConstImageView<Rgba8> photo, const SoftEdge& edge) {
    RS_CHECK(photo.width() == edge.alpha.width() && photo.height() == edge.alpha.height());
    Image<Rgba8> cut(photo.width(), photo.height());
    for (int y = 0; y < photo.height(); ++y) {
        for (int x = 0; x < photo.width(); ++x) {
            const float alpha = edge.alpha(x, y);
            const auto alpha_code = static_cast<std::uint8_t>(std::lround(alpha * 255));
            const Rgba8& seen = photo(x, y);
            if (alpha_code == 255) {
                cut(x, y) = {seen.r, seen.g, seen.b, 255};
            } else if (alpha_code > 0) {
                const LinearRgb& f = edge.object(x, y);
                const LinearRgb& b = edge.backdrop(x, y);
                const float trust = std::clamp((alpha - kUnmixFrom) / (kUnmixAlone - kUnmixFrom), 0.0F, 1.0F);
                const auto colour = [&](std::uint8_t code, float near_by, float behind) {
                    const float unmixed =
                        std::clamp((linear_from_srgb8(code) - (1 - alpha) * behind) / alpha, 0.0F, 1.0F);
                    return near_by + trust * (unmixed - near_by);
                };
                cut(x, y) = rgba8_from_linear(
                    {colour(seen.r, f.r, b.r), colour(seen.g, f.g, b.g), colour(seen.b, f.b, b.b)}, alpha_code);
            }
        }
    }
    return cut;
}

void bleed_colours(Image<Rgba8>& picture) {
    if (picture.empty()) return;
    cv::Mat1b covered(picture.height(), picture.width());
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) covered(y, x) = picture(x, y).a >= kHalfCovered ? 255 : 0;
    }
    // Only so far around what is covered colours are looked for.
    const cv::Rect near = box_around(covered, static_cast<int>(kBleed_px) + 1);
    cv::Mat1b bare;
    cv::Mat1f distance;
    cv::Mat1i nearest;
    if (!near.empty()) {
        cv::bitwise_not(covered(near), bare);
        cv::distanceTransform(bare, distance, nearest, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
    }
    std::vector<Rgba8> colour_of(1);  // label 0 is never given
    for (int y = 0; y < near.height; ++y) {
        for (int x = 0; x < near.width; ++x) {
            if (bare(y, x) != 0) continue;
            const auto label = static_cast<std::size_t>(nearest(y, x));
            if (label >= colour_of.size()) colour_of.resize(label + 1);
            colour_of[label] = picture(near.x + x, near.y + y);
        }
    }
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            Rgba8& pixel = picture(x, y);
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

namespace {

// What stands at the nearest pixel of a picture of the plate's size.
template <class T>
Image<T> scaled(const Image<T>& mask, int width, int height) {
    if (mask.empty()) return {};
    Image<T> result(width, height);
    for (int y = 0; y < height; ++y) {
        const auto v = static_cast<int>(static_cast<std::int64_t>(y) * mask.height() / height);
        for (int x = 0; x < width; ++x) {
            result(x, y) = mask(static_cast<int>(static_cast<std::int64_t>(x) * mask.width() / width), v);
        }
    }
    return result;
}

}  // namespace

ObjectCutter::ObjectCutter(const Backdrop& backdrop, int width, int height)
    : kind_(backdrop.kind),
      options_(mask_options_for(backdrop)),
      flat_grey_(backdrop.flat_grey),
      is_even_(!backdrop.even.empty()),
      band_px_(expected_band_px(width, height)) {
    if (kind_ == BackdropKind::kAlpha) return;
    RS_CHECK(!backdrop.plate.empty());
    cv::Mat3f plate;
    cv::resize(is_even_ ? light_mat(backdrop.even) : linear_mat(backdrop.plate), plate, {width, height}, 0, 0,
               cv::INTER_LINEAR);
    Image<LinearRgb> light(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) light(x, y) = {plate(y, x)[0], plate(y, x)[1], plate(y, x)[2]};
    }
    plate_.behind = SeenLight(std::move(light));
    for (const Rgba8& colour : backdrop.screen) plate_.screen.push_back(linear_rgb(colour));
    plate_.noise_delta_e = scaled(backdrop.noise_delta_e, width, height);
    plate_.ground = scaled(backdrop.ground, width, height);
    plate_.above = scaled(backdrop.above_shadows, width, height);
    plate_.hidden = scaled(backdrop.hidden, width, height);
    plate_.still = scaled(backdrop.still, width, height);
    untouched_ = scaled(backdrop.untouched, width, height);
    if (flat_grey_) flat_plate_ = flat_plate(plate_, untouched_, linear_rgb(*flat_grey_));
}

std::optional<CleanPlateView> ObjectCutter::exposed_as(ConstImageView<Rgba8> photo) const {
    if (untouched_.empty()) return std::nullopt;
    const LinearRgb gain = exposure_gain(photo, plate_.behind.light, untouched_);
    if (gain.r == 1 && gain.g == 1 && gain.b == 1) return std::nullopt;
    Image<LinearRgb> light = plate_.behind.light;
    for (LinearRgb& p : light.pixels()) p = {p.r * gain.r, p.g * gain.g, p.b * gain.b};
    CleanPlateView exposed = plate_;
    exposed.behind = SeenLight(std::move(light));
    return exposed;
}

Image<std::uint8_t> ObjectCutter::mask_of(ConstImageView<Rgba8> photo) const {
    const bool flat = flat_grey_ && within_codes(border_of(photo).median, *flat_grey_, kFlat_codes);
    const SeenPhoto seen(photo);
    const std::optional<CleanPlateView> exposed = exposed_as(photo);
    const CleanPlateView& plate = exposed ? *exposed : plate_;
    Image<std::uint8_t> mask;
    if (!flat && is_even_) mask = find_object_by_edges(seen, plate, options_);
    if (mask.empty()) mask = find_object(seen, plate, options_);
    if (flat) add_grey_parts(mask, seen, flat_plate_);
    return mask;
}

Image<Rgba8> ObjectCutter::cut(ConstImageView<Rgba8> photo) const {
    Image<Rgba8> cut;
    if (kind_ == BackdropKind::kAlpha) {
        cut = Image<Rgba8>(photo.width(), photo.height());
        for (int y = 0; y < photo.height(); ++y) std::copy_n(photo.row(y), photo.width(), cut.row(y));
    } else {
        cut = unmix(photo, soften_edge(photo, mask_of(photo), band_px_));
    }
    bleed_colours(cut);
    return cut;
}

}  // namespace rs::capture
