#include "capture/photos/intake/exposure.hpp"

#include "rayspace/base/check.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kDark_code = 40;
constexpr int kClipped_code = 248;
constexpr double kEnoughPixels = 20000;
constexpr double kFewPixels = 50;
constexpr double kFewOfThem = 0.3;  // a white backdrop is clipped: its few grey pixels are shadows

float median_gain(std::vector<float>& values, double asked) {
    if (static_cast<double>(values.size()) < std::max(kFewPixels, kFewOfThem * asked)) return 1;
    return std::clamp(median(std::move(values)), 0.5F, 2.0F);
}

}  // namespace

LinearRgb exposure_gain(ConstImageView<Rgba8> photo, ConstImageView<LinearRgb> plate,
                        ConstImageView<std::uint8_t> still) {
    RS_CHECK(photo.width() == plate.width() && photo.height() == plate.height());
    RS_CHECK(photo.width() == still.width() && photo.height() == still.height());
    const int step_px =
        std::max(1, static_cast<int>(std::sqrt(static_cast<double>(photo.width()) * photo.height() / kEnoughPixels)));
    double asked = 0;
    std::vector<float> r;
    std::vector<float> g;
    std::vector<float> b;
    const auto add = [](std::vector<float>& ratios, std::uint8_t seen, float behind) {
        if (seen < kDark_code || seen > kClipped_code || behind <= 0) return;
        ratios.push_back(linear_from_srgb8(seen) / behind);
    };
    for (int y = step_px / 2; y < photo.height(); y += step_px) {
        for (int x = step_px / 2; x < photo.width(); x += step_px) {
            if (still(x, y) == 0) continue;
            asked += 1;
            add(r, photo(x, y).r, plate(x, y).r);
            add(g, photo(x, y).g, plate(x, y).g);
            add(b, photo(x, y).b, plate(x, y).b);
        }
    }
    return {median_gain(r, asked), median_gain(g, asked), median_gain(b, asked)};
}

}  // namespace rs::capture
