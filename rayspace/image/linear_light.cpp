#include "rayspace/image/linear_light.hpp"

#include <bit>
#include <cstdint>
#include <limits>

namespace rs::detail {
namespace {

// Binary search over bit patterns: positive floats are in the order of their bits.
float least_with_code(std::uint8_t code) {
    std::uint32_t below = 0;
    auto reached = std::bit_cast<std::uint32_t>(1.0F);
    while (reached - below > 1) {
        const std::uint32_t middle = below + (reached - below) / 2;
        (srgb8_from_linear(std::bit_cast<float>(middle)) >= code ? reached : below) = middle;
    }
    return std::bit_cast<float>(reached);
}

}  // namespace

const CodeThresholds& code_thresholds() {
    static const CodeThresholds kThresholds = [] {
        CodeThresholds made;
        for (std::size_t code = 1; code < 256; ++code)
            made.least[code] = least_with_code(static_cast<std::uint8_t>(code));
        made.least[256] = std::numeric_limits<float>::infinity();
        for (std::size_t bin = 0; bin < made.first.size(); ++bin) {
            made.first[bin] = srgb8_from_linear(static_cast<float>(bin) / CodeThresholds::kBins);
        }
        return made;
    }();
    return kThresholds;
}

}  // namespace rs::detail
