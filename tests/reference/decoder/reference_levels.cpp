// FORMAT.md, "Coefficients" and "Alpha".

#include "tests/reference/decoder/reference_tile.hpp"

#include "tests/reference/decoder/reference_contexts.hpp"

#include <algorithm>
#include <cstdlib>

namespace rs::reference {

// Coefficients
Square TileDecoder::read_coefficients(int n, int kind) {
    struct Place {
        int u, v;
    };
    std::vector<Place> order;
    for (int sum = 0; sum <= 2 * (n - 1); ++sum) {
        for (int v = 0; v < n; ++v) {
            if (sum - v >= 0 && sum - v < n) order.push_back({sum - v, v});
        }
    }
    Square levels(n);
    const auto counted = [&](int u, int v) { return u < n && v < n ? std::min(std::abs(levels.at(u, v)), 3) : 0; };

    std::vector<SignlessLevel> group;  // of 16 positions; with hidden signs only
    const int last = bits_.number(kLastClass + 8 * kind, n == 8 ? 6 : 8, kLastTop + 9 * kind);
    for (int place = last; place >= 0; --place) {
        const auto [u, v] = order.at(static_cast<std::size_t>(place));
        const int sum =
            counted(u + 1, v) + counted(u + 2, v) + counted(u, v + 1) + counted(u, v + 2) + counted(u + 1, v + 1);
        const int near = std::min((sum + 1) >> 1, 4);
        const int d = n == 8 ? u + v : (u + v + 1) >> 1;
        const int band = u + v == 0 ? 0 : d <= 2 ? 1 : d <= 5 ? 2 : 3;
        if (place == last || bits_.bit(kNonZero + (kind * 4 + band) * 5 + near) == 1) {
            int& level = levels.at(u, v);
            level = read_magnitude(kind, u + v == 0 ? 1 : 0, near);
            if (code_.has_sign_data_hiding) {
                group.push_back({place, &level});
            } else if (bits_.raw() == 1) {
                level = -level;
            }
        }
        // "The signs of a group stand behind what is read for its lowest place", also where the level there is 0.
        if (place % 16 == 0) {
            read_sign_data_hiding(group);
            group.clear();
        }
    }
    return levels;
}

int TileDecoder::read_magnitude(int kind, int e, int near) {
    if (bits_.bit(kAboveOne + (kind * 2 + e) * 5 + near) == 0) return 1;
    if (bits_.bit(kAboveTwo + (kind * 2 + e) * 5 + near) == 0) return 2;
    int length = 1;
    while (length < 14 && bits_.bit(kRestClass + 14 * kind + length - 1) == 1) ++length;
    int rest = 1;
    for (int i = 1; i < length; ++i) rest = 2 * rest + bits_.raw();
    return 2 + rest;
}

// "raw bits, 1 for negative, of its levels that are not zero, in the order in which their magnitudes were read"
void TileDecoder::read_sign_data_hiding(const std::vector<SignlessLevel>& group) {
    if (group.empty()) return;
    int sum = 0;
    for (const SignlessLevel& each : group) sum += *each.level;
    // "If the first and the last of these lie 4 places or more apart, the last one has no such bit": the first one is
    // at the highest place.
    const bool is_last_hidden = group.front().place - group.back().place >= 4;
    for (std::size_t i = 0; i < group.size(); ++i) {
        const bool is_hidden = is_last_hidden && i + 1 == group.size();
        const bool is_negative = is_hidden ? sum % 2 == 1 : bits_.raw() == 1;
        if (is_negative) *group[i].level = -*group[i].level;
    }
}

// Alpha
int TileDecoder::level_in_tile(int x, int y) const {
    return x < 0 || y < 0 ? 0 : levels_[static_cast<std::size_t>(y * width_ + x)];
}

int TileDecoder::kind(int level) const {
    return level == 0 ? 0 : level == full_ ? 2 : 1;
}

void TileDecoder::read_alpha(const Part& part, int x, int y) {
    const AlphaClass alpha = block_at(x, y).alpha;
    for (int sy = y; sy < y + 8; ++sy) {
        for (int sx = x; sx < x + 8; ++sx) {
            int level = alpha == AlphaClass::kOpaque ? full_ : 0;
            if (alpha == AlphaClass::kMixed) level = read_mixed_level(part, x, sx, sy);
            levels_[static_cast<std::size_t>(sy * width_ + sx)] = level;
            sample(image_, 3, tile_x_ + sx, tile_y_ + sy) =
                static_cast<std::uint8_t>((255 * level + full_ / 2) / full_);
        }
    }
}

int TileDecoder::read_mixed_level(const Part& part, int block_x, int x, int y) {
    const int left = level_in_tile(x - 1, y);
    const int upper = level_in_tile(x, y - 1);
    const int upper_right = x == block_x + 7 ? upper : level_in_tile(x + 1, y - 1);
    const int m = 27 * kind(left) + 9 * kind(upper) + 3 * kind(level_in_tile(x - 1, y - 1)) + kind(upper_right);

    int from = 0;
    if (part.source != Source::kIntra) {
        const std::size_t r = uses(part.source, 0) ? 0 : 1;
        const Vector vector = part.vector[r];
        const int s = nearest_sample(*references_[r], 3, tile_x_ + x + ((vector.x + 2) >> 2),
                                     tile_y_ + y + ((vector.y + 2) >> 2));
        from = 1 + kind((s * full_ + 127) / 255);
    }
    if (bits_.bit(kAlphaZero + 81 * from + m) == 0) return 0;
    if (code_.alpha_bits == 1) return 1;
    if (bits_.bit(kAlphaFull + 81 * from + m) == 0) return full_;
    const int k = 3 * (left + upper) / (2 * full_ + 1);
    return bits_.tree(kAlphaBetween + 16 * k, code_.alpha_bits);
}

}  // namespace rs::reference
