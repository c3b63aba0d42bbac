#include "capture/tracer/image/discontinuity_filter.hpp"

#include "rayspace/base/parallel.hpp"
#include "rayspace/light/directions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace rs::capture {

namespace {

constexpr int kLevels = 5;                             // steps of 1, 2, 4, 8, 16 px
constexpr int kPatternLevels = 2;                      // levels at which the pattern of groups is visible
constexpr std::array<float, 4> kNoise = {1, 1, 1, 1};  // weights for averaging the variance
constexpr std::array<float, 2> kAround = {2, 1};       // weights for averaging the variance at each level
// Weights that give all groups the same total, which removes their pattern and three quarters of the noise.
constexpr std::array<float, 3> kPattern = {2, 2, 1};
static_assert((1 << kLevels) - 1 + kPatternLevels * (static_cast<int>(kPattern.size()) - 1) +
                  static_cast<int>(kNoise.size()) - 1 <=
              kFilterRadius_px);
// Scales of the differences that reduce a weight.
constexpr float kNormal = 0.3F;      // length of the difference vector
constexpr float kColour = 0.4F;      // length of the difference vector
constexpr float kPlane = 0.012F;     // distance from the tangent plane over distance from the camera
constexpr float kDeviations = 8.0F;  // standard deviations of the luminance
constexpr float kFewSamples = 8.0F;  // with more samples the number of deviations decreases
constexpr int kStrip_px = 1 << 20;   // pixels per strip: buffers take about 200 bytes a pixel
constexpr float kDark = 0.02F;       // offset of colour divisors

using Plane = std::vector<float>;  // one value per pixel, row by row

// Inputs that are constant over the levels.
struct Guides {
    int width, height, samples;
    std::array<Plane, 3> normal, position, colour;
    Plane nearness;  // 1 / tolerated distance from the plane
    Plane known;     // 1: has a surface; 0: excluded from the filter
};

struct Estimates {
    std::array<Plane, 3> colour;  // radiance divided by the surface colour
    Plane variance;               // of its luminance
};

glm::vec3 divisor(const glm::vec3& colour) {
    return colour + glm::vec3(kDark);
}

template <class Work>
void for_each_row(int height, const Work& work) {
    for_each_index(height, 0, [&](std::int64_t y) { work(static_cast<int>(y)); });
}

Guides make_guides(const Accumulation& from) {
    const int width = from.sum.width(), height = from.sum.height();
    const auto size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    Guides guides{width, height, from.samples, {}, {}, {}, Plane(size), Plane(size)};
    for (auto* planes : {&guides.normal, &guides.position, &guides.colour}) planes->fill(Plane(size));
    for_each_row(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            const GuideSum& g = from.guides(x, y);
            const std::size_t i =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
            if (!(2 * g.count >= static_cast<float>(from.samples))) continue;
            const float share = 1.0F / g.count;
            for (int c = 0; c < 3; ++c) {
                const auto axis = static_cast<std::size_t>(c);
                guides.normal[axis][i] = share * g.sum.normal[c];
                guides.position[axis][i] = share * g.sum.position[c];
                guides.colour[axis][i] = share * g.sum.colour[c];
            }
            guides.nearness[i] = 1.0F / (kPlane * share * g.sum.distance + 1e-12F);
            guides.known[i] = 1.0F;
        }
    });
    return guides;
}

// Weighted mean of the known pixels in a square; the weight at offset (x, y) is weights[|x|] * weights[|y|].
Plane blur(const Plane& plane, const Guides& guides, std::span<const float> weights) {
    const int width = guides.width, height = guides.height, radius = static_cast<int>(weights.size()) - 1;
    Plane sums(plane.size()), counts(plane.size()), result(plane.size());
    const auto at = [width](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    };
    const auto weight = [&](int away) { return weights[static_cast<std::size_t>(std::abs(away))]; };
    for_each_row(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            for (int i = std::max(x - radius, 0); i <= std::min(x + radius, width - 1); ++i) {
                const float counted = weight(i - x) * guides.known[at(i, y)];
                sums[at(x, y)] += counted * plane[at(i, y)];
                counts[at(x, y)] += counted;
            }
        }
    });
    for_each_row(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            float sum = 0.0F, count = 0.0F;
            for (int i = std::max(y - radius, 0); i <= std::min(y + radius, height - 1); ++i) {
                sum += weight(i - y) * sums[at(x, i)];
                count += weight(i - y) * counts[at(x, i)];
            }
            result[at(x, y)] = count > 0.0F ? sum / count : 0.0F;
        }
    });
    return result;
}

Plane luminances(const Estimates& light) {
    Plane result(light.variance.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = luminance({light.colour[0][i], light.colour[1][i], light.colour[2][i]});
    }
    return result;
}

// Estimates the variance of the mean from the samples, or from neighbouring pixels if there is only one sample.
void estimate_variance(const Accumulation& from, const Image<RgbaF>& mean, const Guides& guides, Estimates& light) {
    const auto samples = static_cast<float>(from.samples);
    Plane luminance_plane = luminances(light);
    Plane squares(luminance_plane.size());
    for (std::size_t i = 0; i < squares.size(); ++i) {
        if (from.samples == 1) {
            squares[i] = luminance_plane[i] * luminance_plane[i];
            continue;
        }
        const RgbaF& m = mean.pixels()[i];
        const float mean_luminance = luminance({m.r, m.g, m.b}) * m.a;
        const glm::vec3 colour(guides.colour[0][i], guides.colour[1][i], guides.colour[2][i]);
        const float by = luminance(divisor(colour));
        if (!(guides.known[i] > 0.0F)) continue;
        const float variance =
            std::max(from.guides.pixels()[i].squares / samples - mean_luminance * mean_luminance, 0.0F);
        squares[i] = variance / ((samples - 1.0F) * by * by);
    }
    light.variance = blur(squares, guides, kNoise);
    if (from.samples > 1) return;
    luminance_plane = blur(luminance_plane, guides, kNoise);
    for (std::size_t i = 0; i < squares.size(); ++i) {
        light.variance[i] = std::max(light.variance[i] - luminance_plane[i] * luminance_plane[i], 0.0F);
    }
}

// Sums of one row.
struct FilteredRow {
    std::array<Plane, 3> colour;
    Plane weight, variance;
    explicit FilteredRow(std::size_t width) : weight(width), variance(width) { colour.fill(Plane(width)); }
};

// Inputs of one level.
struct LevelInputs {
    const Guides& guides;
    const Estimates& light;
    const Plane& brightness;
    const Plane& sharpness;  // 1 / tolerated difference of brightness
};

// Neighbour of the pixels [from, to) of a row.
struct Neighbour {
    std::ptrdiff_t offset;  // in pixels of the plane
    float weight;
    int from, to;
};

// Adds the neighbour to the pixels of the row that starts at index `row` of the planes.
void add_neighbours(const LevelInputs& level, std::size_t row, const Neighbour& neighbour, FilteredRow& sums) {
    const auto& [guides, light, brightness, sharpness] = level;
    const auto [offset, weight, from, to] = neighbour;
    const auto& [nx, ny, nz] = guides.normal;
    const auto& [px, py, pz] = guides.position;
    const auto& [cr, cg, cb] = guides.colour;
    for (auto x = static_cast<std::size_t>(from); x < static_cast<std::size_t>(to); ++x) {
        const std::size_t i = row + x;
        const std::size_t j = i + static_cast<std::size_t>(offset);
        const float ax = nx[j] - nx[i], ay = ny[j] - ny[i], az = nz[j] - nz[i];
        const float er = cr[j] - cr[i], eg = cg[j] - cg[i], eb = cb[j] - cb[i];
        const float off_plane = std::abs((px[j] - px[i]) * nx[i] + (py[j] - py[i]) * ny[i] + (pz[j] - pz[i]) * nz[i]);
        const float difference = (ax * ax + ay * ay + az * az) * (1.0F / (kNormal * kNormal)) +
                                 (er * er + eg * eg + eb * eb) * (1.0F / (kColour * kColour)) +
                                 off_plane * guides.nearness[i] +
                                 std::abs(brightness[j] - brightness[i]) * sharpness[i];
        // Approximates exp(-difference).
        const float near = 1.0F - 0.25F * difference;
        const float square = near * near;
        const float w = near > 0.0F ? weight * guides.known[j] * square * square : 0.0F;
        sums.weight[x] += w;
        sums.variance[x] += w * w * light.variance[j];
        sums.colour[0][x] += w * light.colour[0][j];
        sums.colour[1][x] += w * light.colour[1][j];
        sums.colour[2][x] += w * light.colour[2][j];
    }
}

Estimates filter_level(const Estimates& light, const Guides& guides, int level) {
    const int width = guides.width, height = guides.height, step = 1 << level;
    Plane brightness = luminances(light);
    float deviations = kDeviations * std::min(1.0F, std::sqrt(kFewSamples / static_cast<float>(guides.samples)));
    if (level < kPatternLevels) {
        // A small share of the unblurred brightness preserves lighting patterns once noise is low.
        constexpr float kUnblurred = 1.0F / 16;
        const Plane means = blur(brightness, guides, kPattern);
        for (std::size_t i = 0; i < means.size(); ++i) brightness[i] = means[i] + kUnblurred * brightness[i];
        deviations /= 4;
    }
    Plane sharpness = blur(light.variance, guides, kAround);
    for (float& s : sharpness) s = 1.0F / (deviations * std::sqrt(s) + 1e-6F);
    const LevelInputs inputs{guides, light, brightness, sharpness};
    Estimates result = light;
    for_each_row(height, [&](int y) {
        const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
        FilteredRow sums(static_cast<std::size_t>(width));
        for (int dy = -step; dy <= step; dy += step) {
            if (y + dy < 0 || y + dy >= height) continue;
            for (int dx = -step; dx <= step; dx += step) {
                const float weight = (dy == 0 ? 0.5F : 0.25F) * (dx == 0 ? 0.5F : 0.25F);
                add_neighbours(inputs, row,
                               {.offset = static_cast<std::ptrdiff_t>(dy) * width + dx,
                                .weight = weight,
                                .from = std::max(0, -dx),
                                .to = std::clamp(width - dx, 0, width)},
                               sums);
            }
        }
        for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
            if (!(sums.weight[x] > 0.0F)) continue;
            const float share = 1.0F / sums.weight[x];
            for (std::size_t c = 0; c < 3; ++c) result.colour[c][row + x] = share * sums.colour[c][x];
            result.variance[row + x] = share * share * sums.variance[x];
        }
    });
    return result;
}

// Filters a whole accumulation at once.
Image<RgbaF> filter_image(const Accumulation& accumulation) {
    Image<RgbaF> image = accumulation.mean();
    Guides guides = make_guides(accumulation);
    const std::size_t size = guides.known.size();
    Estimates light;
    light.variance.resize(size);
    light.colour.fill(Plane(size));
    const auto divisor_at = [&](std::size_t i) {
        return divisor({guides.colour[0][i], guides.colour[1][i], guides.colour[2][i]});
    };
    for (std::size_t i = 0; i < size; ++i) {
        const RgbaF& p = image.pixels()[i];
        if (!std::isfinite(p.r + p.g + p.b)) {
            guides.known[i] = 0.0F;
            continue;
        }
        const glm::vec3 by = divisor_at(i);
        light.colour[0][i] = p.r / by.r;
        light.colour[1][i] = p.g / by.g;
        light.colour[2][i] = p.b / by.b;
    }
    estimate_variance(accumulation, image, guides, light);
    for (int level = 0; level < kLevels; ++level) light = filter_level(light, guides, level);
    for (std::size_t i = 0; i < size; ++i) {
        if (!(guides.known[i] > 0.0F)) continue;
        RgbaF& p = image.pixels()[i];
        const glm::vec3 by = divisor_at(i);
        p.r = light.colour[0][i] * by.r;
        p.g = light.colour[1][i] * by.g;
        p.b = light.colour[2][i] * by.b;
    }
    return image;
}

}  // namespace

PixelRectangle with_filter_margin(const PixelRectangle& part) {
    return {part.x0 - kFilterRadius_px, part.y0 - kFilterRadius_px, part.x1 + kFilterRadius_px,
            part.y1 + kFilterRadius_px};
}

Image<RgbaF> filtered_mean(const Accumulation& accumulation) {
    return filtered_mean(accumulation, {0, 0, accumulation.sum.width(), accumulation.sum.height()});
}

Image<RgbaF> filtered_mean(const Accumulation& accumulation, const PixelRectangle& part) {
    Image<RgbaF> image = accumulation.mean();
    const PixelRectangle whole{0, 0, image.width(), image.height()};
    const PixelRectangle shown = overlap(whole, part);
    if (accumulation.guides.empty() || accumulation.samples < 1 || shown.x0 >= shown.x1) return image;
    const int rows = std::max(kFilterRadius_px, kStrip_px / (shown.x1 - shown.x0));
    for (int top = shown.y0; top < shown.y1; top += rows) {
        const PixelRectangle strip{shown.x0, top, shown.x1, std::min(top + rows, shown.y1)};
        const PixelRectangle around = overlap(whole, with_filter_margin(strip));
        const Image<RgbaF> filtered = filter_image(accumulation.crop(around));
        for (int y = strip.y0; y < strip.y1; ++y) {
            for (int x = strip.x0; x < strip.x1; ++x) image(x, y) = filtered(x - around.x0, y - around.y0);
        }
    }
    return image;
}

}  // namespace rs::capture
