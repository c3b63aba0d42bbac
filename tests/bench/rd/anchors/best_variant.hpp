#pragma once
// Of the ways in which a codec was tried on a set, the one that is best for it: the hardest to beat.

#include "tests/bench/rd/curve.hpp"

#include <string>
#include <vector>

namespace rs::bench {

struct ChosenCurve {
    std::string codec;
    std::string variant;              // the best one
    std::vector<Measurement> points;  // of that variant, as measured
    RateCurve curve;
    struct Rejected {
        std::string variant;
        double rate_ratio = 1;  // its mean rate over the best one's at equal dB
        std::vector<Measurement> points;
    };
    std::vector<Rejected> rejected;
};

// One curve per codec of `measured`, which are all of one set; in the order of their first appearance. Variants that
// were only probed, with fewer points than others of their codec, are rejected.
std::vector<ChosenCurve> best_variants(const std::vector<Measurement>& measured);

const ChosenCurve* find_curve(const std::vector<ChosenCurve>& curves, const std::string& codec);

}  // namespace rs::bench
