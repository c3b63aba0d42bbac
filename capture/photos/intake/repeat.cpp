#include "capture/photos/intake/repeat.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace rs::capture {
namespace {

constexpr double kMaxRatio = 0.4;

int on_black(std::uint8_t code, std::uint8_t alpha) {
    return code * alpha / 255;
}

}  // namespace

double mean_difference(ConstImageView<Rgba8> a, ConstImageView<Rgba8> b) {
    RS_CHECK(a.width() == b.width() && a.height() == b.height());
    if (a.empty()) return 0;
    std::int64_t sum = 0;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) {
            const Rgba8& p = a(x, y);
            const Rgba8& q = b(x, y);
            sum += std::abs(on_black(p.r, p.a) - on_black(q.r, q.a)) +
                   std::abs(on_black(p.g, p.a) - on_black(q.g, q.a)) +
                   std::abs(on_black(p.b, p.a) - on_black(q.b, q.a)) + std::abs(p.a - q.a);
        }
    }
    return static_cast<double>(sum) / (4.0 * a.width() * a.height());
}

RepeatDetection detect_repeat(std::span<const Image<Rgba8>> turn) {
    RepeatDetection result;
    if (turn.size() < 4) return result;
    const std::size_t last = turn.size() - 1;
    result.first_to_last = mean_difference(turn[0], turn[last]);
    result.neighbours = std::min(mean_difference(turn[0], turn[1]), mean_difference(turn[last - 1], turn[last]));
    result.last_repeats_first = result.first_to_last < kMaxRatio * result.neighbours;
    return result;
}

}  // namespace rs::capture
