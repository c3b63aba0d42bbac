#include "engine/core/definition/mix_rings.hpp"

#include "rayspace/base/result.hpp"

namespace rs::engine {
namespace {

int share_of_second(const Rgba8& second, int weight_q8) {
    return second.a * weight_q8;
}

int share_of_nearest(const Rgba8& nearest, int weight_q8) {
    return nearest.a * (256 - weight_q8);
}

}  // namespace

Rgba8 mix_pixels(const Rgba8& nearest, const Rgba8& second, int weight_q8) {
    const int n = share_of_nearest(nearest, weight_q8);
    const int s = share_of_second(second, weight_q8);
    const int alpha = (n + s + 128) >> 8;
    if (alpha == 0) return {};
    const auto channel = [&](int of_nearest, int of_second) {
        return static_cast<std::uint8_t>((of_nearest * n + of_second * s + (n + s) / 2) / (n + s));
    };
    return {channel(nearest.r, second.r), channel(nearest.g, second.g), channel(nearest.b, second.b),
            static_cast<std::uint8_t>(alpha)};
}

void mix_rings(ImageView<Rgba8> nearest, ImageView<std::int32_t> depth_q20, ConstImageView<Rgba8> second,
               ConstImageView<std::int32_t> second_depth_q20, int weight_q8) {
    RS_CHECK(nearest.width() == second.width() && nearest.height() == second.height());
    RS_CHECK(depth_q20.empty() == second_depth_q20.empty());
    for (int j = 0; j < nearest.height(); ++j) {
        for (int i = 0; i < nearest.width(); ++i) {
            const Rgba8 n = nearest(i, j);
            const Rgba8 s = second(i, j);
            nearest(i, j) = mix_pixels(n, s, weight_q8);
            if (depth_q20.empty()) continue;
            const bool is_second = share_of_second(s, weight_q8) > share_of_nearest(n, weight_q8);
            if (is_second) depth_q20(i, j) = second_depth_q20(i, j);
            if (nearest(i, j).a == 0) depth_q20(i, j) = 0;
        }
    }
}

}  // namespace rs::engine
