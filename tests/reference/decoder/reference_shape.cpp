#include "tests/reference/decoder/reference_shape.hpp"

#include "tests/reference/decoder/reference_bytes.hpp"

#include <algorithm>
#include <cmath>

namespace rs::reference {
namespace {

using Bytes = std::span<const std::uint8_t>;
using Plane = std::vector<std::uint8_t>;

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

// "Planes": the depth bytes of the cells that have a surface.
std::vector<std::optional<int>> undo(const Plane& residuals, const std::vector<bool>& has_surface, int p_cells,
                                     int bands) {
    std::vector<std::optional<int>> values(has_surface.size());
    const int lines = static_cast<int>(has_surface.size()) / (p_cells * bands);
    const auto number = [&](int line, int p, int band) {
        return static_cast<std::size_t>((line * p_cells + p) * bands + band);
    };
    std::size_t taken = 0;
    for (int line = 0; line < lines; ++line) {
        for (int p = 0; p < p_cells; ++p) {
            for (int band = 0; band < bands; ++band) {
                if (!has_surface[number(line, p, band)]) continue;
                const auto v = [&](int i, int j, int k) -> std::optional<int> {
                    const bool is_inside =
                        line + i >= 0 && p + j >= 0 && p + j < p_cells && band + k >= 0 && band + k < bands;
                    return is_inside ? values[number(line + i, p + j, band + k)] : std::nullopt;
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
                values[number(line, p, band)] = (prediction + residuals[taken++]) % 256;
            }
        }
    }
    return values;
}

std::string read_cells(Bytes frames, const std::array<std::size_t, 2>& frame_bytes, std::size_t cells,
                       std::size_t surfaces, Shape& shape) {
    std::array<Plane, 2> planes;
    const std::array<std::size_t, 2> plane_bytes = {(cells + 3) / 4, surfaces};
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const std::string error = expand(frames.first(frame_bytes[i]), plane_bytes[i], planes[i]);
        if (!error.empty()) return error;
        frames = frames.subspan(frame_bytes[i]);
    }
    std::vector<int> shown(cells);
    std::vector<bool> has_surface(cells);
    for (std::size_t i = 0; i < 4 * plane_bytes[0]; ++i) {
        const int bits = planes[0][i / 4] / (1 << 2 * (i % 4)) % 4;
        if (i >= cells && bits != 0) return "bits behind the last cell";
        if (i >= cells) continue;
        shown[i] = bits;
        has_surface[i] = bits != 0;
    }
    if (static_cast<std::size_t>(std::count(has_surface.begin(), has_surface.end(), true)) != surfaces) {
        return "a number of surfaces that the bits do not bear out";
    }
    const auto depths = undo(planes[1], has_surface, shape.p_cells, shape.bands);
    shape.surfaces.resize(cells);
    for (std::size_t i = 0; i < cells; ++i) {
        if (has_surface[i]) shape.surfaces[i] = {*depths[i], shown[i]};
    }
    return "";
}

}  // namespace

std::string read_shape(Bytes payload, int views, int planes, Shape& shape) {
    const std::size_t n = static_cast<std::size_t>(views);
    const std::size_t frames_at = 52 + 2 * n + 16 * n * static_cast<std::size_t>(planes);
    if (payload.size() < frames_at) return "shorter than its fields";
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
    const std::array<std::size_t, 2> frame_bytes = {u32_at(payload, 44), u32_at(payload, 48)};
    if (payload.size() != frames_at + frame_bytes[0] + frame_bytes[1]) return "of another size";
    std::size_t all_lines = 0;
    for (std::size_t i = 0; i < n; ++i) {
        shape.lines.push_back(u16_at(payload, 52 + 2 * i));
        if (shape.lines.back() > 1024) return "lines out of range";
        all_lines += static_cast<std::size_t>(shape.lines.back());
    }
    for (std::size_t at = 52 + 2 * n; at < frames_at; at += 16) {
        shape.normal.push_back(
            {i32_at(payload, at), i32_at(payload, at + 4), i32_at(payload, at + 8), i32_at(payload, at + 12)});
    }
    if (std::string error = check_numbers(shape); !error.empty()) return error + " out of range";
    const std::size_t cells =
        all_lines * static_cast<std::size_t>(shape.p_cells) * static_cast<std::size_t>(shape.bands);
    if (cells > std::size_t{1} << 27) return "more than 2^27 cells";
    if (surfaces > cells) return "surfaces out of range";
    return read_cells(payload.subspan(frames_at), frame_bytes, cells, surfaces, shape);
}

}  // namespace rs::reference
