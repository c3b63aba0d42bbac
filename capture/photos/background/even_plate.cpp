#include "capture/photos/background/even_plate.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "rayspace/base/check.hpp"
#include "rayspace/image/linear_light.hpp"

#include <opencv2/core.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace rs::capture {
namespace {

constexpr int kTerms = 6;
using Terms = cv::Vec<double, kTerms>;
using Codes = cv::Matx<double, 1, 3>;
using Course = cv::Matx<double, kTerms, 3>;

// Of the shorter side. Farther inside than this band, what looks like the same course counts, too.
constexpr double kBand = 0.15;
constexpr double kEnoughSeen = 0.3;     // of the band on each of the four sides
constexpr double kFits_codes = 3;       // so near the course is ...
constexpr double kFittingShare = 0.95;  // ... nearly all of the band; a shadow may fade out there
constexpr int kRounds = 4;  // the first of the whole band, the others of what is near; for each, twice as near

int band_px_of(int width, int height) {
    return std::max(1, static_cast<int>(kBand * std::min(width, height)));
}

Terms terms_at(int x, int y, int width, int height) {
    const double u = (2 * x + 1.0) / width - 1, v = (2 * y + 1.0) / height - 1;
    return {1, u, v, u * u, u * v, v * v};
}

Codes codes_of(const Rgba8& p) {
    return {static_cast<double>(p.r), static_cast<double>(p.g), static_cast<double>(p.b)};
}

Codes codes_at(const Course& course, const Terms& terms) {
    return terms.t() * course;
}

bool is_near(const Codes& a, const Codes& b, double codes) {
    const Codes off = a - b;
    return std::max({std::abs(off(0)), std::abs(off(1)), std::abs(off(2))}) <= codes;
}

bool all_sides_seen(ConstImageView<std::uint8_t> untouched) {
    const int band_px = band_px_of(untouched.width(), untouched.height());
    const cv::Mat1b seen = mat_over(untouched);
    const std::array sides{seen.rowRange(0, band_px), seen.rowRange(seen.rows - band_px, seen.rows),
                           seen.colRange(0, band_px), seen.colRange(seen.cols - band_px, seen.cols)};
    return std::ranges::all_of(sides, [](const cv::Mat& side) {
        return cv::countNonZero(side) >= kEnoughSeen * static_cast<double>(side.total());
    });
}

}  // namespace

bool in_border_band(int x, int y, int width, int height) {
    const int band_px = band_px_of(width, height);
    return x < band_px || y < band_px || x >= width - band_px || y >= height - band_px;
}

Image<LinearRgb> even_plate(ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> untouched) {
    RS_CHECK(plate.width() == untouched.width() && plate.height() == untouched.height());
    const int width = plate.width(), height = plate.height();
    if (width == 0 || height == 0) return {};
    if (!all_sides_seen(untouched)) return {};
    std::optional<Course> course;
    for (int round = 0; round <= kRounds; ++round) {  // the last only looks whether it fits
        cv::Matx<double, kTerms, kTerms> normal = cv::Matx<double, kTerms, kTerms>::zeros();
        cv::Matx<double, kTerms, 3> right_side = cv::Matx<double, kTerms, 3>::zeros();
        std::ptrdiff_t seen = 0, fits = 0;  // px of the band
        const double near_codes = std::ldexp(kFits_codes, kRounds - round);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const bool here = in_border_band(x, y, width, height);
                if (untouched(x, y) == 0) continue;
                seen += here ? 1 : 0;
                const Terms terms = terms_at(x, y, width, height);
                const Codes codes = codes_of(plate(x, y));
                if (course ? !is_near(codes_at(*course, terms), codes, near_codes) : !here) continue;
                fits += here ? 1 : 0;
                normal += terms * terms.t();
                right_side += terms * codes;
            }
        }
        if (static_cast<double>(fits) < kFittingShare * static_cast<double>(seen)) return {};
        if (round < kRounds) course = normal.solve(right_side, cv::DECOMP_SVD);
    }
    Image<LinearRgb> result(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const Codes codes = codes_at(*course, terms_at(x, y, width, height));
            const auto light = [](double code) {
                return linear_from_srgb(static_cast<float>(std::clamp(code / 255, 0.0, 1.0)));
            };
            result(x, y) = {light(codes(0)), light(codes(1)), light(codes(2))};
        }
    }
    return result;
}

}  // namespace rs::capture
