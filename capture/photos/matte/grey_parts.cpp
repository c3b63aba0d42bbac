#include "capture/photos/matte/grey_parts.hpp"

#include "capture/opencv/connected_parts.hpp"
#include "rayspace/base/check.hpp"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace rs::capture {
namespace {

constexpr float kVisible_delta_e = 2.5F;

// Adds `whole` to `mask` where that adds a part that is large beside it: such an object is as grey as its
// backdrop, and its highlights, spokes and mirrors are, too.
void add_if_large(Image<std::uint8_t>& mask, Image<std::uint8_t> whole) {
    constexpr double kLarge = 0.02;  // loops of other objects, and patches of shadow, are smaller
    cv::Mat1b found(mask.height(), mask.width(), mask.data());
    const cv::Mat1b all(whole.height(), whole.width(), whole.data());
    cv::Mat1b lacks(all.size(), std::uint8_t{0});
    cv::bitwise_xor(all, found, lacks, all);
    const ConnectedParts parts(lacks, 4);
    int largest_px = 0;
    for (int label = 1; label < parts.count(); ++label) largest_px = std::max(largest_px, parts.area(label));
    if (largest_px >= kLarge * cv::countNonZero(all)) cv::bitwise_or(found, all, found);
}

// How many pixels look different from what is behind the object.
std::ptrdiff_t differing(const SeenPhoto& photo, const CleanPlateView& plate) {
    std::ptrdiff_t count = 0;
    for (int y = 0; y < photo.height(); ++y) {
        for (int x = 0; x < photo.width(); ++x) {
            count += delta_e(photo.looks(x, y), plate.behind.looks(x, y)) > kVisible_delta_e ? 1 : 0;
        }
    }
    return count;
}

}  // namespace

CleanPlateView flat_plate(const CleanPlateView& plate, ConstImageView<std::uint8_t> untouched, const LinearRgb& grey) {
    RS_CHECK(plate.behind.width() == untouched.width() && plate.behind.height() == untouched.height());
    const int width = plate.behind.width(), height = plate.behind.height();
    Image<LinearRgb> light(width, height, grey);
    CleanPlateView flat;
    flat.noise_delta_e = Image<float>(width, height);
    const Lab look = lab_from_linear(grey);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (untouched(x, y) == 0 || delta_e(plate.behind.looks(x, y), look) <= kVisible_delta_e) continue;
            light(x, y) = plate.behind.light(x, y);
            if (!plate.noise_delta_e.empty()) flat.noise_delta_e(x, y) = plate.noise_delta_e(x, y);
        }
    }
    flat.behind = SeenLight(std::move(light));
    return flat;
}

void add_grey_parts(Image<std::uint8_t>& mask, const SeenPhoto& photo, const CleanPlateView& flat) {
    constexpr double kHardlyAny = 0.2;  // of what differs: the rest cannot all be shadow
    constexpr double kDust = 0.002;     // of the picture
    RS_CHECK(flat.behind.width() == photo.width() && flat.behind.height() == photo.height());
    if (mask.empty()) return;
    MaskOptions options = mask_options_for_flat_grey();
    add_if_large(mask, find_object(photo, flat, options));
    const auto solid = static_cast<double>(std::ranges::count(mask.pixels(), std::uint8_t{255}));
    const auto differs = static_cast<double>(differing(photo, flat));
    if (solid >= kHardlyAny * differs || differs < kDust * static_cast<double>(mask.pixels().size())) return;
    options.shadow_or_grey = 0.5F;
    options.may_be_faint = true;
    add_if_large(mask, find_object(photo, flat, options));
}

}  // namespace rs::capture
