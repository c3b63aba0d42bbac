#include "tests/reference/decoder/reference_edges.hpp"

#include "tests/reference/decoder/reference_samples.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace rs::reference {
namespace {

// "In a line across the edge the samples are p3 p2 p1 p0 of A and q0 q1 q2 q3 of B."
struct EdgeLine {
    std::array<int, 4> p, q;
    int bend_p() const { return std::abs(p[2] - 2 * p[1] + p[0]); }  // P
    int bend_q() const { return std::abs(q[2] - 2 * q[1] + q[0]); }  // Q
};

using EdgeHalf = std::array<EdgeLine, 4>;

std::uint8_t& across(DecodedImage& image, const Edge& edge, int line, int distance) {
    const int x = edge.x + (edge.is_upright ? distance : line);
    const int y = edge.y + (edge.is_upright ? line : distance);
    return sample(image, edge.plane, x, y);
}

EdgeLine line_at(DecodedImage& image, const Edge& edge, int line) {
    EdgeLine samples{};
    for (int i = 0; i < 4; ++i) {
        samples.p[static_cast<std::size_t>(i)] = across(image, edge, line, -1 - i);
        samples.q[static_cast<std::size_t>(i)] = across(image, edge, line, i);
    }
    return samples;
}

// "all clamped to 0 .. 255"
void put_line(const EdgeLine& samples, DecodedImage& image, const Edge& edge, int line) {
    for (int i = 0; i < 4; ++i) {
        const std::size_t at = static_cast<std::size_t>(i);
        across(image, edge, line, -1 - i) = static_cast<std::uint8_t>(std::clamp(samples.p[at], 0, 255));
        across(image, edge, line, i) = static_cast<std::uint8_t>(std::clamp(samples.q[at], 0, 255));
    }
}

// "It is flat if for its first and for its last line": the condition for each of the two.
bool is_flat(const EdgeLine& line, int t, int b) {
    const auto& [p, q] = line;
    return 2 * (line.bend_p() + line.bend_q()) < b >> 2 && std::abs(p[3] - p[0]) + std::abs(q[0] - q[3]) < b >> 3 &&
           std::abs(p[0] - q[0]) < (5 * t + 1) >> 1;
}

EdgeLine flat_line(const EdgeLine& line, int t) {
    const auto& [p, q] = line;
    EdgeLine smooth = {{(p[2] + 2 * p[1] + 2 * p[0] + 2 * q[0] + q[1] + 4) >> 3, (p[2] + p[1] + p[0] + q[0] + 2) >> 2,
                        (2 * p[3] + 3 * p[2] + p[1] + p[0] + q[0] + 4) >> 3, p[3]},
                       {(p[1] + 2 * p[0] + 2 * q[0] + 2 * q[1] + q[2] + 4) >> 3, (p[0] + q[0] + q[1] + q[2] + 2) >> 2,
                        (p[0] + q[0] + q[1] + 3 * q[2] + 2 * q[3] + 4) >> 3, q[3]}};
    for (std::size_t i = 0; i < 3; ++i) {
        smooth.p[i] = std::clamp(smooth.p[i], p[i] - 2 * t, p[i] + 2 * t);
        smooth.q[i] = std::clamp(smooth.q[i], q[i] - 2 * t, q[i] + 2 * t);
    }
    return smooth;
}

EdgeLine other_line(const EdgeLine& line, int t, bool changes_p1, bool changes_q1) {
    const auto& [p, q] = line;
    int w = (9 * (q[0] - p[0]) - 3 * (q[1] - p[1]) + 8) >> 4;
    if (std::abs(w) >= 10 * t) return line;
    w = std::clamp(w, -t, t);
    EdgeLine smooth = line;
    smooth.p[0] = p[0] + w;
    smooth.q[0] = q[0] - w;
    const int most = t >> 1;
    if (changes_p1) smooth.p[1] = p[1] + std::clamp((((p[2] + p[0] + 1) >> 1) - p[1] + w) >> 1, -most, most);
    if (changes_q1) smooth.q[1] = q[1] + std::clamp((((q[2] + q[0] + 1) >> 1) - q[1] - w) >> 1, -most, most);
    return smooth;
}

// "Its two halves of 4 lines are judged each for itself."
EdgeHalf smooth_half(const EdgeHalf& half, int t, int b) {
    const EdgeLine& first = half[0];
    const EdgeLine& last = half[3];
    if (first.bend_p() + first.bend_q() + last.bend_p() + last.bend_q() >= b) return half;
    const bool flat = is_flat(first, t, b) && is_flat(last, t, b);
    const bool changes_p1 = first.bend_p() + last.bend_p() < (3 * b) >> 4;
    const bool changes_q1 = first.bend_q() + last.bend_q() < (3 * b) >> 4;
    EdgeHalf smooth = half;
    for (EdgeLine& line : smooth) line = flat ? flat_line(line, t) : other_line(line, t, changes_p1, changes_q1);
    return smooth;
}

}  // namespace

void smooth_edge(DecodedImage& image, const Edge& edge) {
    const int t = (6 * edge.q + 512) >> 10;
    const int b = edge.q >> 4;
    if (t == 0) return;
    for (int begin = 0; begin < 8; begin += 4) {
        EdgeHalf half{};
        for (int i = 0; i < 4; ++i) half[static_cast<std::size_t>(i)] = line_at(image, edge, begin + i);
        half = smooth_half(half, t, b);
        for (int i = 0; i < 4; ++i) put_line(half[static_cast<std::size_t>(i)], image, edge, begin + i);
    }
}

}  // namespace rs::reference
