#include "encode/codec/board/vector_quantiser.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <algorithm>
#include <limits>

namespace rs::encode {
namespace {

constexpr int kRoundsPerSplit = 3;
constexpr int kLastRounds = 6;

std::int16_t rounded_quotient(std::int64_t sum, std::int64_t weight) {
    const std::int64_t half = sum < 0 ? -weight / 2 : weight / 2;
    return static_cast<std::int16_t>(std::clamp<std::int64_t>((sum + half) / weight, -128, 127));
}

struct BlockSums {
    std::vector<std::int64_t> values;  // [entry][dimension]
    std::vector<std::int64_t> weights;
    std::vector<std::int64_t> errors;  // [entry]
};

// Sums over the vectors in each entry's cell.
BlockSums sum_cells(const Codebook& book, const WeightedVectors& vectors) {
    std::vector<Nearest> nearest(vectors.count());
    const auto dimensions = static_cast<std::size_t>(book.dimensions);
    for_each_index(nearest.size(), [&](std::size_t i) {
        nearest[i] = find_nearest_entry(book, &vectors.values[i * dimensions], &vectors.weights[i * dimensions]);
    });
    BlockSums sums;
    sums.values.resize(book.entries.size());
    sums.weights.resize(book.entries.size());
    sums.errors.resize(book.count());
    for (std::size_t i = 0; i < nearest.size(); ++i) {
        const std::size_t entry = nearest[i].index;
        sums.errors[entry] += nearest[i].distance;
        for (std::size_t d = 0; d < dimensions; ++d) {
            const std::int64_t weight = vectors.weights[i * dimensions + d];
            sums.values[entry * dimensions + d] += weight * vectors.values[i * dimensions + d];
            sums.weights[entry * dimensions + d] += weight;
        }
    }
    return sums;
}

// Moves every entry but the first to the centroid of its cell; an entry without vectors moves next to the entry with
// the largest error.
void move_entries(Codebook& book, const BlockSums& sums) {
    const auto dimensions = static_cast<std::size_t>(book.dimensions);
    std::vector<std::int64_t> errors = sums.errors;
    for (std::size_t entry = 1; entry < book.count(); ++entry) {
        std::int64_t used = 0;
        for (std::size_t d = 0; d < dimensions; ++d) {
            const std::int64_t weight = sums.weights[entry * dimensions + d];
            used += weight;
            if (weight > 0) {
                book.entries[entry * dimensions + d] = rounded_quotient(sums.values[entry * dimensions + d], weight);
            }
        }
        if (used > 0) continue;
        const auto worst = static_cast<std::size_t>(std::max_element(errors.begin(), errors.end()) - errors.begin());
        if (errors[worst] == 0) {  // no error left
            std::fill_n(book.entries.begin() + static_cast<std::ptrdiff_t>(entry * dimensions), dimensions,
                        std::int16_t{0});
            continue;
        }
        errors[worst] /= 2;
        for (std::size_t d = 0; d < dimensions; ++d) {
            const int beside = book.entries[worst * dimensions + d] + (d % 2 == 0 ? 1 : -1);
            book.entries[entry * dimensions + d] = static_cast<std::int16_t>(std::clamp(beside, -128, 127));
        }
    }
}

// Doubles the entries; each new entry starts near its parent.
void split(Codebook& book) {
    const std::size_t before = book.entries.size();
    book.entries.resize(2 * before);
    for (std::size_t i = 0; i < before; ++i) {
        const int beside = book.entries[i] + (i % 3 == 0 ? 2 : (i % 3 == 1 ? -2 : 1));
        book.entries[before + i] = static_cast<std::int16_t>(std::clamp(beside, -128, 127));
    }
}

}  // namespace

WeightedVectors::Place WeightedVectors::add() {
    const std::size_t at = values.size();
    values.resize(at + static_cast<std::size_t>(dimensions));
    weights.resize(values.size());
    return {values.data() + at, weights.data() + at};
}

std::int64_t weighted_distance(const std::int16_t* values, const std::int16_t* weights, const std::int16_t* entry,
                               int dimensions) {
    // 28 * 1152 fits into 16 bits, and 48 components of 28 * 1152 * 1152 into 32.
    std::int64_t distance = 0;
    for (int begin = 0; begin < dimensions; begin += 48) {
        const int end = std::min(begin + 48, dimensions);
        std::uint32_t sum = 0;
        for (int d = begin; d < end; ++d) {
            const auto off = static_cast<std::int16_t>(values[d] - entry[d]);
            const auto weighted = static_cast<std::int16_t>(weights[d] * off);
            sum += static_cast<std::uint32_t>(int{weighted} * int{off});
        }
        distance += sum;
    }
    return distance;
}

Nearest find_nearest_entry(const Codebook& book, const std::int16_t* values, const std::int16_t* weights) {
    Nearest best{0, std::numeric_limits<std::int64_t>::max()};
    const std::int16_t* entry = book.entries.data();
    for (std::size_t e = 0; e < book.count(); ++e, entry += book.dimensions) {
        const std::int64_t distance = weighted_distance(values, weights, entry, book.dimensions);
        if (distance < best.distance) best = {e, distance};
    }
    return best;
}

void refine_codebook(Codebook& book, const WeightedVectors& vectors, int rounds) {
    if (vectors.count() == 0) return;
    for (int round = 0; round < rounds; ++round) move_entries(book, sum_cells(book, vectors));
}

std::size_t prune_codebook(Codebook& book, const WeightedVectors& vectors, double cost) {
    struct Gain {
        std::size_t entry = 0;
        std::int64_t gain = 0;
    };
    const auto dimensions = static_cast<std::size_t>(book.dimensions);
    std::vector<Gain> gains(vectors.count());
    for_each_index(gains.size(), [&](std::size_t i) {
        const std::int16_t* const values = &vectors.values[i * dimensions];
        const std::int16_t* const weights = &vectors.weights[i * dimensions];
        Nearest best{0, std::numeric_limits<std::int64_t>::max()};
        std::int64_t second = best.distance;
        for (std::size_t e = 0; e < book.count(); ++e) {
            const std::int64_t distance =
                weighted_distance(values, weights, &book.entries[e * dimensions], book.dimensions);
            if (distance < best.distance) {
                second = best.distance;
                best = {e, distance};
            } else {
                second = std::min(second, distance);
            }
        }
        if (book.count() > 1) gains[i] = {best.index, second - best.distance};
    });
    std::vector<std::int64_t> sums(book.count());
    for (const Gain& gain : gains) sums[gain.entry] += gain.gain;
    std::size_t left = 0;
    for (std::size_t e = 1; e < book.count(); ++e) {
        const auto begin = book.entries.begin() + static_cast<std::ptrdiff_t>(e * dimensions);
        if (static_cast<double>(sums[e]) < cost) {
            std::fill_n(begin, dimensions, std::int16_t{0});
        } else {
            ++left;
        }
    }
    return left;
}

Codebook train_codebook(const WeightedVectors& vectors, std::size_t entries) {
    Codebook book;
    book.dimensions = vectors.dimensions;
    book.entries.assign(static_cast<std::size_t>(vectors.dimensions), 0);
    while (book.count() < entries) {
        split(book);
        refine_codebook(book, vectors, kRoundsPerSplit);
    }
    refine_codebook(book, vectors, kLastRounds);
    return book;
}

}  // namespace rs::encode
