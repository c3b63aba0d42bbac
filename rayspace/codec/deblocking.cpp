#include "rayspace/codec/deblocking.hpp"

#include "rayspace/codec/prediction_unit.hpp"

#include <algorithm>
#include <cstdlib>

namespace rs::codec {
namespace {

constexpr int kSegment = 4;  // samples along an edge per decision

struct Strength {
    int tc = 0;    // approximate limit of a sample's change (tC of HEVC)
    int beta = 0;  // edges in rougher surroundings are not filtered (beta of HEVC)
};

Strength strength_of(int step) {
    const int q = step_q4(step);
    return {(6 * q + 512) >> 10, q >> 4};
}

// True if an edge between two blocks can be a coding artefact.
bool is_filtered_edge(const BlockInfo& a, const BlockInfo& b) {
    if (a.source == Source::kNone || b.source == Source::kNone) return false;
    if (a.coded || b.coded || a.source != b.source || a.source == Source::kIntra) return true;
    for (const int r : {0, 1}) {
        const auto n = static_cast<std::size_t>(r);
        if (uses(a.source, r) && a.motion[n] != b.motion[n]) return true;
    }
    return false;
}

std::uint8_t clamped(int value, int low, int high) {
    return static_cast<std::uint8_t>(std::clamp(value, std::max(low, 0), std::min(high, 255)));
}

// The samples of one line across an edge: p3 p2 p1 p0 | q0 q1 q2 q3.
class Line {
public:
    Line(std::uint8_t* behind, std::ptrdiff_t across) : first_(behind), across_(across) {
        for (int n = 0; n < 4; ++n) {
            p[n] = behind[-(n + 1) * across];
            q[n] = behind[n * across];
        }
    }
    [[nodiscard]] int second_difference_p() const { return std::abs(p[2] - 2 * p[1] + p[0]); }
    [[nodiscard]] int second_difference_q() const { return std::abs(q[2] - 2 * q[1] + q[0]); }

    [[nodiscard]] bool is_flat(const Strength& strength) const {
        return 2 * (second_difference_p() + second_difference_q()) < strength.beta >> 2 &&
               std::abs(p[3] - p[0]) + std::abs(q[0] - q[3]) < strength.beta >> 3 &&
               std::abs(p[0] - q[0]) < (5 * strength.tc + 1) >> 1;
    }

    void smooth_flat(int tc) const {
        const auto put = [&](int place, int old, int value) {
            first_[place * across_] = clamped(value, old - 2 * tc, old + 2 * tc);
        };
        put(-1, p[0], (p[2] + 2 * p[1] + 2 * p[0] + 2 * q[0] + q[1] + 4) >> 3);
        put(-2, p[1], (p[2] + p[1] + p[0] + q[0] + 2) >> 2);
        put(-3, p[2], (2 * p[3] + 3 * p[2] + p[1] + p[0] + q[0] + 4) >> 3);
        put(0, q[0], (p[1] + 2 * p[0] + 2 * q[0] + 2 * q[1] + q[2] + 4) >> 3);
        put(1, q[1], (p[0] + q[0] + q[1] + q[2] + 2) >> 2);
        put(2, q[2], (p[0] + q[0] + q[1] + 3 * q[2] + 2 * q[3] + 4) >> 3);
    }

    // `second_p`, `second_q`: also change the second samples.
    void smooth(int tc, bool second_p, bool second_q) const {
        const int whole = (9 * (q[0] - p[0]) - 3 * (q[1] - p[1]) + 8) >> 4;
        if (std::abs(whole) >= 10 * tc) return;
        const int off = std::clamp(whole, -tc, tc);
        first_[-across_] = clamped(p[0] + off, 0, 255);
        first_[0] = clamped(q[0] - off, 0, 255);
        const int half = tc >> 1;
        if (second_p) {
            const int more = (((p[2] + p[0] + 1) >> 1) - p[1] + off) >> 1;
            first_[-2 * across_] = clamped(p[1] + std::clamp(more, -half, half), 0, 255);
        }
        if (second_q) {
            const int more = (((q[2] + q[0] + 1) >> 1) - q[1] - off) >> 1;
            first_[across_] = clamped(q[1] + std::clamp(more, -half, half), 0, 255);
        }
    }

private:
    std::uint8_t* first_;
    std::ptrdiff_t across_;
    int p[4];
    int q[4];
};

// Filters a segment. `first`: the first sample after the edge; `across` and `along`: strides across and along it.
void filter_segment(std::uint8_t* first, std::ptrdiff_t across, std::ptrdiff_t along, const Strength& strength) {
    const Line begin(first, across);
    const Line end(first + (kSegment - 1) * along, across);
    const int second_difference_p = begin.second_difference_p() + end.second_difference_p();
    const int second_difference_q = begin.second_difference_q() + end.second_difference_q();
    if (second_difference_p + second_difference_q >= strength.beta) return;
    const bool flat = begin.is_flat(strength) && end.is_flat(strength);
    const int smooth_side = (3 * strength.beta) >> 4;
    for (int n = 0; n < kSegment; ++n) {
        const Line line(first + n * along, across);
        if (flat) {
            line.smooth_flat(strength.tc);
        } else {
            line.smooth(strength.tc, second_difference_p < smooth_side, second_difference_q < smooth_side);
        }
    }
}

}  // namespace

void filter_edges(const TileGrid& grid, const DenseCode& code, int step, const TileRect& place, const PlaneViews& out) {
    if (!code.deblocking) return;
    for (int plane = 0; plane < kPlanes; ++plane) {
        const Strength strength = strength_of(code.plane_step(step, plane));
        if (strength.tc == 0) continue;
        const ImageView<std::uint8_t> samples = out[static_cast<std::size_t>(plane)];
        for (const bool upright : {true, false}) {
            const std::ptrdiff_t across = upright ? 1 : samples.stride();
            const std::ptrdiff_t along = upright ? samples.stride() : 1;
            for (int by = upright ? 0 : 1; by < place.height / kBlock; ++by) {
                for (int bx = upright ? 1 : 0; bx < place.width / kBlock; ++bx) {
                    const BlockInfo& behind = grid.at(bx, by);
                    const bool inside_macroblock = ((upright ? bx : by) & 1) != 0;
                    const bool shows =
                        inside_macroblock && !behind.split
                            ? behind.small_transforms
                            : is_filtered_edge(upright ? grid.at(bx - 1, by) : grid.at(bx, by - 1), behind);
                    if (!shows) continue;
                    std::uint8_t* const first = samples.row(place.top + by * kBlock) + place.left + bx * kBlock;
                    for (int n = 0; n < kBlock; n += kSegment) {
                        filter_segment(first + n * along, across, along, strength);
                    }
                }
            }
        }
    }
}

}  // namespace rs::codec
