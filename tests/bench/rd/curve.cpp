#include "tests/bench/rd/curve.hpp"

#include <algorithm>
#include <cmath>

namespace rs::bench {

Measurement measurement_of(const ReferenceImages& images, const std::string& codec, const std::string& variant,
                           const std::string& setting, const CodingResult& coded) {
    Measurement measured{images.name, codec, variant, setting, coded.bytes, 0, 0, std::nullopt};
    measured.bpp = images.bits_per_pixel(coded.bytes);
    measured.psnr_db = coded.error.psnr_db();
    if (coded.has_alpha) measured.alpha_mae = coded.error.alpha_mae();
    return measured;
}

RateCurve::RateCurve(const std::vector<Measurement>& points) {
    for (const Measurement& point : points) points_.push_back({point.psnr_db, point.bpp});
    std::sort(points_.begin(), points_.end(), [](const Point& a, const Point& b) {
        return a.psnr_db != b.psnr_db ? a.psnr_db > b.psnr_db : a.bpp < b.bpp;
    });
    std::vector<Point> kept;
    for (const Point& point : points_) {
        if (kept.empty() || point.bpp < kept.back().bpp) kept.push_back(point);
    }
    points_.assign(kept.rbegin(), kept.rend());
}

std::optional<double> RateCurve::bpp_at(double psnr_db) const {
    if (points_.empty() || psnr_db < least_db() || psnr_db > most_db()) return std::nullopt;
    const auto above = std::lower_bound(points_.begin(), points_.end(), psnr_db,
                                        [](const Point& point, double db) { return point.psnr_db < db; });
    if (above == points_.begin()) return above->bpp;
    const Point& a = *(above - 1);
    const Point& b = *above;
    const double share = (psnr_db - a.psnr_db) / (b.psnr_db - a.psnr_db);
    return std::exp((1 - share) * std::log(a.bpp) + share * std::log(b.bpp));
}

std::optional<double> mean_rate_ratio(const RateCurve& a, const RateCurve& b) {
    if (a.empty() || b.empty()) return std::nullopt;
    const double least = std::max(a.least_db(), b.least_db());
    const double most = std::min(a.most_db(), b.most_db());
    if (least > most) return std::nullopt;
    constexpr int kSteps = 64;
    double sum = 0;
    for (int n = 0; n <= kSteps; ++n) {
        const double db = std::min(most, least + (most - least) * n / kSteps);
        sum += std::log(*a.bpp_at(db) / *b.bpp_at(db));
    }
    return std::exp(sum / (kSteps + 1));
}

}  // namespace rs::bench
