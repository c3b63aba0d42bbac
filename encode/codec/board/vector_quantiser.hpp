#pragma once
// Vector quantisation of whole-number vectors whose components count differently, each vector with weights of its own:
// codebooks by splitting and Lloyd's iteration (Linde, Buzo, Gray 1980), and the search for the nearest entry.
//
// All sums are whole numbers, so results do not depend on the number of threads.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::encode {

// `count` vectors: value (component d of vector i) at [i * dimensions + d], and so its weight. Values within -1024 ..
// 1024, weights 0 .. 28: 0 for components that do not matter.
struct WeightedVectors {
    int dimensions = 0;
    std::vector<std::int16_t> values;
    std::vector<std::int16_t> weights;

    [[nodiscard]] std::size_t count() const {
        return dimensions == 0 ? 0 : values.size() / static_cast<std::size_t>(dimensions);
    }
    // Zeros, to be filled; valid until the next call.
    struct Place {
        std::int16_t* values;
        std::int16_t* weights;
    };
    Place add();
};

// Entry e stands at [e * dimensions]; its components are within -128 .. 127.
struct TrainedBook {
    int dimensions = 0;
    std::vector<std::int16_t> entries;
    [[nodiscard]] std::size_t count() const {
        return dimensions == 0 ? 0 : entries.size() / static_cast<std::size_t>(dimensions);
    }
};

// Sum of weight * (value - entry)^2.
std::int64_t weighted_distance(const std::int16_t* values, const std::int16_t* weights, const std::int16_t* entry,
                               int dimensions);

struct Nearest {
    std::size_t index = 0;
    std::int64_t distance = 0;
};
// Of the entries with the same distance the first. The book has at least one.
Nearest nearest_entry(const TrainedBook& book, const std::int16_t* values, const std::int16_t* weights);

// `entries`: a power of two; there may be fewer vectors, then some entries are zero. The book's first entry is zero, so
// that a stage can always leave a vector as it is. Runs on the threads of the calling tbb arena.
TrainedBook train_book(const WeightedVectors& vectors, std::size_t entries);

// Further iterations of a book that is there already, on other vectors.
void refine_book(TrainedBook& book, const WeightedVectors& vectors, int rounds);

// Sets to zero the entries that do not bring `cost`: the squared error by which they are nearer to their vectors than
// the next best entry. Returns how many are left.
std::size_t prune_book(TrainedBook& book, const WeightedVectors& vectors, double cost);

}  // namespace rs::encode
