#include "tests/reference/decoder/reference_shape.hpp"

#include "tests/reference/decoder/reference_bits.hpp"
#include "tests/reference/decoder/reference_bytes.hpp"

#include <algorithm>
#include <cmath>

namespace rs::reference {
namespace {

using Bytes = std::span<const std::uint8_t>;

std::uint32_t u32_at(Bytes bytes, std::size_t at) {
    return bytes[at] + 256U * bytes[at + 1] + 65536U * bytes[at + 2] + 16777216U * bytes[at + 3];
}

std::int32_t i32_at(Bytes bytes, std::size_t at) {
    return static_cast<std::int32_t>(u32_at(bytes, at));
}

// "Ranges"
std::string check_numbers(const Shape& shape) {
    const auto [p_half, p_cells_per_unit, h_low, bands_per_unit, reference_distance, reference_height, depth_low,
                depth_step] = shape.numbers;
    const std::int64_t most = std::int64_t{1} << 28;
    if (p_half < 1 << 20 || p_half > (1 << 21) + (1 << 16) - 1) return "p_half_q20";
    const double e = 4096.0 * shape.p_cells / (2 * p_half / 1048576.0);
    if (p_cells_per_unit <= 0 || std::abs(p_cells_per_unit - e) > 1 + e / 1048576.0) return "p_cells_per_unit_q12";
    if (bands_per_unit < 1 || bands_per_unit > 1 << 26) return "bands_per_unit_q12";
    if (h_low <= -most || h_low >= most) return "h_low_q20";
    if (reference_height <= -most || reference_height >= most) return "reference_height_q20";
    if (reference_distance < (1 << 20) + 1 || reference_distance > most - 1) return "reference_distance_q20";
    if (depth_low < -(1 << 21) - (1 << 16) || depth_low > (1 << 21) + (1 << 16)) return "depth_low_q20";
    if (depth_step < 1 || depth_step > 1 << 18) return "depth_step_q24";
    if (shape.jump < 1) return "jump";
    for (const auto& [l2, q2, a, c] : shape.normal) {
        if (l2 < -(1 << 30) || l2 > 1 << 30) return "l2_q30";
        if (q2 <= -(1 << 30) || q2 >= 1 << 30) return "q2_q16";
        if (a <= -most || a >= most || c <= -most || c >= most) return "a_q20 or c_q20";
    }
    return "";
}

// "Cells": the images that show each cell, 0 if it is empty, and its depth.
class Cells {
public:
    Cells(Bytes bytes, std::size_t count, int p_cells, int bands)
        : bits_(bytes), p_cells_(p_cells), bands_(bands), cells_(count) {
        for (std::size_t i = 0; i < count; ++i) {
            cells_[i].shown = read_shown(static_cast<long>(i));
            if (cells_[i].shown != 0) cells_[i].depth = read_depth(static_cast<long>(i));
        }
    }
    [[nodiscard]] const std::vector<ShapeSurface>& all() const { return cells_; }

private:
    // "cell(i, j, k) is the cell i lines, j p cells and k bands further on; one that the map does not have is empty"
    [[nodiscard]] ShapeSurface cell(long at, int i, int j, int k) const {
        const long line = at / (long{p_cells_} * bands_) + i;
        const long p = at / bands_ % p_cells_ + j;
        const long band = at % bands_ + k;
        if (line < 0 || p < 0 || p >= p_cells_ || band < 0 || band >= bands_) return {};
        return cells_[static_cast<std::size_t>((line * p_cells_ + p) * bands_ + band)];
    }

    int read_shown(long at) {
        const int s = cell(at, 0, 0, -1).shown + 4 * cell(at, 0, -1, 0).shown + 16 * cell(at, -1, 0, 0).shown +
                      64 * cell(at, 0, -1, 1).shown + 256 * cell(at, -1, 1, 0).shown + 1024 * cell(at, -1, 0, 1).shown;
        if (bits_.bit({'s', s, 0, 0}) == 0) return 0;
        if (bits_.bit({'b', s, 0, 0}) == 1) return 3;
        return bits_.bit({'2', s, 0, 0}) == 1 ? 2 : 1;
    }

    int read_depth(long at) {
        const auto v = [&](int i, int j, int k) -> std::optional<int> {
            const ShapeSurface found = cell(at, i, j, k);
            return found.shown != 0 ? std::optional(found.depth) : std::nullopt;
        };
        using Place = std::array<int, 3>;
        static constexpr std::array<Place, 3> kAlone = {{{0, 0, -1}, {0, -1, 0}, {-1, 0, 0}}};
        static constexpr std::array<std::array<Place, 3>, 6> kSums = {{
            {{{0, 0, -1}, {0, -1, 0}, {0, -1, -1}}},
            {{{0, 0, -1}, {0, -1, 1}, {0, -1, 0}}},
            {{{-1, 0, 0}, {0, 0, -1}, {-1, 0, -1}}},
            {{{-1, 0, 0}, {0, -1, 0}, {-1, -1, 0}}},
            {{{-1, 0, 0}, {0, -1, 1}, {-1, -1, 1}}},
            {{{0, 0, -1}, {-1, 1, 0}, {-1, 1, -1}}},
        }};
        std::vector<int> candidates;
        for (const auto& [i, j, k] : kAlone) {
            if (const auto value = v(i, j, k)) candidates.push_back(*value);
        }
        for (const auto& [a, b, c] : kSums) {
            const auto first = v(a[0], a[1], a[2]);
            const auto second = v(b[0], b[1], b[2]);
            const auto third = v(c[0], c[1], c[2]);
            if (first && second && third) candidates.push_back(std::clamp(*first + *second - *third, 0, 255));
        }
        std::sort(candidates.begin(), candidates.end());
        const std::size_t c = candidates.size();
        const int prediction = c == 0 ? 128 : (candidates[(c - 1) / 2] + candidates[c / 2]) / 2;
        const int g = c == 0 ? 121
                             : 11 * class_of(candidates[c - 1] - candidates[0]) +
                                   class_of(candidates[3 * c / 4] - candidates[c / 4]);
        if (bits_.bit({'d', g, 0, 0}) == 0) return prediction;
        const int nearer = bits_.bit({'n', g, 0, 0});
        int m = 0;
        while (m < 14 && bits_.bit({'m', g, nearer, m}) == 1) ++m;
        if (m == 14) {
            int raw = 0;
            for (int i = 0; i < 7; ++i) raw = 2 * raw + bits_.raw();
            m = 14 + raw;
        }
        return ((nearer == 1 ? prediction - 1 - m : prediction + 1 + m) % 256 + 256) % 256;
    }

    static int class_of(int a) {
        int found = 0;
        for (const int bound : {1, 2, 3, 4, 6, 9, 13, 21, 41, 81}) found += bound <= a ? 1 : 0;
        return found;
    }

    AdaptingBits bits_;
    int p_cells_;
    int bands_;
    std::vector<ShapeSurface> cells_;
};

std::string read_cells(Bytes bytes, std::size_t cells, std::size_t surfaces, Shape& shape) {
    const Cells read(bytes, cells, shape.p_cells, shape.bands);
    shape.surfaces.resize(cells);
    std::size_t count = 0;
    for (std::size_t i = 0; i < cells; ++i) {
        if (read.all()[i].shown == 0) continue;
        shape.surfaces[i] = read.all()[i];
        ++count;
    }
    return count == surfaces ? "" : "a number of surfaces that the cells do not bear out";
}

}  // namespace

std::string read_shape(Bytes payload, int views, int planes, Shape& shape) {
    const std::size_t n = static_cast<std::size_t>(views);
    const std::size_t cells_at = 48 + 2 * n + 16 * n * static_cast<std::size_t>(planes);
    if (payload.size() < cells_at) return "shorter than its fields";
    if (payload[0] != 2) return "a coding that is not known";
    shape.jump = payload[1];
    shape.thickness = payload[2];
    if (payload[3] != 0) return "reserved bytes that are not 0";
    shape.p_cells = u16_at(payload, 4);
    shape.bands = u16_at(payload, 6);
    if (shape.p_cells < 1 || shape.p_cells > 4096) return "p_cells out of range";
    if (shape.bands < 1 || shape.bands > 4096) return "bands out of range";
    for (std::size_t i = 0; i < shape.numbers.size(); ++i) shape.numbers[i] = i32_at(payload, 8 + 4 * i);
    const std::size_t surfaces = u32_at(payload, 40);
    if (payload.size() != cells_at + u32_at(payload, 44)) return "of another size";
    std::size_t all_lines = 0;
    for (std::size_t i = 0; i < n; ++i) {
        shape.lines.push_back(u16_at(payload, 48 + 2 * i));
        if (shape.lines.back() > 1024) return "lines out of range";
        all_lines += static_cast<std::size_t>(shape.lines.back());
    }
    for (std::size_t at = 48 + 2 * n; at < cells_at; at += 16) {
        shape.normal.push_back(
            {i32_at(payload, at), i32_at(payload, at + 4), i32_at(payload, at + 8), i32_at(payload, at + 12)});
    }
    if (std::string error = check_numbers(shape); !error.empty()) return error + " out of range";
    const std::size_t cells =
        all_lines * static_cast<std::size_t>(shape.p_cells) * static_cast<std::size_t>(shape.bands);
    if (cells > std::size_t{1} << 27) return "more than 2^27 cells";
    if (surfaces > cells) return "surfaces out of range";
    return read_cells(payload.subspan(cells_at), cells, surfaces, shape);
}

}  // namespace rs::reference
