#include "capture/photos/background/background_estimate.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

namespace rs::capture {
namespace {

// Values of one pixel in all frames; one array per channel, so that comparisons vectorise.
class PixelOverTime {
public:
    PixelOverTime(std::size_t frames, int tolerance_codes)
        : tolerance_codes_(static_cast<std::uint8_t>(std::clamp(tolerance_codes, 0, 255))),
          r_(frames),
          g_(frames),
          b_(frames),
          agrees_(frames) {}
    void set(std::size_t frame, const Rgba8& value) {
        r_[frame] = value.r;
        g_[frame] = value.g;
        b_[frame] = value.b;
    }
    [[nodiscard]] std::size_t frames() const { return r_.size(); }

    struct Group {
        Rgba8 mean;
        std::size_t size = 0;
    };
    // The largest group of frames that agree with one of them; the first of equally large ones.
    Group largest_group() {
        std::size_t best = 0;
        std::size_t best_size = 0;
        for (std::size_t i = 0; i < frames(); ++i) {
            const std::size_t size = compare_with(i);
            if (size > best_size) {
                best_size = size;
                best = i;
            }
            if (size == frames()) break;  // a static pixel, the most frequent case
        }
        compare_with(best);
        const auto mean = [&](const std::vector<std::uint8_t>& codes) {
            std::size_t sum = 0;
            for (std::size_t i = 0; i < codes.size(); ++i) sum += agrees_[i] != 0 ? codes[i] : 0U;
            return static_cast<std::uint8_t>((sum + best_size / 2) / best_size);
        };
        return {{mean(r_), mean(g_), mean(b_), 255}, best_size};
    }

private:
    static std::uint8_t difference(std::uint8_t a, std::uint8_t b) {
        return static_cast<std::uint8_t>(std::max(a, b) - std::min(a, b));
    }
    // Sets agrees_ to the frames that are within the tolerance of frame i, as within_codes() defines it; returns their
    // number.
    std::size_t compare_with(std::size_t i) {
        const std::uint8_t r = r_[i], g = g_[i], b = b_[i];
        const std::uint8_t tolerance = tolerance_codes_;
        for (std::size_t k = 0; k < frames(); ++k) {
            const std::uint8_t max = std::max({difference(r, r_[k]), difference(g, g_[k]), difference(b, b_[k])});
            agrees_[k] = max <= tolerance ? 1 : 0;
        }
        return std::accumulate(agrees_.begin(), agrees_.end(), std::size_t{0});
    }

    std::uint8_t tolerance_codes_;
    std::vector<std::uint8_t> r_, g_, b_, agrees_;  // [frame]
};

}  // namespace

BackgroundEstimate temporal_consensus(const ExposureNormalizedFrames& frames,
                                      const BackgroundParameters::Estimate& parameters) {
    const int width = frames.width();
    const int height = frames.height();
    BackgroundEstimate background{Image<Rgba8>(width, height), Image<float>(width, height)};
    for_each_index(height, [&](int y) {
        PixelOverTime pixel(frames.count(), parameters.tolerance_codes);
        for (int x = 0; x < width; ++x) {
            for (std::size_t i = 0; i < frames.count(); ++i) pixel.set(i, frames.smooth(i, x, y));
            const auto group = pixel.largest_group();
            background.colour(x, y) = group.mean;
            background.agreement(x, y) = static_cast<float>(group.size) / static_cast<float>(frames.count());
        }
    });
    return background;
}

namespace {

// Mean of the known pixels near one end of a gap, in linear light.
struct GapEnd {
    cv::Vec3f colour;
    int count = 0;
};

// Over x in [from, to) and the rows around y.
GapEnd mean_of_end(const cv::Mat3f& linear, const Image<std::uint8_t>& known, int from, int to, int y, int rows_px) {
    GapEnd end;
    for (int v = std::max(0, y - rows_px); v <= std::min(known.height() - 1, y + rows_px); ++v) {
        for (int u = std::max(0, from); u < std::min(known.width(), to); ++u) {
            if (known(u, v) == 0) continue;
            end.colour += linear(v, u);
            ++end.count;
        }
    }
    if (end.count > 0) end.colour *= 1.0F / static_cast<float>(end.count);
    return end;
}

}  // namespace

void inpaint_rows(Image<Rgba8>& image, Image<std::uint8_t>& known,
                  const BackgroundParameters::RowInpainting& parameters) {
    RS_CHECK(image.width() == known.width() && image.height() == known.height());
    const Image<std::uint8_t> known_before = known;
    const cv::Mat3f linear = linear_mat(image);
    // Starts some pixels away from the gap, where few frames show the background and its colour is uncertain.
    const int margin = parameters.end_margin_px, length = parameters.end_length_px, rows = parameters.end_rows_px;
    for (int y = 0; y < image.height(); ++y) {
        for (int begin = 0; begin < image.width();) {
            if (known_before(begin, y) != 0) {
                ++begin;
                continue;
            }
            int end = begin;
            while (end < image.width() && known_before(end, y) == 0) ++end;
            if (begin > 0 && end < image.width()) {
                const GapEnd left = mean_of_end(linear, known_before, begin - margin - length, begin - margin, y, rows);
                const GapEnd right = mean_of_end(linear, known_before, end + margin, end + margin + length, y, rows);
                const bool is_same_surface =
                    left.count > 0 && right.count > 0 &&
                    within_codes(rgba8_from_linear(left.colour, 255), rgba8_from_linear(right.colour, 255),
                                 parameters.same_surface_codes);
                for (int x = begin; is_same_surface && x < end; ++x) {
                    const float t = (static_cast<float>(x - begin) + 0.5F) / static_cast<float>(end - begin);
                    image(x, y) = rgba8_from_linear(left.colour * (1 - t) + right.colour * t, 255);
                    known(x, y) = 255;
                }
            }
            begin = end;
        }
    }
}

void fill_push_pull(Image<Rgba8>& image, const Image<std::uint8_t>& known) {
    RS_CHECK(image.width() == known.width() && image.height() == known.height());
    // Pull: premultiplied colours and weights, halved down to one pixel.
    std::vector<cv::Mat4f> levels(1, cv::Mat4f(image.height(), image.width()));
    const cv::Mat3f linear = linear_mat(image);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const cv::Vec3f& c = linear(y, x);
            levels[0](y, x) = known(x, y) != 0 ? cv::Vec4f(c[0], c[1], c[2], 1) : cv::Vec4f();
        }
    }
    while (levels.back().cols > 1 || levels.back().rows > 1) {
        cv::Mat4f half;
        cv::resize(levels.back(), half, {(levels.back().cols + 1) / 2, (levels.back().rows + 1) / 2}, 0, 0,
                   cv::INTER_AREA);
        levels.push_back(half);
    }
    if (levels.back()(0, 0)[3] <= 0) return;
    // Push: every level is completed by the coarser one where its own weight is below 1.
    cv::Mat4f filled(1, 1, levels.back()(0, 0) * (1 / levels.back()(0, 0)[3]));
    for (std::size_t level = levels.size() - 1; level-- > 0;) {
        cv::Mat4f finer;
        cv::resize(filled, finer, levels[level].size(), 0, 0, cv::INTER_LINEAR);
        for (int y = 0; y < finer.rows; ++y) {
            for (int x = 0; x < finer.cols; ++x) {
                const cv::Vec4f& own = levels[level](y, x);
                const float weight = std::min(1.0F, own[3]);
                cv::Vec4f& out = finer(y, x);
                out = own + out * (1 - weight);
                out *= 1 / out[3];
            }
        }
        filled = finer;
    }
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            if (known(x, y) != 0) continue;
            const cv::Vec4f& c = filled(y, x);
            image(x, y) = rgba8_from_linear({c[0], c[1], c[2]}, 255);
        }
    }
}

}  // namespace rs::capture
