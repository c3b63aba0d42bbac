#include "capture/photos/cut_out.hpp"

#include "capture/photos/foreground_colour.hpp"
#include "capture/photos/opencv_image.hpp"
#include "capture/photos/soft_edge.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace rs::capture {

ObjectCutter::ObjectCutter(const Backdrop& backdrop, int width, int height)
    : kind_(backdrop.kind), options_(mask_options_for(backdrop)), band_px_(expected_band_px(width, height)) {
    if (kind_ == BackdropKind::kAlpha) return;
    RS_CHECK(!backdrop.plate.empty());
    cv::Mat3f plate;
    cv::resize(linear_mat(backdrop.plate), plate, {width, height}, 0, 0, cv::INTER_LINEAR);
    plate_ = Image<LinearRgb>(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) plate_(x, y) = {plate(y, x)[0], plate(y, x)[1], plate(y, x)[2]};
    }
}

Image<Rgba8> ObjectCutter::cut(ConstImageView<Rgba8> photo) const {
    Image<Rgba8> cut;
    if (kind_ == BackdropKind::kAlpha) {
        cut = Image<Rgba8>(photo.width(), photo.height());
        for (int y = 0; y < photo.height(); ++y) std::copy_n(photo.row(y), photo.width(), cut.row(y));
    } else {
        const Image<std::uint8_t> mask = find_object(photo, plate_, options_);
        cut = unmix(photo, soften_edge(photo, mask, band_px_));
    }
    bleed_colours(cut);
    return cut;
}

}  // namespace rs::capture
