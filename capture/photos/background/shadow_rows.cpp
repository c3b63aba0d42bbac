#include "capture/photos/background/shadow_rows.hpp"

#include "capture/opencv/connected_components.hpp"
#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/background/log_ratio.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/base/parallel_loop.hpp"
#include "rayspace/image/linear_light.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rs::capture {
namespace {

// Label of the part with most pixels at the image border; 0 if no part reaches it.
int part_at_border(const ConnectedComponents& parts) {
    PerComponent<int> border_pixels(parts.count());
    parts.for_each_border_pixel([&](int, int, int label) { ++border_pixels[label]; });
    const auto max = std::ranges::max_element(border_pixels);
    return max == border_pixels.end() || *max == 0 ? 0 : static_cast<int>(max - border_pixels.begin()) + 1;
}

// [y]: whether the row shows a soft shadow.
std::vector<bool> rows_with_soft_shadow(const cv::Mat3f& photo, const cv::Mat3f& plate,
                                        const BackgroundParameters::Shadow& parameters) {
    const cv::Mat1f ratio = log_ratio(photo, plate);
    const int dilation_px = 2 * parameters.edge_dilation_px + 1;
    cv::Mat1b edges = edges_of_log_ratio(ratio, parameters.edge_log_per_px), open;
    cv::dilate(edges, edges, cv::getStructuringElement(cv::MORPH_ELLIPSE, {dilation_px, dilation_px}));
    cv::bitwise_not(edges, open);
    const ConnectedComponents parts(open, 4);
    const int background = part_at_border(parts);
    std::vector<bool> rows(static_cast<std::size_t>(ratio.rows));
    if (background == 0) return rows;
    for (int y = 0; y < ratio.rows; ++y) {
        int shadow_px = 0;
        for (int x = 0; x < ratio.cols; ++x) {
            shadow_px += parts.label(x, y) == background && ratio(y, x) < parameters.max_log_ratio ? 1 : 0;
        }
        rows[static_cast<std::size_t>(y)] = shadow_px > parameters.min_row_share * ratio.cols;
    }
    return rows;
}

}  // namespace

Image<std::uint8_t> shadow_free_rows(const ExposureNormalizedFrames& frames, ConstImageView<Rgba8> plate,
                                     const BackgroundParameters::Shadow& parameters) {
    const int width = frames.width(), height = frames.height();
    RS_CHECK(plate.width() == width && plate.height() == height);
    const cv::Mat3f background = smoothed_light(linear_mat(plate));
    std::vector<std::vector<bool>> has_shadow(frames.count());  // [frame][y]
    for_each_index(frames.count(), [&](std::size_t i) {
        Image<Rgba8> frame(width, height);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) frame(x, y) = frames.smooth(i, x, y);
        }
        has_shadow[i] = rows_with_soft_shadow(smoothed_light(linear_mat(frame)), background, parameters);
    });
    const double min_frames = parameters.min_frame_share * static_cast<double>(frames.count());
    for (int y = 0; y < height; ++y) {
        const auto row = static_cast<std::size_t>(y);
        const auto count = std::ranges::count_if(has_shadow, [&](const std::vector<bool>& rows) { return rows[row]; });
        if (static_cast<double>(count) < min_frames) continue;
        Image<std::uint8_t> shadow_free(width, height);
        const int end = std::max(0, y - static_cast<int>(parameters.fade_share * height));
        std::fill_n(shadow_free.data(), static_cast<std::ptrdiff_t>(end) * width, std::uint8_t{255});
        return shadow_free;
    }
    return {};
}

}  // namespace rs::capture
