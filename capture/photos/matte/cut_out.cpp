#include "capture/photos/matte/cut_out.hpp"

#include "capture/photos/intake/exposure.hpp"
#include "capture/photos/intake/opencv_image.hpp"
#include "capture/photos/matte/foreground_colour.hpp"
#include "capture/photos/matte/soft_edge.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace rs::capture {
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
    : kind_(backdrop.kind), options_(mask_options_for(backdrop)), band_px_(expected_band_px(width, height)) {
    if (kind_ == BackdropKind::kAlpha) return;
    RS_CHECK(!backdrop.plate.empty());
    cv::Mat3f plate;
    cv::resize(linear_mat(backdrop.plate), plate, {width, height}, 0, 0, cv::INTER_LINEAR);
    plate_.light = Image<LinearRgb>(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) plate_.light(x, y) = {plate(y, x)[0], plate(y, x)[1], plate(y, x)[2]};
    }
    for (const Rgba8& colour : backdrop.screen) plate_.screen.push_back(linear_rgb(colour));
    plate_.noise_delta_e = scaled(backdrop.noise_delta_e, width, height);
    plate_.ground = scaled(backdrop.ground, width, height);
    plate_.hidden = scaled(backdrop.hidden, width, height);
    untouched_ = scaled(backdrop.untouched, width, height);
}

PlateView ObjectCutter::exposed_as(ConstImageView<Rgba8> photo) const {
    PlateView plate = plate_;
    if (untouched_.empty()) return plate;
    const LinearRgb gain = exposure_gain(photo, plate_.light, untouched_);
    for (LinearRgb& p : plate.light.pixels()) {
        p = {std::min(1.0F, p.r * gain.r), std::min(1.0F, p.g * gain.g), std::min(1.0F, p.b * gain.b)};
    }
    return plate;
}

Image<Rgba8> ObjectCutter::cut(ConstImageView<Rgba8> photo) const {
    Image<Rgba8> cut;
    if (kind_ == BackdropKind::kAlpha) {
        cut = Image<Rgba8>(photo.width(), photo.height());
        for (int y = 0; y < photo.height(); ++y) std::copy_n(photo.row(y), photo.width(), cut.row(y));
    } else {
        const PlateView plate = exposed_as(photo);
        const Image<std::uint8_t> mask = find_object(photo, plate, options_);
        cut = unmix(photo, soften_edge(photo, mask, band_px_));
    }
    bleed_colours(cut);
    return cut;
}

}  // namespace rs::capture
