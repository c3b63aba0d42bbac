#pragma once
// Rate over quality of one codec on one set, and how two of them compare.

#include "tests/bench/rd/coded.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rs::bench {

struct Measurement {
    std::string set;
    std::string codec;    // the curve it belongs to
    std::string variant;  // how the codec was used, one of several tried for the same curve; may be empty
    std::string setting;  // the point on the curve: quality, block size
    std::uint64_t bytes = 0;
    double bpp = 0;
    double psnr_db = 0;
    std::optional<double> alpha_mae;  // of codecs that store alpha
};

Measurement measurement_of(const ReferenceImages& images, const std::string& codec, const std::string& variant,
                           const std::string& setting, const Coded& coded);

// Points of falling cost only: what costs more than a better point of the same curve is left out. By rising dB.
class RateCurve {
public:
    RateCurve() = default;
    explicit RateCurve(const std::vector<Measurement>& points);

    // Between points the logarithm of the rate is linear in dB; nothing outside of them.
    [[nodiscard]] std::optional<double> bpp_at(double psnr_db) const;
    [[nodiscard]] bool empty() const { return points_.empty(); }
    [[nodiscard]] double least_db() const { return points_.front().psnr_db; }
    [[nodiscard]] double most_db() const { return points_.back().psnr_db; }

    struct Point {
        double psnr_db = 0;
        double bpp = 0;
    };
    [[nodiscard]] const std::vector<Point>& points() const { return points_; }

private:
    std::vector<Point> points_;
};

// Geometric mean of a's rate over b's at equal dB, over the dB that both reach; nothing where there are none.
std::optional<double> mean_rate_ratio(const RateCurve& a, const RateCurve& b);

}  // namespace rs::bench
