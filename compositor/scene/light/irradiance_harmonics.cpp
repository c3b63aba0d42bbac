#include "compositor/scene/light/irradiance_harmonics.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace rs::compositor {
namespace {

// Integrals over y, from the nadir on, of the parts of the harmonics that depend on the polar angle only; `sine` is
// that of the polar angle.
struct PolarIntegrals {
    double one, y, three_y2, sine, y_sine, sine2;
};

PolarIntegrals integrals_to(double y) {
    const double sine = std::sqrt(std::max(1 - y * y, 0.0));
    return {y, 0.5 * y * y, y * y * y - y, 0.5 * (y * sine + std::asin(y)), -sine * sine * sine / 3, y - y * y * y / 3};
}

PolarIntegrals band_between(const PolarIntegrals& top, const PolarIntegrals& bottom) {
    return {top.one - bottom.one,   top.y - bottom.y,           top.three_y2 - bottom.three_y2,
            top.sine - bottom.sine, top.y_sine - bottom.y_sine, top.sine2 - bottom.sine2};
}

// Integrals of a row over the azimuth, from -Z towards +X: of the radiance times 1, sin, cos, sin 2, cos 2.
struct RowIntegrals {
    glm::dvec3 one{0}, sine{0}, cosine{0}, sine2{0}, cosine2{0};
};

// Integrals of sin, cos, sin 2 and cos 2 over the azimuths of each column.
std::vector<glm::dvec4> column_integrals(int width) {
    std::vector<glm::dvec4> columns;
    const double step = 2 * kPi / width;
    const double first = 2 * std::sin(0.5 * step);
    const double second = std::sin(step);
    for (int x = 0; x < width; ++x) {
        const double turn = (x + 0.5) * step - kPi;
        columns.emplace_back(first * std::sin(turn), first * std::cos(turn), second * std::sin(2 * turn),
                             second * std::cos(2 * turn));
    }
    return columns;
}

RowIntegrals integrate_row(const Image<RgbaF>& pixels, int y, const std::vector<glm::dvec4>& columns) {
    RowIntegrals row;
    for (int x = 0; x < pixels.width(); ++x) {
        const RgbaF& p = pixels(x, y);
        const glm::dvec3 radiance(p.r, p.g, p.b);
        const glm::dvec4& column = columns[static_cast<std::size_t>(x)];
        row.one += radiance;
        row.sine += radiance * column.x;
        row.cosine += radiance * column.y;
        row.sine2 += radiance * column.z;
        row.cosine2 += radiance * column.w;
    }
    row.one *= 2 * kPi / pixels.width();
    return row;
}

// Without scale and rotation. The factors contain the squared norms of the harmonics, 1 / (4 pi), 3 / (4 pi),
// 15 / (4 pi), 5 / (16 pi) and 15 / (16 pi), and those of the cosine over pi, 1, 2/3 and 1/4.
IrradianceHarmonics project_map(const Image<RgbaF>& pixels) {
    const std::vector<glm::dvec4> columns = column_integrals(pixels.width());
    std::vector<RowIntegrals> rows(static_cast<std::size_t>(pixels.height()));
    for_each_index(pixels.height(), 0, [&](std::int64_t y) {
        rows[static_cast<std::size_t>(y)] = integrate_row(pixels, static_cast<int>(y), columns);
    });
    std::array<glm::dvec3, 9> sums{};
    PolarIntegrals top = integrals_to(1);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const PolarIntegrals bottom =
            integrals_to(std::cos(kPi * static_cast<double>(i + 1) / static_cast<double>(rows.size())));
        const PolarIntegrals polar = band_between(top, bottom);
        const RowIntegrals& row = rows[i];
        sums[0] += row.one * polar.one;
        sums[1] += row.one * polar.y;
        sums[2] += row.sine * polar.sine;
        sums[3] -= row.cosine * polar.sine;
        sums[4] += row.one * polar.three_y2;
        sums[5] += row.sine * polar.y_sine;
        sums[6] -= row.cosine * polar.y_sine;
        sums[7] -= row.sine2 * (0.5 * polar.sine2);
        sums[8] += row.cosine2 * polar.sine2;
        top = bottom;
    }
    constexpr std::array<double, 9> kFactors{1.0 / 4,   1.0 / 2,   1.0 / 2,   1.0 / 2,  5.0 / 64,
                                             15.0 / 16, 15.0 / 16, 15.0 / 16, 15.0 / 64};
    IrradianceHarmonics harmonics;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        harmonics.factors[i] = glm::vec4(sums[i] * (kFactors[i] / kPi), 0);
    }
    return harmonics;
}

// The sines and cosines of the azimuth become those of the azimuth plus `turn_rad`.
IrradianceHarmonics scale_and_turn(const IrradianceHarmonics& from, float scale, float turn_rad) {
    const float sine = std::sin(turn_rad), cosine = std::cos(turn_rad);
    const float sine2 = std::sin(2 * turn_rad), cosine2 = std::cos(2 * turn_rad);
    const auto& f = from.factors;
    IrradianceHarmonics turned = from;
    turned.factors[2] = f[2] * cosine + f[3] * sine;
    turned.factors[3] = f[3] * cosine - f[2] * sine;
    turned.factors[5] = f[5] * cosine + f[6] * sine;
    turned.factors[6] = f[6] * cosine - f[5] * sine;
    turned.factors[7] = f[7] * cosine2 + f[8] * (2 * sine2);
    turned.factors[8] = f[8] * cosine2 - f[7] * (0.5F * sine2);
    for (glm::vec4& factor : turned.factors) factor *= scale;
    return turned;
}

}  // namespace

glm::vec3 IrradianceHarmonics::at(const glm::vec3& normal) const {
    const glm::vec3& n = normal;
    const std::array<float, 9> terms{
        1, n.y, n.x, n.z, 3 * n.y * n.y - 1, n.x * n.y, n.y * n.z, n.x * n.z, n.z * n.z - n.x * n.x};
    glm::vec3 sum(0);
    for (std::size_t i = 0; i < terms.size(); ++i) sum += glm::vec3(factors[i]) * terms[i];
    return glm::max(sum, glm::vec3(0));
}

IrradianceHarmonics project_irradiance(const EnvironmentLight& environment) {
    return scale_and_turn(project_map(*environment.pixels), environment.scale, environment.turn_rad);
}

std::optional<IrradianceHarmonics> EnvironmentIrradiance::of(const std::optional<EnvironmentLight>& environment) {
    if (!environment) return std::nullopt;
    if (environment->pixels != pixels_) {
        unscaled_ = project_map(*environment->pixels);
        pixels_ = environment->pixels;
    }
    return scale_and_turn(unscaled_, environment->scale, environment->turn_rad);
}

}  // namespace rs::compositor
