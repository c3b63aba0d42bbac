#pragma once
// Vector quantisation of integer vectors with a weight for every component of every vector: codebook training by
// splitting and Lloyd's iteration (Linde, Buzo, Gray 1980), and nearest-entry search.
//
// All sums are integers, so that results do not depend on the number of threads.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::encode {

/// `count` vectors. Component d of vector i and its weight are at [i * dimensions + d]. Values within -1024 .. 1024,
/// weights 0 .. 28; 0 for ignored components.
struct WeightedVectors {
    int dimensions = 0;
    std::vector<std::int16_t> values;
    std::vector<std::int16_t> weights;

    [[nodiscard]] std::size_t count() const {
        return dimensions == 0 ? 0 : values.size() / static_cast<std::size_t>(dimensions);
    }
    // Appends a zero vector to be filled; valid until the next call.
    struct Place {
        std::int16_t* values;
        std::int16_t* weights;
    };
    Place add();
};

/// Entry e begins at [e * dimensions]; its components are within -128 .. 127.
struct Codebook {
    int dimensions = 0;
    std::vector<std::int16_t> entries;
    [[nodiscard]] std::size_t count() const {
        return dimensions == 0 ? 0 : entries.size() / static_cast<std::size_t>(dimensions);
    }
};

/// Sum of weight * (value - entry)^2.
std::int64_t weighted_distance(const std::int16_t* values, const std::int16_t* weights, const std::int16_t* entry,
                               int dimensions);

struct Nearest {
    std::size_t index = 0;
    std::int64_t distance = 0;
};
/// The nearest entry; of entries at the same distance, the first. The book must not be empty.
Nearest find_nearest_entry(const Codebook& book, const std::int16_t* values, const std::int16_t* weights);

/// Trains a codebook. Entry 0 is zero, so that a stage can leave a vector unchanged. Runs on the threads of the calling
/// tbb arena.
/// \param entries  a power of two; with fewer vectors some entries are zero.
Codebook train_codebook(const WeightedVectors& vectors, std::size_t entries);

/// Runs further iterations of an existing book on other vectors.
void refine_codebook(Codebook& book, const WeightedVectors& vectors, int rounds);

/// Zeroes the entries whose gain is below `cost`: the squared error by which they are nearer to their vectors than the
/// next best entry. Returns the number of remaining entries.
std::size_t prune_codebook(Codebook& book, const WeightedVectors& vectors, double cost);

}  // namespace rs::encode
