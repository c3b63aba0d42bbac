#include "encode/report/ray_map_image.hpp"

#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace rs::encode {
namespace {

constexpr int kAcross_px = 512;
constexpr int kDown_px = 4096;
constexpr float kDarker = 0.7F;

// Fully saturated colour; `turns` 0..1 round the circle from red.
std::array<float, 3> saturated_colour(float turns) {
    std::array<float, 3> rgb{};
    for (std::size_t c = 0; c < 3; ++c) {
        const float from_peak = std::abs(std::remainder(turns - static_cast<float>(c) / 3, 1.0F));
        rgb[c] = std::clamp(2 - 6 * from_peak, 0.0F, 1.0F);
    }
    return rgb;
}

// [view of the object]; transparent for views of other rings.
std::vector<Rgba8> colours_of_views(const Ring& ring) {
    const std::uint16_t last = ring.views.empty() ? std::uint16_t{0} : *std::ranges::max_element(ring.views);
    std::vector<Rgba8> colours(std::size_t{last} + 1);
    for (std::size_t n = 0; n < ring.views.size(); ++n) colours[ring.views[n]] = ray_map_colour(n, ring.views.size());
    return colours;
}

}  // namespace

Rgba8 ray_map_colour(std::size_t place, std::size_t count) {
    const auto rgb = saturated_colour(static_cast<float>(place) / static_cast<float>(count));
    const float light = place % 2 == 0 ? 1.0F : kDarker;
    const auto byte = [&](std::size_t c) { return static_cast<std::uint8_t>(std::lround(255 * light * rgb[c])); };
    return {byte(0), byte(1), byte(2), 255};
}

Result<Image<Rgba8>> ray_map_image(const Ring& ring, std::optional<int> plane) {
    if (plane && (*plane < 0 || *plane >= ring.planes)) {
        return Error{"plane " + std::to_string(*plane) + ": the ring has planes 0 to " +
                     std::to_string(ring.planes - 1)};
    }
    const int first = plane.value_or(0);
    const int rows = (plane ? 1 : ring.planes) * ring.u_cells;
    const int side = std::max(1, std::min(kAcross_px / ring.x_cells, kDown_px / rows));  // px of a drawn cell
    const int step = (std::max(rows, ring.x_cells) + kMaxImageSide_px - 1) / kMaxImageSide_px;
    const std::vector<Rgba8> colours = colours_of_views(ring);
    const auto drawn = [&](int cells) { return (cells + step - 1) / step * side; };
    Image<Rgba8> image(drawn(ring.x_cells), drawn(rows));
    for (int y = 0; y < image.height(); ++y) {
        const int row = y / side * step;
        const int k = first + row / ring.u_cells;
        const int ui = ring.u_cells - 1 - row % ring.u_cells;
        for (int x = 0; x < image.width(); ++x) {
            const std::uint16_t view = ring.cells[ring.cell_index(k, x / side * step, ui)];
            if (view < colours.size()) image(x, y) = colours[view];  // else kNoImage
        }
    }
    return image;
}

}  // namespace rs::encode
