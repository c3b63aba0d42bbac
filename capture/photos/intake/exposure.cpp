#include "capture/photos/intake/exposure.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kMin_code = 40;
constexpr int kMax_code = 248;            // above: clipped
constexpr double kMaxGridPixels = 20000;  // per image, approximately
constexpr double kMinValues = 50;
constexpr double kMinValidShare = 0.3;  // a white background is clipped: its few grey pixels are shadows

float median_gain(std::vector<float>& values, double sampled) {
    if (static_cast<double>(values.size()) < std::max(kMinValues, kMinValidShare * sampled)) return 1;
    return std::clamp(median(std::move(values)), 0.5F, 2.0F);
}

}  // namespace

LinearRgb exposure_gain(ConstImageView<Rgba8> photo, ConstImageView<LinearRgb> plate,
                        ConstImageView<std::uint8_t> still) {
    RS_CHECK(photo.width() == plate.width() && photo.height() == plate.height());
    RS_CHECK(photo.width() == still.width() && photo.height() == still.height());
    const int step_px =
        std::max(1, static_cast<int>(std::sqrt(static_cast<double>(photo.width()) * photo.height() / kMaxGridPixels)));
    double sampled = 0;
    std::vector<float> r;
    std::vector<float> g;
    std::vector<float> b;
    const auto add = [](std::vector<float>& ratios, std::uint8_t code, float plate_light) {
        if (code < kMin_code || code > kMax_code || plate_light <= 0) return;
        ratios.push_back(linear_from_srgb8(code) / plate_light);
    };
    for (int y = step_px / 2; y < photo.height(); y += step_px) {
        for (int x = step_px / 2; x < photo.width(); x += step_px) {
            if (still(x, y) == 0) continue;
            sampled += 1;
            add(r, photo(x, y).r, plate(x, y).r);
            add(g, photo(x, y).g, plate(x, y).g);
            add(b, photo(x, y).b, plate(x, y).b);
        }
    }
    return {median_gain(r, sampled), median_gain(g, sampled), median_gain(b, sampled)};
}

std::array<std::uint8_t, 256> exposure_division_table(float gain) {
    std::array<std::uint8_t, 256> codes{};
    for (std::size_t code = 0; code < codes.size(); ++code) {
        codes[code] = srgb8_from_linear(linear_from_srgb8(static_cast<std::uint8_t>(code)) / gain);
    }
    codes[255] = 255;
    return codes;
}

}  // namespace rs::capture
