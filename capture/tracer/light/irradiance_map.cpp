#include "capture/tracer/light/irradiance_map.hpp"

#include "rayspace/light/directions.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rs::capture {

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
