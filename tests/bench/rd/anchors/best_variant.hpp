#pragma once
// Selects the best variant of a codec on a set: the one with the lowest rates.

#include "tests/bench/rd/curve.hpp"

#include <string>
#include <vector>

namespace rs::bench {

struct ChosenCurve {
    std::string codec;
    std::string variant;              // best variant
    std::vector<Measurement> points;  // measurements of this variant
    RateCurve curve;
    struct Rejected {
        std::string variant;
        double rate_ratio = 1;  // mean rate over that of the best variant at equal dB
        std::vector<Measurement> points;
    };
    std::vector<Rejected> rejected;
};

/// \param measured measurements of one set
/// \return one curve per codec, in order of first appearance. Variants that were only probed, with fewer points than
/// others of their codec, are rejected.
std::vector<ChosenCurve> best_variants(const std::vector<Measurement>& measured);

const ChosenCurve* find_curve(const std::vector<ChosenCurve>& curves, const std::string& codec);

}  // namespace rs::bench
