#pragma once
// The sRGB transfer curve (IEC 61966-2-1), exact and by table.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace rs {

inline float linear_from_srgb(float encoded) {
    return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

inline float srgb_from_linear(float linear) {
    return linear <= 0.0031308F ? linear * 12.92F : 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F;
}

/// Linear value of an 8-bit code, by table.
inline float linear_from_srgb8(std::uint8_t code) {
    static const std::array<float, 256> kTable = [] {
        std::array<float, 256> table{};
        for (int i = 0; i < 256; ++i)
            table[static_cast<std::size_t>(i)] = linear_from_srgb(static_cast<float>(i) / 255.0F);
        return table;
    }();
    return kTable[code];
}

/// The nearest code; values outside of 0..1 are clamped, NaN gives 0.
inline std::uint8_t srgb8_from_linear(float linear) {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 255;
    return static_cast<std::uint8_t>(std::lround(srgb_from_linear(linear) * 255.0F));
}

namespace detail {

/// Thresholds of the codes: the least linear value that is rounded to each code or a higher one.
struct CodeThresholds {
    static constexpr int kBins = 4096;            // bins of 0..1; a bin is narrower than a code even at the dark end
    std::array<float, 257> least{};               // [code]; the last is never reached
    std::array<std::uint8_t, kBins + 1> first{};  // [bin]: the code of the bin's lower end
};
const CodeThresholds& code_thresholds();

}  // namespace detail

/// The nearest code; values outside of 0..1 are clamped, NaN gives 0. Equal to srgb8_from_linear(), in a tenth of
/// the time, for many pixels.
inline std::uint8_t srgb8_by_table(float linear) {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 255;
    static const detail::CodeThresholds& thresholds = detail::code_thresholds();
    std::size_t code = thresholds.first[static_cast<std::size_t>(linear * detail::CodeThresholds::kBins)];
    while (linear >= thresholds.least[code + 1]) ++code;
    return static_cast<std::uint8_t>(code);
}

}  // namespace rs
