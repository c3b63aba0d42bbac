#pragma once
// Rate-distortion curve of one codec on one set, and the comparison of two curves.

#include "tests/bench/rd/coded.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rs::bench {

struct Measurement {
    std::string set;
    std::string codec;    // name of the curve
    std::string variant;  // mode of the codec, if several were tried for the same curve; may be empty
    std::string setting;  // point on the curve: quality, block size
    std::uint64_t bytes = 0;
    double bpp = 0;
    double psnr_db = 0;
    std::optional<double> alpha_mae;  // for codecs that store alpha
};

Measurement measurement_of(const ReferenceImages& images, const std::string& codec, const std::string& variant,
                           const std::string& setting, const Coded& coded);

/// Pareto-optimal points by increasing dB: points that cost more than a better point are dropped.
class RateCurve {
public:
    RateCurve() = default;
    explicit RateCurve(const std::vector<Measurement>& points);

    /// The logarithm of the rate is interpolated linearly in dB; nullopt outside of the points.
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

/// Geometric mean of a's rate over b's at equal dB, over the common range of dB; nullopt if it is empty.
std::optional<double> mean_rate_ratio(const RateCurve& a, const RateCurve& b);

}  // namespace rs::bench
