#include "capture/photos/foreground/flat_grey_foreground.hpp"

#include "capture/opencv/connected_components.hpp"
#include "rayspace/api/types/check.hpp"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace rs::capture {
namespace {

// Adds `other` to `mask` if the largest component that this adds has at least the share `min_added` of `other`. Smaller
// ones are loops of other objects and patches of shadow. The whole of `other` is added, because highlights, spokes and
// mirrors of such an object have the background's grey, too.
void add_if_large(Image<std::uint8_t>& mask, Image<std::uint8_t> other, double min_added) {
    cv::Mat1b result(mask.height(), mask.width(), mask.data());
    const cv::Mat1b added(other.height(), other.width(), other.data());
    cv::Mat1b missing(added.size(), std::uint8_t{0});
    cv::bitwise_xor(added, result, missing, added);
    const ConnectedComponents components(missing, 4);
    int largest_px = 0;
    for (int label = 1; label < components.count(); ++label) {
        largest_px = std::max(largest_px, components.area(label));
    }
    if (largest_px >= min_added * cv::countNonZero(added)) cv::bitwise_or(result, added, result);
}

std::ptrdiff_t count_differing(const LabPhoto& photo, const CleanPlateView& plate, float min_delta_e) {
    std::ptrdiff_t count = 0;
    for (int y = 0; y < photo.height(); ++y) {
        for (int x = 0; x < photo.width(); ++x) {
            count += delta_e(photo.lab(x, y), plate.background.lab(x, y)) > min_delta_e ? 1 : 0;
        }
    }
    return count;
}

}  // namespace

CleanPlateView make_flat_plate(const CleanPlateView& plate, ConstImageView<std::uint8_t> always_visible,
                               const LinearRgb& grey, float min_delta_e) {
    RS_CHECK(plate.background.width() == always_visible.width() &&
             plate.background.height() == always_visible.height());
    const int width = plate.background.width(), height = plate.background.height();
    Image<LinearRgb> light(width, height, grey);
    CleanPlateView flat;
    flat.noise_delta_e = Image<float>(width, height);
    const Lab grey_lab = lab_from_linear(grey);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (always_visible(x, y) == 0 || delta_e(plate.background.lab(x, y), grey_lab) <= min_delta_e) continue;
            light(x, y) = plate.background.light(x, y);
            if (!plate.noise_delta_e.empty()) flat.noise_delta_e(x, y) = plate.noise_delta_e(x, y);
        }
    }
    flat.background = LinearLabImage(std::move(light));
    return flat;
}

void add_flat_grey_foreground(Image<std::uint8_t>& mask, const LabPhoto& photo, const CleanPlateView& flat,
                              const ForegroundParameters& parameters) {
    RS_CHECK(flat.background.width() == photo.width() && flat.background.height() == photo.height());
    if (mask.empty()) return;
    const ForegroundParameters::Grey& grey = parameters.grey;
    ForegroundParameters sensitive = for_flat_grey(parameters);
    add_if_large(mask, segment_foreground(photo, flat, sensitive), grey.min_added);
    const auto foreground = static_cast<double>(std::ranges::count(mask.pixels(), std::uint8_t{255}));
    const auto differing = static_cast<double>(count_differing(photo, flat, parameters.score.background_delta_e));
    const double min_foreground_px = parameters.cleanup.min_foreground * static_cast<double>(mask.pixels().size());
    if (foreground >= grey.min_explained * differing || differing < min_foreground_px) return;
    sensitive.score.ambiguous_score = grey.last_ambiguous_score;
    sensitive.cleanup.keep_weak_foreground = true;
    add_if_large(mask, segment_foreground(photo, flat, sensitive), grey.min_added);
}

}  // namespace rs::capture
