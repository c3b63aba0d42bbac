#include "rayspace/format/content_coding.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/base/conventions.hpp"

#include <array>
#include <cmath>

namespace rs::line_coding {
namespace {

// A number of the lines, and its model over the planes.
struct Field {
    std::int32_t CapturedLine::*number;
    bool is_sine;  // false: constant
};

constexpr std::array<Field, 4> kFields = {{{&CapturedLine::l0_q20, false},
                                           {&CapturedLine::l1_q30, true},
                                           {&CapturedLine::q0_q16, false},
                                           {&CapturedLine::q1_q16, true}}};
constexpr std::size_t kBytes = sizeof(std::int32_t);
static_assert(kFields.size() * kBytes == kBytesPerLine);

// Predicts a field's numbers from the previous ones, in line order.
class Predictor {
public:
    Predictor(std::span<const CapturedLine> lines, int planes, const Field& field)
        : lines_(lines),
          planes_(static_cast<std::size_t>(planes)),
          field_(field),
          twice_cosine_q30_(std::llround(std::ldexp(std::cos(2 * kPi / planes), 31))) {}

    // Modulo 2^32.
    [[nodiscard]] std::uint32_t at(std::size_t line) const {
        const std::size_t plane = line % planes_;
        if (plane < (field_.is_sine ? 2 : 1)) return line < planes_ ? 0 : modular(number(line - planes_));
        if (!field_.is_sine) return modular(number(line - 1));
        // sin(a + t) + sin(a - t) = 2 cos(t) sin(a)
        const std::int64_t sum = (twice_cosine_q30_ * number(line - 1) + kHalf_q30) >> 30;
        return modular(sum) - modular(number(line - 2));
    }

private:
    static constexpr std::int64_t kHalf_q30 = std::int64_t{1} << 29;

    static std::uint32_t modular(std::int64_t number) { return static_cast<std::uint32_t>(number); }
    [[nodiscard]] std::int32_t number(std::size_t line) const { return lines_[line].*field_.number; }

    std::span<const CapturedLine> lines_;
    std::size_t planes_;
    Field field_;
    std::int64_t twice_cosine_q30_;
};

// 0, -1, 1, -2, ... -> 0, 1, 2, 3, ...
constexpr std::uint32_t folded(std::uint32_t difference) {
    return (difference << 1) ^ (0U - (difference >> 31));
}
constexpr std::uint32_t unfolded(std::uint32_t folded_difference) {
    return (folded_difference >> 1) ^ (0U - (folded_difference & 1U));
}

}  // namespace

std::vector<std::uint8_t> encode_residuals(std::span<const CapturedLine> lines, int planes) {
    std::vector<std::uint8_t> plane(lines.size() * kBytesPerLine);
    std::size_t row = 0;  // rows of lines.size() bytes
    for (const Field& field : kFields) {
        const Predictor predicted(lines, planes, field);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            const std::uint32_t residual = folded(static_cast<std::uint32_t>(lines[i].*field.number) - predicted.at(i));
            for (std::size_t b = 0; b < kBytes; ++b) {
                plane[(row + b) * lines.size() + i] = static_cast<std::uint8_t>(residual >> (8 * b));
            }
        }
        row += kBytes;
    }
    return plane;
}

void decode_residuals(std::span<const std::uint8_t> plane, int planes, std::span<CapturedLine> lines) {
    RS_CHECK(plane.size() == lines.size() * kBytesPerLine);
    std::size_t row = 0;
    for (const Field& field : kFields) {
        const Predictor predicted(lines, planes, field);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            std::uint32_t residual = 0;
            for (std::size_t b = 0; b < kBytes; ++b) {
                residual |= std::uint32_t{plane[(row + b) * lines.size() + i]} << (8 * b);
            }
            lines[i].*field.number = static_cast<std::int32_t>(predicted.at(i) + unfolded(residual));
        }
        row += kBytes;
    }
}

}  // namespace rs::line_coding
