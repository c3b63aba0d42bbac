#pragma once
// Normal equations of one iteration of patch alignment. Every element is a sum over the patch of a product of two of
// {slope x, slope y, texture, 1, residual} times i^a j^b, so these few sums are computed instead of the products of all
// unknowns at every pixel.

#include "capture/calibration/points/patch_image.hpp"

#include <Eigen/Core>

namespace rs::capture {

/// The unknowns are the warp's centre x, y and its matrix row by row, the gain minus 1, illumination as a plane (1, i,
/// j), and the curvatures for i^2 / 2, j^2 / 2, i j.
inline constexpr int kPatchUnknowns = 13;
inline constexpr int kFlatPatchUnknowns = 10;  // without the curvatures

struct PatchEquations {
    using Matrix = Eigen::Matrix<double, kPatchUnknowns, kPatchUnknowns>;
    using Vector = Eigen::Matrix<double, kPatchUnknowns, 1>;
    Matrix normal = Matrix::Zero();
    Vector right_side = Vector::Zero();
    /// Weighted sums of squares of the residual with gain 1 and of the texture; sum of the weights.
    double squares = 0;
    double texture = 0;
    double weights = 0;
};

/// Accumulates the sums row by row; equations() assembles the result.
class PatchSums {
public:
    /// If the curvature is known its equations stay zero.
    explicit PatchSums(bool curvature_is_known);
    /// `weight`: 0 for invalid pixels. `less` is subtracted from the image values to keep numbers small.
    void add(int j, const SeenRow& seen, const PatchRow& texture, const PatchRow& weight, float less);
    [[nodiscard]] PatchEquations equations(const glm::dvec2& deeper) const;

private:
    enum Product { kXX, kXY, kYY, kXT, kYT, kX, kY, kT, kTT, kXR, kYR, kTR, kR, kRR, kOne, kProducts };
    static constexpr int kPowers = 5;  // 0 .. 4
    [[nodiscard]] double moment(Product product, int a, int b) const;

    std::array<int, kProducts> degree_;  // highest needed degree of i and j together
    alignas(64) std::array<std::array<PatchRow, kPowers>, kProducts> sums_;  // [product][power of j][column]
};

}  // namespace rs::capture
