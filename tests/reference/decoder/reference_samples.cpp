#include "tests/reference/decoder/reference_samples.hpp"

#include <algorithm>
#include <array>

namespace rs::reference {
namespace {

constexpr int kWeights[4][8] = {
    {0, 0, 0, 64, 0, 0, 0, 0},
    {-1, 4, -10, 58, 17, -5, 1, 0},
    {-1, 4, -11, 40, 40, -11, 4, -1},
    {0, 1, -5, 17, 58, -10, 4, -1},
};

int clamp8(int value) {
    return std::clamp(value, 0, 255);
}

int clamp16(std::int64_t value) {
    return static_cast<int>(std::clamp<std::int64_t>(value, -32768, 32767));
}

// D[row][column] of n x n: 64, 90, 89 ... are 64 sqrt(2) cos(i pi / 32) as HEVC rounds them.
int matrix(int n, int row, int column) {
    static constexpr std::array<int, 17> kCosines = {64, 90, 89, 87, 83, 80, 75, 70, 64, 57, 50, 43, 36, 25, 18, 9, 0};
    if (row == 0) return 64;
    int angle = (2 * column + 1) * row * (16 / n) % 64;  // 64ths of a turn
    if (angle > 32) angle = 64 - angle;
    return angle <= 16 ? kCosines[static_cast<std::size_t>(angle)] : -kCosines[static_cast<std::size_t>(32 - angle)];
}

}  // namespace

int nearest_sample(const DecodedImage& image, int plane, int x, int y) {
    const int inside_x = std::clamp(x, 0, image.width - 1);
    const int inside_y = std::clamp(y, 0, image.height - 1);
    return image.planes[static_cast<std::size_t>(plane)][static_cast<std::size_t>(inside_y * image.width + inside_x)];
}

Square predict_from_reference(const DecodedImage& reference, int plane, int x, int y, int n, Vector vector) {
    Square part(n);
    for (int py = 0; py < n; ++py) {
        for (int px = 0; px < n; ++px) {
            int sum = 0;
            for (int j = 0; j < 8; ++j) {
                for (int i = 0; i < 8; ++i) {
                    sum += kWeights[vector.x & 3][i] * kWeights[vector.y & 3][j] *
                           nearest_sample(reference, plane, x + px + (vector.x >> 2) + i - 3,
                                          y + py + (vector.y >> 2) + j - 3);
                }
            }
            part.at(px, py) = clamp8((sum + 2048) >> 12);
        }
    }
    return part;
}

Square predict_from_neighbours(const DecodedImage& image, int plane, int x, int y, int n, int mode, bool has_left,
                               bool has_upper) {
    std::vector<int> l(static_cast<std::size_t>(n), 128);
    std::vector<int> t(static_cast<std::size_t>(n), 128);
    int c = 128;
    for (int i = 0; i < n; ++i) {
        if (has_left) l[static_cast<std::size_t>(i)] = nearest_sample(image, plane, x - 1, y + i);
        if (has_upper) t[static_cast<std::size_t>(i)] = nearest_sample(image, plane, x + i, y - 1);
    }
    if (has_left && has_upper) {
        c = nearest_sample(image, plane, x - 1, y - 1);
    } else if (has_upper) {
        c = t[0];
        std::fill(l.begin(), l.end(), t[0]);
    } else if (has_left) {
        c = l[0];
        std::fill(t.begin(), t.end(), l[0]);
    }

    // "E(2 i) is c for i = 0, t[i - 1] for i > 0 and l[-i - 1] for i < 0; E(2 i + 1) is (E(2 i) + E(2 i + 2) + 1) >> 1"
    const auto edge = [&](int at) {
        const auto whole = [&](int i) {
            if (i == 0) return c;
            return i > 0 ? t.at(static_cast<std::size_t>(i - 1)) : l.at(static_cast<std::size_t>(-i - 1));
        };
        const int i = at >> 1;
        return (at & 1) == 0 ? whole(i) : (whole(i) + whole(i + 1) + 1) >> 1;
    };

    int sum = n;
    for (int i = 0; i < n; ++i) sum += l[static_cast<std::size_t>(i)] + t[static_cast<std::size_t>(i)];
    const int l_end = l.back();
    const int t_end = t.back();

    Square part(n);
    for (int py = 0; py < n; ++py) {
        for (int px = 0; px < n; ++px) {
            const int lv = l[static_cast<std::size_t>(py)];
            const int tv = t[static_cast<std::size_t>(px)];
            const int across = 2 * (px + 1) - (py + 1);  // h of mode 6
            const int down = 2 * (py + 1) - (px + 1);    // h of mode 7
            int& s = part.at(px, py);
            switch (mode) {
                case 0:
                    s = sum / (2 * n);
                    break;
                case 1:
                    s = ((n - 1 - px) * lv + (px + 1) * t_end + (n - 1 - py) * tv + (py + 1) * l_end + n) / (2 * n);
                    break;
                case 2:
                    s = tv;
                    break;
                case 3:
                    s = lv;
                    break;
                case 4:
                    s = clamp8(lv + tv - c);
                    break;
                case 5:
                    s = edge(2 * (px - py));
                    break;
                case 6:
                    s = across >= 0 ? edge(across) : edge(2 * across);
                    break;
                default:
                    s = down >= 0 ? edge(-down) : edge(-2 * down);
                    break;
            }
        }
    }
    return part;
}

int quantiser_step(int step_index) {
    static constexpr int kSteps[8] = {16, 17, 19, 21, 23, 25, 27, 29};  // M
    return kSteps[step_index % 8] * (1 << (step_index / 8));
}

Square residual(const Square& levels, int step_index) {
    const int n = levels.n;
    const std::int64_t q = quantiser_step(step_index);

    Square coefficients(n);
    for (int v = 0; v < n; ++v) {
        for (int u = 0; u < n; ++u) {
            const std::int64_t product = levels.at(u, v) * q;
            coefficients.at(u, v) = clamp16(n == 8 ? product : (product + 1) >> 1);
        }
    }
    Square f(n);
    for (int y = 0; y < n; ++y) {
        for (int u = 0; u < n; ++u) {
            std::int64_t sum = 64;
            for (int v = 0; v < n; ++v) sum += matrix(n, v, y) * static_cast<std::int64_t>(coefficients.at(u, v));
            f.at(u, y) = clamp16(sum >> 7);
        }
    }
    Square r(n);
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            std::int64_t sum = 2048;
            for (int u = 0; u < n; ++u) sum += matrix(n, u, x) * static_cast<std::int64_t>(f.at(u, y));
            r.at(x, y) = clamp16(sum >> 12);
        }
    }
    return r;
}

}  // namespace rs::reference
