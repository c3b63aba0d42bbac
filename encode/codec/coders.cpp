#include "encode/codec/coders.hpp"

#include "rayspace/codec/syntax.hpp"

#include <cmath>

namespace rs::encode {

CostTable::CostTable(const Probabilities& probabilities) {
    namespace context = codec::context;
    for (std::size_t c = 0; c < probabilities.size(); ++c) {
        const double zero = probabilities[c] / 4096.0;
        bits_[2 * c] = static_cast<float>(-std::log2(zero));
        bits_[2 * c + 1] = static_cast<float>(-std::log2(1 - zero));
    }
    for (int kind = 0; kind < context::kBlockKinds; ++kind) {
        for (int band = 0; band < context::kBands; ++band) {
            for (int near = 0; near < context::kNearSums; ++near) {
                for (const bool must_be : {false, true}) {
                    LevelCosts& row = levels_[level_row(kind, band, near, must_be)];
                    for (int level = must_be ? 1 : 0; level < kTabled; ++level) {
                        row[static_cast<std::size_t>(level)] = large_level(kind, band, near, must_be, level);
                    }
                }
            }
        }
        const int size = (kind & 2) != 0 ? codec::kMacroblock : codec::kBlock;
        for (int place = 0; place < size * size; ++place) {
            CostEstimator estimator(*this);
            codec::syntax::last_place(estimator, kind, size, place);
            last_[static_cast<std::size_t>(kPlaces * kind + place)] = estimator.bits();
        }
    }
}

float CostTable::large_level(int kind, int band, int near, bool must_be, int magnitude) const {
    CostEstimator estimator(*this);
    if (codec::syntax::magnitude(estimator, kind, band, near, must_be, magnitude) != 0) estimator.raw(0);
    return estimator.bits();
}

}  // namespace rs::encode
