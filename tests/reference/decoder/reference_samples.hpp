#pragma once
// FORMAT.md, "Prediction" and "Reconstruction": from modes, vectors and levels to samples.

#include "tests/reference/decoder/reference_chunks.hpp"
#include "tests/reference/decoder/reference_decoder.hpp"

#include <cstdint>
#include <vector>

namespace rs::reference {

/// n x n numbers, (x, y) or (u, v) at at(x, y).
struct Square {
    explicit Square(int n_) : n(n_), values(static_cast<std::size_t>(n_ * n_)) {}
    int& at(int x, int y) { return values[static_cast<std::size_t>(y * n + x)]; }
    int at(int x, int y) const { return values[static_cast<std::size_t>(y * n + x)]; }
    int n;
    std::vector<int> values;
};

inline std::uint8_t& sample(DecodedImage& image, int plane, int x, int y) {
    return image.planes[static_cast<std::size_t>(plane)][static_cast<std::size_t>(y * image.width + x)];
}

/// "Samples outside of the coded size are the nearest ones inside."
int nearest_sample(const DecodedImage& image, int plane, int x, int y);

/// "From a reference": the part of n x n at (x, y), moved by the vector.
Square predict_from_reference(const DecodedImage& reference, int plane, int x, int y, int n, Vector vector);

/// "From neighbours": the part of n x n at (x, y) of the image that is being decoded.
Square predict_from_neighbours(const DecodedImage& image, int plane, int x, int y, int n, int mode, bool has_left,
                               bool has_upper);

/// "Step index i stands for q".
int quantiser_step(int step_index);

/// "Reconstruction": R of a transform's levels; the step index is that of the plane.
Square residual(const Square& levels, int step_index);

}  // namespace rs::reference
