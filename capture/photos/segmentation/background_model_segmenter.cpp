#include "capture/photos/segmentation/background_model_segmenter.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/background/log_ratio.hpp"
#include "capture/photos/foreground/flat_grey_foreground.hpp"
#include "capture/photos/intake/exposure.hpp"
#include "capture/photos/intake/survey.hpp"
#include "rayspace/api/types/check.hpp"

#include <opencv2/imgproc.hpp>

#include <utility>

namespace rs::capture {
namespace {

// Resampled to the nearest pixel.
template <class T>
Image<T> scaled(const Image<T>& image, int width, int height) {
    if (image.empty()) return {};
    Image<T> result(width, height);
    for (int y = 0; y < height; ++y) {
        const auto v = static_cast<int>(static_cast<std::int64_t>(y) * image.height() / height);
        for (int x = 0; x < width; ++x) {
            result(x, y) = image(static_cast<int>(static_cast<std::int64_t>(x) * image.width() / width), v);
        }
    }
    return result;
}

Image<LinearRgb> image_of(const cv::Mat3f& light) {
    Image<LinearRgb> result(light.cols, light.rows);
    for (int y = 0; y < light.rows; ++y) {
        for (int x = 0; x < light.cols; ++x) result(x, y) = {light(y, x)[0], light(y, x)[1], light(y, x)[2]};
    }
    return result;
}

}  // namespace

BackgroundModelSegmenter::BackgroundModelSegmenter(const BackgroundModel& model, int width, int height,
                                                   const ForegroundParameters& parameters)
    : general_(parameters),
      parameters_(parameters_for(model, parameters)),
      flat_grey_(model.flat_grey),
      has_gradient_(!model.gradient.empty()) {
    RS_CHECK(!model.plate.empty());
    cv::Mat3f plate;
    cv::resize(has_gradient_ ? light_mat(model.gradient) : linear_mat(model.plate), plate, {width, height}, 0, 0,
               cv::INTER_LINEAR);
    plate_.background = LinearLabImage(image_of(plate));
    for (const Rgba8& colour : model.key_colours) plate_.screen_colours.push_back(linear_rgb(colour));
    plate_.noise_delta_e = scaled(model.noise_delta_e, width, height);
    plate_.disc = scaled(model.ground, width, height);
    plate_.above_shadows = scaled(model.shadow_free, width, height);
    plate_.occluded = scaled(model.always_covered, width, height);
    always_visible_ = scaled(model.always_visible, width, height);
    if (flat_grey_) {
        flat_plate_ =
            make_flat_plate(plate_, always_visible_, linear_rgb(*flat_grey_), general_.score.background_delta_e);
    }
}

std::optional<CleanPlateView> BackgroundModelSegmenter::exposed_like(ConstImageView<Rgba8> photo) const {
    if (always_visible_.empty()) return std::nullopt;
    const LinearRgb gain = exposure_gain(photo, plate_.background.light, always_visible_);
    if (gain.r == 1 && gain.g == 1 && gain.b == 1) return std::nullopt;
    Image<LinearRgb> light = plate_.background.light;
    for (LinearRgb& p : light.pixels()) p = {p.r * gain.r, p.g * gain.g, p.b * gain.b};
    CleanPlateView exposed = plate_;
    exposed.background = LinearLabImage(std::move(light));
    return exposed;
}

Image<LinearRgb> BackgroundModelSegmenter::background_of(ConstImageView<Rgba8> photo) const {
    std::optional<CleanPlateView> exposed = exposed_like(photo);
    if (exposed) return std::move(exposed->background.light);
    return plate_.background.light;
}

Image<std::uint8_t> BackgroundModelSegmenter::mask_of(ConstImageView<Rgba8> photo) const {
    const bool is_flat = flat_grey_ && within_codes(measure_border(photo).median, *flat_grey_, kFlat_codes);
    const LabPhoto lab(photo);
    const std::optional<CleanPlateView> exposed = exposed_like(photo);
    const CleanPlateView& plate = exposed ? *exposed : plate_;
    Image<std::uint8_t> mask;
    if (!is_flat && has_gradient_) mask = segment_by_edges(lab, plate, parameters_);
    if (mask.empty()) mask = segment_foreground(lab, plate, parameters_);
    if (is_flat) add_flat_grey_foreground(mask, lab, flat_plate_, general_);
    return mask;
}

Result<Segmentation> BackgroundModelSegmenter::segment(const TurnPhoto& photo) const {
    return Segmentation{mask_of(photo.image), false};
}

}  // namespace rs::capture
