#include "capture/tracer/light/environment_map.hpp"

#include "rayspace/light/directions.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace rs::capture {
namespace {

// Makes a cumulative sum end in 1 and returns its total before; an empty distribution becomes uniform.
double normalise_cdf(const std::vector<double>& weights, std::span<float> cdf) {
    double total = 0;
    for (const double weight : weights) total += weight;
    double sum = 0;
    cdf[0] = 0.0F;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        sum += total > 0 ? weights[i] / total : 1.0 / static_cast<double>(weights.size());
        cdf[i + 1] = static_cast<float>(sum);
    }
    cdf[weights.size()] = 1.0F;
    return total;
}

struct CdfSample {
    int index;
    float fraction;  // within the interval, [0, 1)
    float probability;
};

CdfSample sample_cdf(std::span<const float> cdf, float u) {
    const auto upper = std::upper_bound(cdf.begin() + 1, cdf.end() - 1, u);
    const auto index = static_cast<std::size_t>(upper - cdf.begin()) - 1;
    const float width = cdf[index + 1] - cdf[index];
    const float fraction = width > 0.0F ? std::min((u - cdf[index]) / width, 0x1.fffffep-1F) : 0.5F;
    return {static_cast<int>(index), std::max(fraction, 0.0F), width};
}

}  // namespace

EnvironmentMap::EnvironmentMap(Environment environment) : turn_rad_(environment.turn_rad), scale_(environment.scale) {
    const int width = environment.pixels.width();
    const int height = environment.pixels.height();
    if (environment.pixels.empty()) return;
    pixels_ = std::move(environment.pixels);

    cos_of_edge_.resize(static_cast<std::size_t>(height) + 1);
    for (int y = 0; y <= height; ++y) {
        cos_of_edge_[static_cast<std::size_t>(y)] =
            static_cast<float>(std::cos(static_cast<double>(kPiF) * y / height));
    }

    const auto stride = static_cast<std::size_t>(width) + 1;
    std::vector<float> row_cdf(static_cast<std::size_t>(height) + 1);
    column_cdf_.resize(stride * static_cast<std::size_t>(height));
    std::vector<double> row_weights(static_cast<std::size_t>(height));
    std::vector<double> weights(static_cast<std::size_t>(width));
    double total = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            double sum = 0;
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx) {
                    const RgbaF& p = pixels_((x + dx + width) % width, std::clamp(y + dy, 0, height - 1));
                    sum += static_cast<double>(luminance({p.r, p.g, p.b}));
                }
            }
            weights[static_cast<std::size_t>(x)] = sum / 9.0;
        }
        const auto row = static_cast<std::size_t>(y);
        const double sum = normalise_cdf(weights, std::span(column_cdf_).subspan(row * stride, stride));
        // The row's solid angle is 2 pi (difference of cosines).
        row_weights[row] = sum / width * static_cast<double>(cos_of_edge_[row] - cos_of_edge_[row + 1]);
        total += row_weights[row];
    }
    mean_luminance_ = static_cast<float>(total / 2.0);
    if (total <= 0) return;
    normalise_cdf(row_weights, row_cdf);
    row_cdf_ = std::move(row_cdf);
}

EnvironmentMap::MapPosition EnvironmentMap::position_of(const glm::vec3& direction) const {
    const float phi = std::atan2(direction.x, -direction.z) + turn_rad_;
    const float turns = 0.5F + phi / (2.0F * kPiF);
    const float polar = std::acos(std::clamp(direction.y, -1.0F, 1.0F)) / kPiF;
    return {(turns - std::floor(turns)) * static_cast<float>(pixels_.width()),
            polar * static_cast<float>(pixels_.height())};
}

glm::vec3 EnvironmentMap::radiance(const glm::vec3& towards_sky) const {
    if (is_black()) return glm::vec3(0.0F);
    const int width = pixels_.width();
    const int height = pixels_.height();
    const MapPosition position = position_of(towards_sky);
    const float x = position.x - 0.5F;
    const float y = position.y - 0.5F;
    const float left = std::floor(x);
    const float top = std::floor(y);
    const int x0 = (static_cast<int>(left) + width) % width;
    const int x1 = (x0 + 1) % width;
    const int y0 = std::clamp(static_cast<int>(top), 0, height - 1);
    const int y1 = std::clamp(static_cast<int>(top) + 1, 0, height - 1);
    const auto vec = [&](int px, int py) {
        const RgbaF& p = pixels_(px, py);
        return glm::vec3(p.r, p.g, p.b);
    };
    const float fx = x - left;
    return scale_ * glm::mix(glm::mix(vec(x0, y0), vec(x1, y0), fx), glm::mix(vec(x0, y1), vec(x1, y1), fx), y - top);
}

float EnvironmentMap::pdf(const glm::vec3& towards_sky) const {
    if (is_black()) return 0.0F;
    const int width = pixels_.width();
    const int height = pixels_.height();
    const MapPosition position = position_of(towards_sky);
    const auto x = static_cast<std::size_t>(std::clamp(static_cast<int>(position.x), 0, width - 1));
    const auto y = static_cast<std::size_t>(std::clamp(static_cast<int>(position.y), 0, height - 1));
    const float* columns = column_cdf_.data() + y * (static_cast<std::size_t>(width) + 1);
    const float probability = (row_cdf_[y + 1] - row_cdf_[y]) * (columns[x + 1] - columns[x]);
    return probability * static_cast<float>(width) / (2.0F * kPiF * (cos_of_edge_[y] - cos_of_edge_[y + 1]));
}

EnvironmentMap::Sample EnvironmentMap::sample(const glm::vec2& u) const {
    const auto width = static_cast<std::size_t>(pixels_.width());
    const CdfSample row = sample_cdf(row_cdf_, u.y);
    const auto y = static_cast<std::size_t>(row.index);
    const CdfSample column = sample_cdf(std::span(column_cdf_).subspan(y * (width + 1), width + 1), u.x);
    // Even density over the pixel's solid angle: even in azimuth and in the cosine of the polar angle.
    const float cos_polar = glm::mix(cos_of_edge_[y], cos_of_edge_[y + 1], row.fraction);
    const float sin_polar = std::sqrt(std::max(0.0F, 1.0F - cos_polar * cos_polar));
    const float turns = (static_cast<float>(column.index) + column.fraction) / static_cast<float>(width);
    const float phi = (turns - 0.5F) * 2.0F * kPiF - turn_rad_;
    const float pixel_solid_angle = 2.0F * kPiF / static_cast<float>(width) * (cos_of_edge_[y] - cos_of_edge_[y + 1]);
    return {{sin_polar * std::sin(phi), cos_polar, -sin_polar * std::cos(phi)},
            row.probability * column.probability / pixel_solid_angle};
}

namespace {

constexpr int kColumns = 32, kRows = 17;  // of normals; the first and the last row are the poles
constexpr int kSkyRows = 60;
constexpr int kSamples = 4;  // per side of a sky patch

glm::vec3 direction_of(float polar, float turn) {
    return {std::sin(polar) * std::sin(turn), std::cos(polar), -std::sin(polar) * std::cos(turn)};
}

struct SkyPatch {
    glm::vec3 direction;
    glm::vec3 flux;  // radiance times solid angle
};

std::vector<SkyPatch> patches_of(const EnvironmentMap& environment) {
    std::vector<SkyPatch> patches;
    const float step = kPiF / kSkyRows;
    for (int row = 0; row < kSkyRows; ++row) {
        const float top = static_cast<float>(row) * step;
        const float solid_angle = (std::cos(top) - std::cos(top + step)) * step;
        for (int column = 0; column < 2 * kSkyRows; ++column) {
            const float left = static_cast<float>(column) * step;
            glm::vec3 sum(0.0F);
            for (int sample_row = 0; sample_row < kSamples; ++sample_row) {
                const float v = (static_cast<float>(sample_row) + 0.5F) / kSamples;
                for (int sample_column = 0; sample_column < kSamples; ++sample_column) {
                    const float u = (static_cast<float>(sample_column) + 0.5F) / kSamples;
                    sum += environment.radiance(direction_of(top + v * step, left + u * step));
                }
            }
            patches.push_back(
                {direction_of(top + 0.5F * step, left + 0.5F * step), sum * (solid_angle / (kSamples * kSamples))});
        }
    }
    return patches;
}

}  // namespace

IrradianceMap::IrradianceMap(const EnvironmentMap& environment) {
    if (environment.is_black()) return;
    const std::vector<SkyPatch> patches = patches_of(environment);
    grid_ = Image<RgbaF>(kColumns, kRows);
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column) {
            const glm::vec3 normal = direction_of(kPiF * static_cast<float>(row) / (kRows - 1),
                                                  2.0F * kPiF * static_cast<float>(column) / kColumns);
            glm::vec3 sum(0.0F);
            for (const SkyPatch& patch : patches) sum += patch.flux * std::max(glm::dot(normal, patch.direction), 0.0F);
            grid_(column, row) = {sum.r, sum.g, sum.b, 1};
        }
    }
}

glm::vec3 IrradianceMap::at(const glm::vec3& normal) const {
    if (is_black()) return glm::vec3(0.0F);
    const float y = std::acos(std::clamp(normal.y, -1.0F, 1.0F)) / kPiF * (kRows - 1);
    float x = std::atan2(normal.x, -normal.z) / (2.0F * kPiF) * kColumns;
    if (x < 0.0F) x += kColumns;
    const int x0 = std::min(static_cast<int>(x), kColumns - 1), y0 = std::min(static_cast<int>(y), kRows - 2);
    const float part_x = x - static_cast<float>(x0), part_y = y - static_cast<float>(y0);
    const auto texel = [&](int column, int row) {
        const RgbaF& p = grid_(column % kColumns, row);
        return glm::vec3(p.r, p.g, p.b);
    };
    return glm::mix(glm::mix(texel(x0, y0), texel(x0 + 1, y0), part_x),
                    glm::mix(texel(x0, y0 + 1), texel(x0 + 1, y0 + 1), part_x), part_y);
}

}  // namespace rs::capture
