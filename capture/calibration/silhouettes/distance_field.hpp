#pragma once
// Signed distance field of one view's silhouette, tiled so that a bilinear lookup rarely touches more than one cache
// line: ray probing reads the fields of all views at scattered positions and is bound by memory, not by arithmetic.
//
// Samples are 16-bit integers in units of 1/128 px, in tiles of 8x4 (64 bytes), row by row: sample (x, y) has index (y
// / 4 * across + x / 8) * 32 + y % 4 * 8 + x % 8, `across` being the number of tiles in a row.

#include "rayspace/image/image.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rs::capture {

class DistanceField {
public:
    /// `distance_px` has at least 2x2 samples. Distances beyond the 16-bit range (256 px) are clamped.
    explicit DistanceField(ConstImageView<float> distance_px);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    /// Bilinear interpolation; `x` in 0..width - 1, `y` in 0..height - 1, sample 0 at 0.
    [[nodiscard]] float at(float x, float y) const {
        const int left = static_cast<int>(x) < width_ - 1 ? static_cast<int>(x) : width_ - 2;
        const int top = static_cast<int>(y) < height_ - 1 ? static_cast<int>(y) : height_ - 2;
        const float u = x - static_cast<float>(left);
        const float v = y - static_cast<float>(top);
        const std::int16_t* const samples = tiles_.front().data();
        const std::int16_t* const upper = samples + row(top);
        const std::int16_t* const lower = samples + row(top + 1);
        const std::size_t before = column(left), behind = column(left + 1);
        const float a = between(upper[before], upper[behind], u);
        const float b = between(lower[before], lower[behind], u);
        return (a + v * (b - a)) * kPxPerUnit;
    }

private:
    static constexpr std::size_t kTileWidth = 8, kTileHeight = 4;
    static constexpr float kPxPerUnit = 1.0F / 128;
    struct alignas(64) Tile : std::array<std::int16_t, kTileWidth * kTileHeight> {};

    static float between(std::int16_t a, std::int16_t b, float share) {
        return static_cast<float>(a) + share * static_cast<float>(b - a);
    }
    static std::size_t column(int x) {
        const auto u = static_cast<std::size_t>(x);
        return u / kTileWidth * (kTileWidth * kTileHeight) + u % kTileWidth;
    }
    [[nodiscard]] std::size_t row(int y) const {
        const auto v = static_cast<std::size_t>(y);
        return v / kTileHeight * row_of_tiles_ + v % kTileHeight * kTileWidth;
    }

    int width_, height_;
    std::size_t row_of_tiles_;  // samples in a row of tiles
    std::vector<Tile> tiles_;
};

}  // namespace rs::capture
