// FORMAT.md, "Masks".

#include "tests/reference/decoder/reference_contexts.hpp"
#include "tests/reference/decoder/reference_tile.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace rs::reference {

void TileDecoder::read_mask(const Part& part, int x, int y) {
    const AlphaClass alpha = block_at(x, y).alpha;
    for (int sy = y; sy < y + 8; ++sy) {
        for (int sx = x; sx < x + 8; ++sx) {
            int mask = alpha == AlphaClass::kOpaque ? 1 : 0;
            if (alpha == AlphaClass::kMixed) {
                const int n = level_in_tile(sx, sy - 1);
                const int ne = sx == x + 7 ? n : level_in_tile(sx + 1, sy - 1);
                const int before = level_in_tile(sx - 1, sy) + 2 * n + 4 * level_in_tile(sx - 1, sy - 1) + 8 * ne +
                                   16 * level_in_tile(sx - 2, sy) + 32 * level_in_tile(sx, sy - 2);
                mask = bits_.bit(kMask + 64 * mask_from(part.source, part.vector, sx, sy) + before);
            }
            levels_[static_cast<std::size_t>(sy * width_ + sx)] = mask;
        }
    }
}

int TileDecoder::mask_from(Source source, const std::array<Vector, 2>& vector, int x, int y) const {
    if (source == Source::kIntra) return 0;
    const int s = shown_alpha(source, vector, x, y);
    if (s == 0) return 1;
    if (s == 255) return 7;
    int from = 2;
    for (const int end : {64, 112, 144, 192}) from += s >= end ? 1 : 0;
    return from;
}

int TileDecoder::shown_alpha(Source source, const std::array<Vector, 2>& vector, int x, int y) const {
    const auto of_reference = [&](std::size_t r) {
        const auto [mx, my] = vector[r];
        const int f = mx & 3;
        const int g = my & 3;
        int sum = 0;
        for (int j = 0; j < 2; ++j) {
            for (int i = 0; i < 2; ++i) {
                sum += (i == 0 ? 4 - f : f) * (j == 0 ? 4 - g : g) *
                       nearest_sample(*references_[r], 3, tile_x_ + x + (mx >> 2) + i, tile_y_ + y + (my >> 2) + j);
            }
        }
        return (sum + 8) >> 4;
    };
    if (source == Source::kBoth) return (of_reference(0) + of_reference(1) + 1) >> 1;
    return of_reference(source == Source::kFirst ? 0 : 1);
}

int TileDecoder::mask_sum(int x, int y) const {
    int sum = 0;
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            const int inside_x = std::clamp(x + i, 0, width_ - 1);
            const int inside_y = std::clamp(y + j, 0, height_ - 1);
            sum += (i == 0 ? 2 : 1) * (j == 0 ? 2 : 1) * level_in_tile(inside_x, inside_y);
        }
    }
    return sum;
}

void TileDecoder::make_alpha() {
    for (int y = 0; y < height_; y += 8) {
        for (int x = 0; x < width_; x += 8) {
            const Block& block = block_at(x, y);
            if (block.source == Source::kNone) continue;
            if (code_.alpha_bits == 1) {
                make_smooth_alpha(x, y);
            } else if (block.alpha == AlphaClass::kMixed) {
                read_depths(x, y);
            } else {
                for (int i = 0; i < 64; ++i) {
                    sample(image_, 3, tile_x_ + x + i % 8, tile_y_ + y + i / 8) =
                        block.alpha == AlphaClass::kOpaque ? 255 : 0;
                }
            }
        }
    }
}

void TileDecoder::make_smooth_alpha(int block_x, int block_y) {
    for (int y = block_y; y < block_y + 8; ++y) {
        for (int x = block_x; x < block_x + 8; ++x) {
            const bool is_in = level_in_tile(x, y) == 1;
            const int c = is_in ? 16 - mask_sum(x, y) : mask_sum(x, y);
            const int off = c == 0 ? 0 : code_.edge_alpha.at(static_cast<std::size_t>((is_in ? 12 : 0) + c - 1));
            sample(image_, 3, tile_x_ + x, tile_y_ + y) = static_cast<std::uint8_t>(is_in ? 255 - off : off);
        }
    }
}

void TileDecoder::read_depths(int block_x, int block_y) {
    const Block& block = block_at(block_x, block_y);
    const auto depth_at = [&](int x, int y) {
        return x < 0 || y < 0 ? 0 : depths_[static_cast<std::size_t>(y * width_ + x)];
    };
    for (int y = block_y; y < block_y + 8; ++y) {
        for (int x = block_x; x < block_x + 8; ++x) {
            const int n = (depth_at(x - 1, y) != 0 ? 1 : 0) + (depth_at(x, y - 1) != 0 ? 1 : 0);
            int p = 0;
            if (block.source != Source::kIntra) {
                const int s = shown_alpha(block.source, block.vector, x, y);
                p = s < 32 || s > 223 ? 1 : 2;
            }
            const int mask = level_in_tile(x, y);
            const int sum = mask_sum(x, y);
            const int depth = code_.alpha_coding == 1 ? bits_.bit(kInner + ((n * 3 + p) * 2 + mask) * 17 + sum)
                                                      : read_difference(x, y, p, sum);
            depths_[static_cast<std::size_t>(y * width_ + x)] = depth;
            const int level = mask == 1 ? full_ - depth : depth;
            sample(image_, 3, tile_x_ + x, tile_y_ + y) = static_cast<std::uint8_t>((255 * level + full_ / 2) / full_);
        }
    }
}

int TileDecoder::read_difference(int x, int y, int p, int sum) {
    const int mask = level_in_tile(x, y);
    const int most = (1 << (code_.alpha_bits - 1)) - 1;
    // "the depth of a sample with the same mask, most of one with the other mask"
    const auto seen = [&](int dx, int dy) {
        if (level_in_tile(x + dx, y + dy) != mask) return most;
        return depths_[static_cast<std::size_t>((y + dy) * width_ + x + dx)];
    };
    int w = 0;
    int n = 0;
    int nw = 0;
    if (x > 0 && y > 0) {
        w = seen(-1, 0);
        n = seen(0, -1);
        nw = seen(-1, -1);
    } else if (x > 0) {
        w = n = nw = seen(-1, 0);
    } else if (y > 0) {
        w = n = nw = seen(0, -1);
    }
    const std::array<int, 3> three = {w, n, w + n - nw};
    const int guess = three[0] + three[1] + three[2] - std::ranges::max(three) - std::ranges::min(three);
    const int difference = std::abs(w - nw) + std::abs(n - nw);
    int a = 5;
    for (const int end : {0, 1, 2, 4, 8}) a -= difference <= end ? 1 : 0;
    const int e = sum == 16 * mask ? 0 : 1;
    if (bits_.bit(kDepthOff + 12 * p + 6 * e + a) == 0) return guess;
    int below = 0;
    if (guess == most) {
        below = 1;
    } else if (guess != 0) {
        below = bits_.bit(kDepthBelow + 6 * e + a);
    }
    const int distance = 1 + bits_.number(kDepthClass + 8 * e, code_.alpha_bits - 1, kDepthTop + 8 * e);
    return std::clamp(below == 1 ? guess - distance : guess + distance, 0, most);
}

}  // namespace rs::reference
