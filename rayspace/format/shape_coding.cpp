#include "rayspace/format/content_coding.hpp"

#include "rayspace/codec/adaptation.hpp"
#include "rayspace/codec/bool_decoder.hpp"
#include "rayspace/codec/bool_encoder.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

namespace rs::shape_coding {
namespace {

// Neighbours of the current cell by their offset in lines, in p and in bands. Cells outside of the map are empty.
class Neighbourhood {
public:
    explicit Neighbourhood(const ShapeMap& shape)
        : cell_(shape.cells.data()),
          p_cells_(shape.p_cells),
          bands_(shape.bands),
          line_stride_(std::ptrdiff_t{shape.p_cells} * shape.bands) {}

    // Moves to the next cell; call for every cell in the map's order.
    void go_to_next() {
        ++cell_;
        if (++band_ < bands_) return;
        band_ = 0;
        if (++p_ < p_cells_) return;
        p_ = 0;
        is_first_line_ = false;
    }

    [[nodiscard]] ShapeCell at(int line_step, int p_step, int band_step) const {
        const int p = p_ + p_step;
        const int band = band_ + band_step;
        if ((line_step < 0 && is_first_line_) || p < 0 || p >= p_cells_ || band < 0 || band >= bands_) return {};
        return cell_[line_step * line_stride_ + std::ptrdiff_t{p_step} * bands_ + band_step];
    }

private:
    const ShapeCell* cell_;
    int p_cells_;
    int bands_;
    std::ptrdiff_t line_stride_;
    bool is_first_line_ = true;
    int p_ = 0;
    int band_ = 0;
};

constexpr int kSpreads = 11;
constexpr int kUnguided = kSpreads * kSpreads;  // context of a depth without neighbours

// Class of the distance between candidates, 0 .. kSpreads - 1.
int spread_class(int apart) {
    constexpr std::array<std::uint8_t, kSpreads - 1> kFrom = {1, 2, 3, 4, 6, 9, 13, 21, 41, 81};
    int found = 0;
    while (found < kSpreads - 1 && apart >= kFrom[static_cast<std::size_t>(found)]) ++found;
    return found;
}

struct Prediction {
    std::uint8_t depth = 128;
    int context = kUnguided;  // from the distances between the candidates
};

// Predicts a depth: the median of candidates from the neighbours, each alone and by the slope of a surface through
// three of them. Uses only cells before the current one.
Prediction predict(const Neighbourhood& around) {
    constexpr int kNone = -1;
    std::array<int, 9> candidates{};
    int count = 0;
    const auto depth = [&](int line_step, int p_step, int band_step) {
        const ShapeCell cell = around.at(line_step, p_step, band_step);
        return cell.has_surface() ? cell.depth : kNone;
    };
    const auto suggest = [&](int value) {
        int at = count++;
        for (; at > 0 && candidates[static_cast<std::size_t>(at - 1)] > value; --at) {
            candidates[static_cast<std::size_t>(at)] = candidates[static_cast<std::size_t>(at - 1)];
        }
        candidates[static_cast<std::size_t>(at)] = value;
    };
    const auto suggest_alone = [&](int value) {
        if (value != kNone) suggest(value);
    };
    // `a` plus the difference of `to` and `from`.
    const auto suggest_slope = [&](int a, int to, int from) {
        if (a != kNone && to != kNone && from != kNone) suggest(std::clamp(a + to - from, 0, 255));
    };
    const int below = depth(0, 0, -1);
    const int beside = depth(0, -1, 0);
    const int beside_above = depth(0, -1, 1);
    const int before = depth(-1, 0, 0);
    suggest_alone(below);
    suggest_alone(beside);
    suggest_alone(before);
    suggest_slope(below, beside, depth(0, -1, -1));
    suggest_slope(below, beside_above, beside);
    suggest_slope(before, below, depth(-1, 0, -1));
    suggest_slope(before, beside, depth(-1, -1, 0));
    suggest_slope(before, beside_above, depth(-1, -1, 1));
    suggest_slope(below, depth(-1, 1, 0), depth(-1, 1, -1));
    if (count == 0) return {};
    const auto number = [&](int n) { return candidates[static_cast<std::size_t>(n)]; };
    const int whole = spread_class(number(count - 1) - number(0));
    const int inner = spread_class(number(3 * count / 4) - number(count / 4));
    return {static_cast<std::uint8_t>((number((count - 1) / 2) + number(count / 2)) / 2), kSpreads * whole + inner};
}

// Context numbers.
constexpr int kPlaces = 4096;  // states of six neighbours with four values of `shown` each
constexpr int kHasSurface = 0;
constexpr int kByBoth = kHasSurface + kPlaces;
constexpr int kBySecond = kByBoth + kPlaces;
constexpr int kGuides = kUnguided + 1;
constexpr int kUnary = 14;  // unary bins of a residual, before raw bits
constexpr int kRawBits = 7;
constexpr int kDiffers = kBySecond + kPlaces;
constexpr int kIsNearer = kDiffers + kGuides;
constexpr int kMore = kIsNearer + kGuides;  // [guide][is nearer][kUnary]
constexpr int kContexts = kMore + kGuides * 2 * kUnary;

class States {
public:
    [[nodiscard]] std::uint32_t probability(int context) const { return codec::decoder_probability(of(context).zero); }
    void adapt(int context, int bit) {
        State& state = states_[static_cast<std::size_t>(context)];
        state.zero = codec::adapt_probability(state.zero, codec::kAdaptationShifts[state.uses], bit);
        state.uses = codec::increment_uses(state.uses);
    }

private:
    struct State {
        std::uint16_t zero = 1 << 15;  // probability of a 0 in 65536ths
        std::uint8_t uses = 2;
    };
    [[nodiscard]] const State& of(int context) const { return states_[static_cast<std::size_t>(context)]; }

    std::vector<State> states_ = std::vector<State>(kContexts);
};

constexpr std::uint32_t kRaw = 1U << (codec::kProbabilityBits - 1);

// Writer and reader share the syntax of a cell: bit() returns its argument, or the decoded value.
class Writer {
public:
    int bit(int context, int value) {
        encoder_.bit(value, states_.probability(context));
        states_.adapt(context, value);
        return value;
    }
    int raw(int value) {
        encoder_.bit(value, kRaw);
        return value;
    }
    std::vector<std::byte> finish() { return encoder_.finish(); }

private:
    codec::BoolEncoder encoder_;
    States states_;
};

class Reader {
public:
    explicit Reader(std::span<const std::byte> bytes) : decoder_(bytes) {}
    int bit(int context, int) {
        const int value = decoder_.bit(states_.probability(context));
        states_.adapt(context, value);
        return value;
    }
    int raw(int) { return decoder_.bit(kRaw); }

private:
    codec::BoolDecoder decoder_;
    States states_;
};

template <class Bits>
std::uint8_t pass_shown(Bits& bits, const Neighbourhood& around, int shown) {
    const int neighbours = around.at(0, 0, -1).shown | around.at(0, -1, 0).shown << 2 | around.at(-1, 0, 0).shown << 4 |
                           around.at(0, -1, 1).shown << 6 | around.at(-1, 1, 0).shown << 8 |
                           around.at(-1, 0, 1).shown << 10;
    if (bits.bit(kHasSurface + neighbours, shown != 0 ? 1 : 0) == 0) return 0;
    if (bits.bit(kByBoth + neighbours, shown == ShapeCell::kByBoth ? 1 : 0) == 1) return ShapeCell::kByBoth;
    const int second = bits.bit(kBySecond + neighbours, shown == ShapeCell::kBySecond ? 1 : 0);
    return second == 1 ? ShapeCell::kBySecond : ShapeCell::kByFirst;
}

template <class Bits>
std::uint8_t pass_depth(Bits& bits, const Neighbourhood& around, std::uint8_t depth) {
    const Prediction predicted = predict(around);
    const auto residual = static_cast<std::int8_t>(depth - predicted.depth);
    if (bits.bit(kDiffers + predicted.context, residual != 0 ? 1 : 0) == 0) return predicted.depth;
    const int is_nearer = bits.bit(kIsNearer + predicted.context, residual < 0 ? 1 : 0);
    const int more = std::abs(residual) - 1;
    const int first = kMore + (2 * predicted.context + is_nearer) * kUnary;
    int found = 0;
    while (found < kUnary && bits.bit(first + found, more > found ? 1 : 0) == 1) ++found;
    if (found == kUnary) {
        int rest = 0;
        for (int i = kRawBits - 1; i >= 0; --i) rest = 2 * rest + bits.raw((more - kUnary) >> i & 1);
        found += rest;
    }
    return static_cast<std::uint8_t>(predicted.depth + (is_nearer == 1 ? -1 - found : 1 + found));
}

template <class Bits>
ShapeCell pass_cell(Bits& bits, const Neighbourhood& around, ShapeCell cell) {
    cell.shown = pass_shown(bits, around, cell.shown);
    cell.depth = cell.has_surface() ? pass_depth(bits, around, cell.depth) : std::uint8_t{0};
    return cell;
}

}  // namespace

std::vector<std::byte> encode_cells(const ShapeMap& shape) {
    Writer bits;
    Neighbourhood around(shape);
    for (const ShapeCell& cell : shape.cells) {
        pass_cell(bits, around, cell);
        around.go_to_next();
    }
    return bits.finish();
}

void decode_cells(std::span<const std::byte> bytes, ShapeMap& shape) {
    Reader bits(bytes);
    Neighbourhood around(shape);
    for (ShapeCell& cell : shape.cells) {
        cell = pass_cell(bits, around, {});
        around.go_to_next();
    }
}

void snap_depths(ShapeMap& shape, int tolerance) {
    if (tolerance == 0) return;
    Neighbourhood around(shape);
    for (ShapeCell& cell : shape.cells) {
        if (cell.has_surface()) {
            const std::uint8_t predicted = predict(around).depth;
            if (std::abs(predicted - cell.depth) <= tolerance) cell.depth = predicted;
        }
        around.go_to_next();
    }
}

}  // namespace rs::shape_coding
