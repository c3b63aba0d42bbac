#include "capture/photos/foreground/foreground_mask.hpp"

#include "capture/opencv/connected_components.hpp"
#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/background/log_ratio.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/api/types/check.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace rs::capture {
namespace {

using Enclosed = ForegroundParameters::Enclosed;

cv::Mat3f downscaled_and_smoothed(const cv::Mat3f& light, cv::Size size) {
    cv::Mat3f result;
    cv::resize(light, result, size, 0, 0, cv::INTER_AREA);
    return smoothed_light(result);
}

LinearRgb light_of(const cv::Vec3f& light) {
    return {light[0], light[1], light[2]};
}

// 255 where the score is at least `strong_score`, resampled to `size`.
cv::Mat1b strong_foreground(const LabPhoto& photo, const CleanPlateView& plate,
                            const ForegroundParameters::Score& parameters, cv::Size size) {
    const Image<float> score = foreground_score(photo, plate, parameters);
    cv::Mat1b strong(photo.height(), photo.width()), result;
    for (int y = 0; y < strong.rows; ++y) {
        for (int x = 0; x < strong.cols; ++x) strong(y, x) = score(x, y) >= parameters.strong_score ? 255 : 0;
    }
    cv::resize(strong, result, size, 0, 0, cv::INTER_NEAREST);
    return result;
}

// 255 where the photo and the plate differ by more than `min_delta_e`.
cv::Mat1b differing_pixels(const cv::Mat3f& photo, const cv::Mat3f& plate, float min_delta_e) {
    cv::Mat1b differs(photo.size());
    for (int y = 0; y < differs.rows; ++y) {
        for (int x = 0; x < differs.cols; ++x) {
            const float difference =
                delta_e(lab_from_linear(light_of(photo(y, x))), lab_from_linear(light_of(plate(y, x))));
            differs(y, x) = difference > min_delta_e ? 255 : 0;
        }
    }
    return differs;
}

// Components of the image without edges, by kind; 255 or 0. A component at the image border that mostly differs from
// the plate there is in none of them.
struct EdgeFreeRegions {
    cv::Mat1b reached;   // from the image border
    cv::Mat1b enclosed;  // by edges, and a good part differs from the plate
    cv::Mat1b spots;     // by edges, and small, and like the plate
    cv::Mat1b plain;     // by edges, and larger, and like the plate
};

EdgeFreeRegions classify_regions(const cv::Mat1b& edge_free, const cv::Mat1b& differs, double max_spot_px,
                                 double min_differing) {
    const ConnectedComponents components(edge_free, 4);
    struct Counts {
        int differing = 0, at_border = 0, differing_at_border = 0;  // px
    };
    auto counts = components.accumulate<Counts>(
        [&](int x, int y, Counts& component) { component.differing += differs(y, x) != 0 ? 1 : 0; });
    components.for_each_border_pixel([&](int x, int y, int label) {
        ++counts[label].at_border;
        counts[label].differing_at_border += differs(y, x) != 0 ? 1 : 0;
    });
    const cv::Mat1b none(edge_free.size(), std::uint8_t{0});
    EdgeFreeRegions regions{none.clone(), none.clone(), none.clone(), none.clone()};
    // Most of the border shows the background, even in a photo of another exposure.
    const auto surrounding = std::ranges::max_element(counts, {}, &Counts::at_border);
    PerComponent<cv::Mat1b*> region_of(components.count());
    for (int label = 1; label < components.count(); ++label) {
        const Counts& component = counts[label];
        cv::Mat1b*& region = region_of[label];
        if (component.at_border > 0) {
            const bool is_background =
                &component == &*surrounding || 2 * component.differing_at_border <= component.at_border;
            if (is_background) region = &regions.reached;
        } else if (component.differing >= min_differing * components.area(label)) {
            region = &regions.enclosed;
        } else {
            region = components.area(label) <= max_spot_px ? &regions.spots : &regions.plain;
        }
    }
    components.for_each_pixel([&](int x, int y, int label) {
        if (cv::Mat1b* region = region_of[label]) (*region)(y, x) = 255;
    });
    return regions;
}

// The certain foreground: strong and enclosed pixels, spots, and the narrow gaps between them, such as the gap of a
// door.
cv::Mat1b occluded_region(const EdgeFreeRegions& regions, const cv::Mat1b& strong, const Enclosed& parameters) {
    cv::Mat1b foreground, occluded, background;
    cv::bitwise_or(regions.enclosed, regions.spots, foreground);
    cv::dilate(foreground, foreground, cv::Mat(), {-1, -1}, parameters.edge_dilation_px - 1);
    cv::bitwise_or(foreground, strong, foreground);
    cv::morphologyEx(foreground, occluded, cv::MORPH_CLOSE,
                     cv::getStructuringElement(cv::MORPH_ELLIPSE, {parameters.closing_px, parameters.closing_px}));
    cv::bitwise_or(regions.reached, regions.plain, background);
    cv::dilate(background, background, cv::Mat(), {-1, -1}, parameters.edge_dilation_px + 1);
    occluded.setTo(0, background);
    return occluded;
}

Image<std::uint8_t> resampled(const cv::Mat1b& mask, int width, int height) {
    Image<std::uint8_t> result(width, height);
    cv::Mat1b resized(height, width, result.data());
    cv::resize(mask, resized, resized.size(), 0, 0, cv::INTER_NEAREST);
    return result;
}

}  // namespace

Image<std::uint8_t> segment_by_edges(const LabPhoto& photo, const CleanPlateView& plate,
                                     const ForegroundParameters& parameters) {
    RS_CHECK(photo.width() == plate.background.width() && photo.height() == plate.background.height());
    if (photo.width() == 0 || photo.height() == 0) return {};
    const Enclosed& enclosed = parameters.enclosed;
    const double scale =
        std::min(1.0, static_cast<double>(enclosed.max_side_px) / std::max(photo.width(), photo.height()));
    const cv::Size size(std::max(1, cvRound(photo.width() * scale)), std::max(1, cvRound(photo.height() * scale)));
    const cv::Mat3f light = downscaled_and_smoothed(linear_mat(photo.image), size);
    const cv::Mat3f background = downscaled_and_smoothed(light_mat(plate.background.light), size);
    const cv::Mat1b strong = strong_foreground(photo, plate, parameters.score, size);

    cv::Mat1b edges, edge_free;
    cv::bitwise_or(edges_of_log_ratio(log_ratio(light, background)), strong, edges);
    cv::dilate(edges, edges, cv::Mat(), {-1, -1}, enclosed.edge_dilation_px);
    cv::bitwise_not(edges, edge_free);
    const int strong_px = cv::countNonZero(strong);
    const EdgeFreeRegions regions =
        classify_regions(edge_free, differing_pixels(light, background, parameters.score.background_delta_e),
                         enclosed.max_spot * strong_px, enclosed.min_differing);
    const int enclosed_px = cv::countNonZero(regions.enclosed);
    const bool is_large = enclosed_px > enclosed.min_enclosed * strong_px &&
                          enclosed_px > parameters.cleanup.min_foreground * size.area();
    const int remaining_px = size.area() - strong_px - enclosed_px;
    if (!is_large || cv::countNonZero(regions.reached) < enclosed.min_reached * remaining_px) return {};

    CleanPlateView constrained = plate;
    constrained.occluded = resampled(occluded_region(regions, strong, enclosed), photo.width(), photo.height());
    constrained.visible = resampled(regions.reached, photo.width(), photo.height());
    return segment_foreground(photo, constrained, parameters);
}

}  // namespace rs::capture
