#include "rayspace/light/irradiance_harmonics.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rs {
namespace {

// The squared norms of the harmonics, 1 / (4 pi), 3 / (4 pi), 15 / (4 pi), 5 / (16 pi) and 15 / (16 pi), times those of
// the cosine over pi, 1, 2/3 and 1/4; all times pi.
constexpr std::array<double, 9> kFactors{1.0 / 4,   1.0 / 2,   1.0 / 2,   1.0 / 2,  5.0 / 64,
                                         15.0 / 16, 15.0 / 16, 15.0 / 16, 15.0 / 64};
// Those of the cosine over pi.
constexpr std::array<float, 9> kCosine{1, 2.0F / 3, 2.0F / 3, 2.0F / 3, 0.25F, 0.25F, 0.25F, 0.25F, 0.25F};

std::array<float, 9> terms_of(const glm::vec3& n) {
    return {1, n.y, n.x, n.z, 3 * n.y * n.y - 1, n.x * n.y, n.y * n.z, n.x * n.z, n.z * n.z - n.x * n.x};
}

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

}  // namespace

glm::vec3 IrradianceHarmonics::at(const glm::vec3& normal) const {
    const std::array<float, 9> terms = terms_of(normal);
    glm::vec3 sum(0);
    for (std::size_t i = 0; i < terms.size(); ++i) sum += glm::vec3(factors[i]) * terms[i];
    return glm::max(sum, glm::vec3(0));
}

void IrradianceHarmonics::add_direction(const glm::vec3& direction, const glm::vec3& irradiance) {
    const std::array<float, 9> terms = terms_of(direction);
    for (std::size_t i = 0; i < terms.size(); ++i) {
        factors[i] += glm::vec4(irradiance * (terms[i] * static_cast<float>(kFactors[i] / kPi)), 0);
    }
}

IrradianceHarmonics& IrradianceHarmonics::operator+=(const IrradianceHarmonics& other) {
    for (std::size_t i = 0; i < factors.size(); ++i) factors[i] += other.factors[i];
    return *this;
}

IrradianceHarmonics& IrradianceHarmonics::operator*=(float scale) {
    for (glm::vec4& factor : factors) factor *= scale;
    return *this;
}

IrradianceHarmonics project_irradiance(const Image<RgbaF>& map) {
    const std::vector<glm::dvec4> columns = column_integrals(map.width());
    std::vector<RowIntegrals> rows(static_cast<std::size_t>(map.height()));
    for_each_index(map.height(), 0, [&](std::int64_t y) {
        rows[static_cast<std::size_t>(y)] = integrate_row(map, static_cast<int>(y), columns);
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
    IrradianceHarmonics harmonics;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        harmonics.factors[i] = glm::vec4(sums[i] * (kFactors[i] / kPi), 0);
    }
    return harmonics;
}

IrradianceHarmonics fit_harmonics(const std::function<glm::vec3(const glm::vec3& normal)>& function) {
    constexpr int kWidth = 32;
    Image<RgbaF> map(kWidth, kWidth / 2);
    for (int y = 0; y < map.height(); ++y) {
        const double polar = kPi * (y + 0.5) / map.height();
        for (int x = 0; x < kWidth; ++x) {
            const double azimuth = 2 * kPi * (x + 0.5) / kWidth - kPi;
            const glm::vec3 value =
                function({std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)});
            map(x, y) = {value.r, value.g, value.b, 1};
        }
    }
    IrradianceHarmonics fit = project_irradiance(map);
    for (std::size_t i = 0; i < fit.factors.size(); ++i) fit.factors[i] /= kCosine[i];
    return fit;
}

}  // namespace rs
