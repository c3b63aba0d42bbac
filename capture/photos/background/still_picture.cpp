#include "capture/photos/background/still_picture.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

namespace rs::capture {
namespace {

// What all samples show at one pixel, channel by channel, so that many are compared at a time.
class PixelOverTime {
public:
    explicit PixelOverTime(std::size_t samples) : r_(samples), g_(samples), b_(samples), agrees_(samples) {}
    void set(std::size_t sample, const Rgba8& value) {
        r_[sample] = value.r;
        g_[sample] = value.g;
        b_[sample] = value.b;
    }
    [[nodiscard]] std::size_t samples() const { return r_.size(); }

    // Of the largest group of samples that agree with one of them, the first such one; its mean and how many it has.
    struct Group {
        Rgba8 mean;
        std::size_t size = 0;
    };
    Group largest_group() {
        std::size_t best = 0;
        std::size_t best_size = 0;
        for (std::size_t i = 0; i < samples(); ++i) {
            const std::size_t size = compare_with(i);
            if (size > best_size) {
                best_size = size;
                best = i;
            }
            if (size == samples()) break;  // a still pixel, the usual case
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
    static std::uint8_t apart(std::uint8_t a, std::uint8_t b) {
        return static_cast<std::uint8_t>(std::max(a, b) - std::min(a, b));
    }
    // Which samples agree with sample i, as samples_agree() has it; how many.
    std::size_t compare_with(std::size_t i) {
        const std::uint8_t r = r_[i], g = g_[i], b = b_[i];
        for (std::size_t k = 0; k < samples(); ++k) {
            const std::uint8_t most = std::max({apart(r, r_[k]), apart(g, g_[k]), apart(b, b_[k])});
            agrees_[k] = most <= kAgreement_codes ? 1 : 0;
        }
        return std::accumulate(agrees_.begin(), agrees_.end(), std::size_t{0});
    }

    std::vector<std::uint8_t> r_, g_, b_, agrees_;  // [sample]
};

}  // namespace

StillPicture agree_over_time(const EvenedSamples& samples) {
    const int width = samples.width();
    const int height = samples.height();
    StillPicture still{Image<Rgba8>(width, height), Image<float>(width, height)};
    for_each_index(height, [&](int y) {
        PixelOverTime pixel(samples.count());
        for (int x = 0; x < width; ++x) {
            for (std::size_t i = 0; i < samples.count(); ++i) pixel.set(i, samples.smooth(i, x, y));
            const auto group = pixel.largest_group();
            still.colour(x, y) = group.mean;
            still.agreement(x, y) = static_cast<float>(group.size) / static_cast<float>(samples.count());
        }
    });
    return still;
}

namespace {

// Ends of a gap are averaged over so many pixels along the row and so many rows up and down, and begin a little away
// from the gap, for what is seen seldom is known badly.
constexpr int kEndBegins_px = 3;
constexpr int kEndLength_px = 8;
constexpr int kEndRows_px = 1;
constexpr int kSameSurface_codes = 40;

struct End {
    cv::Vec3f colour;
    int count = 0;
};

// Mean of the known pixels of x in [from, to), about row y.
End mean_end(const cv::Mat3f& linear, const Image<std::uint8_t>& known, int from, int to, int y) {
    End end;
    for (int v = std::max(0, y - kEndRows_px); v <= std::min(known.height() - 1, y + kEndRows_px); ++v) {
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

void bridge_rows(Image<Rgba8>& picture, Image<std::uint8_t>& known) {
    RS_CHECK(picture.width() == known.width() && picture.height() == known.height());
    const Image<std::uint8_t> seen = known;
    const cv::Mat3f linear = linear_mat(picture);
    for (int y = 0; y < picture.height(); ++y) {
        for (int begin = 0; begin < picture.width();) {
            if (seen(begin, y) != 0) {
                ++begin;
                continue;
            }
            int end = begin;
            while (end < picture.width() && seen(end, y) == 0) ++end;
            if (begin > 0 && end < picture.width()) {
                const End left =
                    mean_end(linear, seen, begin - kEndBegins_px - kEndLength_px, begin - kEndBegins_px, y);
                const End right = mean_end(linear, seen, end + kEndBegins_px, end + kEndBegins_px + kEndLength_px, y);
                const bool one_surface = left.count > 0 && right.count > 0 &&
                                         samples_agree(rgba8_from_linear(left.colour, 255),
                                                       rgba8_from_linear(right.colour, 255), kSameSurface_codes);
                for (int x = begin; one_surface && x < end; ++x) {
                    const float t = (static_cast<float>(x - begin) + 0.5F) / static_cast<float>(end - begin);
                    picture(x, y) = rgba8_from_linear(left.colour * (1 - t) + right.colour * t, 255);
                    known(x, y) = 255;
                }
            }
            begin = end;
        }
    }
}

void fill_unknown(Image<Rgba8>& picture, const Image<std::uint8_t>& known) {
    RS_CHECK(picture.width() == known.width() && picture.height() == known.height());
    // Weighted colours, halved until one pixel is left (push) ...
    std::vector<cv::Mat4f> levels(1, cv::Mat4f(picture.height(), picture.width()));
    const cv::Mat3f linear = linear_mat(picture);
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
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
    // ... then every level takes from the coarser one what it does not know itself (pull).
    cv::Mat4f filled(1, 1, levels.back()(0, 0) * (1 / levels.back()(0, 0)[3]));
    for (std::size_t level = levels.size() - 1; level-- > 0;) {
        cv::Mat4f finer;
        cv::resize(filled, finer, levels[level].size(), 0, 0, cv::INTER_LINEAR);
        for (int y = 0; y < finer.rows; ++y) {
            for (int x = 0; x < finer.cols; ++x) {
                const cv::Vec4f& own = levels[level](y, x);
                const float share = std::min(1.0F, own[3]);
                cv::Vec4f& out = finer(y, x);
                out = own + out * (1 - share);
                out *= 1 / out[3];
            }
        }
        filled = finer;
    }
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            if (known(x, y) != 0) continue;
            const cv::Vec4f& c = filled(y, x);
            picture(x, y) = rgba8_from_linear({c[0], c[1], c[2]}, 255);
        }
    }
}

}  // namespace rs::capture
