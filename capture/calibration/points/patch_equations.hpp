#pragma once
// The normal equations of one round of a patch's alignment. All of their numbers are sums over the patch of a product
// of two of {slope x, slope y, texture, 1, what is not explained} times i^a j^b, so those few sums are taken instead of
// the squares of all unknowns at every pixel.

#include "capture/calibration/points/patch_image.hpp"

#include <Eigen/Core>

namespace rs::capture {

// Unknown are the warp's centre x, y and its matrix row by row, the gain less 1, light as a plane (1, i, j), and the
// curvatures by i^2 / 2, j^2 / 2, i j.
inline constexpr int kPatchUnknowns = 13;
inline constexpr int kFlatPatchUnknowns = 10;  // without the curvatures

struct PatchEquations {
    using Matrix = Eigen::Matrix<double, kPatchUnknowns, kPatchUnknowns>;
    using Vector = Eigen::Matrix<double, kPatchUnknowns, 1>;
    Matrix normal = Matrix::Zero();
    Vector right_side = Vector::Zero();
    // Weighted sums of squares of what the texture as it is leaves unexplained, and of the texture; of the weights.
    double squares = 0;
    double texture = 0;
    double weights = 0;
};

// Row by row, then equations().
class PatchSums {
public:
    // Where curvature is known its equations stay zero.
    explicit PatchSums(bool curvature_is_known);
    // `weight`: 0 where a pixel does not count. `less` is taken from what is seen, so that numbers stay small.
    void add(int j, const SeenRow& seen, const PatchRow& texture, const PatchRow& weight, float less);
    [[nodiscard]] PatchEquations equations(const glm::dvec2& deeper) const;

private:
    enum Product { kXX, kXY, kYY, kXT, kYT, kX, kY, kT, kTT, kXR, kYR, kTR, kR, kRR, kOne, kProducts };
    static constexpr int kPowers = 5;  // 0 .. 4
    [[nodiscard]] double moment(Product product, int a, int b) const;

    std::array<int, kProducts> degree_;                                      // of i and j together, that is needed
    alignas(64) std::array<std::array<PatchRow, kPowers>, kProducts> sums_;  // [product][power of j][column]
};

}  // namespace rs::capture
