#include "capture/photos/background/shadow_ground.hpp"

#include "capture/opencv/connected_parts.hpp"
#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/background/light_share.hpp"
#include "rayspace/base/check.hpp"
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

constexpr int kWall_px = 4;            // edges are made wider by so much, and so closed where they vanish for eight
constexpr float kShadow_log = -0.1F;   // of the plate's light a tenth is missing
constexpr double kLeastShadow = 0.01;  // px of shadow in a row
constexpr std::size_t kOneIn = 4;      // samples that show it: an outline that vanishes lets single pictures leak
constexpr double kAbove = 0.02;        // of the picture's height: where a shadow fades out

// The label of the part that has most of the picture's border; 0 where none has any.
int part_around(const ConnectedParts& parts) {
    PerPart<int> at_border(parts.count());
    parts.for_each_pixel_at_border([&](int, int, int label) { ++at_border[label]; });
    const auto most = std::ranges::max_element(at_border);
    return most == at_border.end() || *most == 0 ? 0 : static_cast<int>(most - at_border.begin()) + 1;
}

// [y]: whether the row shows a shadow that fades out.
std::vector<bool> rows_with_shadow(const cv::Mat3f& photo, const cv::Mat3f& plate) {
    const cv::Mat1f share = log_light_share(photo, plate);
    cv::Mat1b walls = edges_of_share(share), open;
    cv::dilate(walls, walls, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * kWall_px + 1, 2 * kWall_px + 1}));
    cv::bitwise_not(walls, open);
    const ConnectedParts parts(open, 4);
    const int around = part_around(parts);
    std::vector<bool> rows(static_cast<std::size_t>(share.rows));
    if (around == 0) return rows;
    for (int y = 0; y < share.rows; ++y) {
        int shadow_px = 0;
        for (int x = 0; x < share.cols; ++x) {
            shadow_px += parts.label(x, y) == around && share(y, x) < kShadow_log ? 1 : 0;
        }
        rows[static_cast<std::size_t>(y)] = shadow_px > kLeastShadow * share.cols;
    }
    return rows;
}

}  // namespace

Image<std::uint8_t> above_shadows(const EvenedSamples& samples, ConstImageView<Rgba8> plate) {
    const int width = samples.width(), height = samples.height();
    RS_CHECK(plate.width() == width && plate.height() == height);
    const cv::Mat3f behind = smoothed_light(linear_mat(plate));
    std::vector<std::vector<bool>> shadows(samples.count());
    for_each_index(samples.count(), [&](std::size_t i) {
        Image<Rgba8> sample(width, height);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) sample(x, y) = samples.smooth(i, x, y);
        }
        shadows[i] = rows_with_shadow(smoothed_light(linear_mat(sample)), behind);
    });
    for (int y = 0; y < height; ++y) {
        const auto row = static_cast<std::size_t>(y);
        const auto show_it = std::ranges::count_if(shadows, [&](const std::vector<bool>& rows) { return rows[row]; });
        if (kOneIn * static_cast<std::size_t>(show_it) < samples.count()) continue;
        Image<std::uint8_t> above(width, height);
        const int end = std::max(0, y - static_cast<int>(kAbove * height));
        std::fill_n(above.data(), static_cast<std::ptrdiff_t>(end) * width, std::uint8_t{255});
        return above;
    }
    return {};
}

}  // namespace rs::capture
