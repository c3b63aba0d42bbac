#include "capture/calibration/points/patch.hpp"

#include "capture/calibration/points/patch_equations.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace rs::capture {
namespace {

constexpr double kLeastCorrelation = 0.85;
constexpr double kFarthestMove_px = 3;      // from the position predicted by the bundle
constexpr double kLeastPatchContrast = 3;   // root mean square; patches with less contrast cannot be aligned
constexpr double kSharpDeviation_px = 0.1;  // alignments with smaller deviations in all directions have full weight
constexpr double kTypicalNoise = 4;         // grey values squared
constexpr double kWindowDeviation_px = 3;
constexpr int kMostIterations = 10;
constexpr double kFewestSamples = 40;

double offset_px(std::size_t at) {
    return static_cast<double>(at) - kPatchHalf_px;
}

// Gaussian window. The surface is not the plane that an affine warp assumes, and its curvature biases positions by the
// mean square of the window's width; therefore the window is narrow and falls off smoothly.
const std::array<PatchRow, kPatchSide_px> kWindow = [] {
    std::array<PatchRow, kPatchSide_px> window{};
    for (std::size_t row = 0; row < kPatchSide_px; ++row) {
        for (std::size_t c = 0; c < kPatchSide_px; ++c) {
            const double i = offset_px(c), j = offset_px(row);
            window[row][c] =
                static_cast<float>(std::exp(-0.5 * (i * i + j * j) / (kWindowDeviation_px * kWindowDeviation_px)));
        }
    }
    return window;
}();

// Subtracts the plane that fits a patch's values best: illumination changes slowly over a patch as the object turns,
// and is not texture.
void subtract_plane(Patch& patch) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right_side = Eigen::Vector3d::Zero();
    const auto each = [&](auto&& visit) {
        for (std::size_t row = 0; row < kPatchSide_px; ++row) {
            for (std::size_t c = 0; c < kPatchSide_px; ++c) {
                if (patch.counts[row][c] > 0) {
                    visit(Eigen::Vector3d(1, offset_px(c), offset_px(row)), patch.value[row][c]);
                }
            }
        }
    };
    each([&](const Eigen::Vector3d& at, float& value) {
        normal += at * at.transpose();
        right_side += at * static_cast<double>(value);
    });
    const Eigen::Vector3d plane = normal.ldlt().solve(right_side);
    each([&](const Eigen::Vector3d& at, float& value) { value -= static_cast<float>(plane.dot(at)); });
}

double samples(const Patch& patch) {
    double count = 0;
    for (const PatchRow& row : patch.counts) {
        for (const float counts : row) count += static_cast<double>(counts);
    }
    return count;
}

// Root mean square of a patch after level().
double contrast(const Patch& patch) {
    double squares = 0;
    for (const PatchRow& row : patch.value) {
        for (const float value : row) squares += static_cast<double>(value) * static_cast<double>(value);
    }
    return std::sqrt(squares / std::max(1.0, samples(patch)));
}

// One iteration of alignment: the image is gain * patch + a plane, and the warp is off by `step`. 13 unknowns, or 10 if
// curvature is known.
template <int kUnknowns>
struct Round {
    using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;
    Eigen::LDLT<Matrix> solver;
    Eigen::Matrix<double, kUnknowns, 1> solution;
    double noise = 0;
    double correlation = 0;  // of the texture and the part of the image that it explains
};

// Surfaces are rarely more curved than the object's silhouette.
constexpr double kCurvaturePrior = kTypicalNoise / (kTypicalCurvature * kTypicalCurvature);

template <int kUnknowns>
std::optional<Round<kUnknowns>> align_once(const PatchImage& image, const Patch& patch, const Warp& warp) {
    PatchSums sums(kUnknowns == kFlatPatchUnknowns);
    double count = 0;
    // Approximate value at the centre.
    const SeenRow middle = image.row(warp, 0);
    const float less = middle.value[kPatchHalf_px];
    for (std::size_t row = 0; row < kPatchSide_px; ++row) {
        const int j = static_cast<int>(row) - kPatchHalf_px;
        const SeenRow seen = j == 0 ? middle : image.row(warp, j);
        PatchRow weight;
        float counts = 0;
        for (std::size_t c = 0; c < kPatchColumns; ++c) {
            const float both = seen.counts[c] * patch.counts[row][c];
            weight[c] = kWindow[row][c] * both;
            counts += both;
        }
        count += static_cast<double>(counts);
        sums.add(j, seen, patch.value[row], weight, less);
    }
    if (count < kFewestSamples) return std::nullopt;
    const PatchEquations equations = sums.equations(warp.deeper);
    typename Round<kUnknowns>::Matrix normal = equations.normal.template topLeftCorner<kUnknowns, kUnknowns>();
    for (int k = kFlatPatchUnknowns; k < kUnknowns; ++k) normal(k, k) += kCurvaturePrior;
    Round<kUnknowns> round;
    round.solver.compute(normal);
    if (round.solver.info() != Eigen::Success || !(round.solver.vectorD().minCoeff() > 1e-9)) return std::nullopt;
    const Eigen::Matrix<double, kUnknowns, 1> right_side = equations.right_side.template head<kUnknowns>();
    round.solution = round.solver.solve(right_side);
    if (!round.solution.allFinite()) return std::nullopt;
    const double gain = 1 + round.solution[6];
    if (!(gain > 0.3 && gain < 3)) return std::nullopt;
    round.noise = std::max(0.05, (equations.squares - round.solution.dot(right_side)) / equations.weights);
    const double signal = gain * gain * equations.texture / equations.weights;
    round.correlation = std::sqrt(signal / (signal + round.noise));
    return round;
}

// Weight of an alignment with this information: uncertain directions have less weight. Symmetric.
glm::dmat2 whitening(const Eigen::Matrix2d& information) {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
    axes.computeDirect(information);
    Eigen::Vector2d weight = (axes.eigenvalues().cwiseMax(0.0)).cwiseSqrt() * kSharpDeviation_px;
    weight = weight.cwiseMin(1.0);
    const Eigen::Matrix2d w = axes.eigenvectors() * weight.asDiagonal() * axes.eigenvectors().transpose();
    return {w(0, 0), w(1, 0), w(0, 1), w(1, 1)};
}

template <int kUnknowns>
std::optional<Alignment> align_with(const PatchImage& image, const Patch& patch, Warp warp) {
    const Warp start = warp;
    constexpr double kEnough_px = kUnknowns == kFlatPatchUnknowns ? 0.003 : 0.02;
    std::optional<Round<kUnknowns>> round;
    glm::dvec3 curvature(0.0);  // relative to the initial warp
    for (int k = 0; k < kMostIterations; ++k) {
        // The centre must be on the object; samples outside it are invalid.
        if (!image.is_solid(warp.centre)) return std::nullopt;
        round = align_once<kUnknowns>(image, patch, warp);
        if (!round) return std::nullopt;
        const auto& step = round->solution;
        warp.centre += glm::dvec2(step[0], step[1]);
        warp.matrix += glm::dmat2(step[2], step[4], step[3], step[5]);  // columns
        for (int n = kFlatPatchUnknowns; n < kUnknowns; ++n) {
            curvature[n - kFlatPatchUnknowns] += step[n];
            warp.bent[static_cast<std::size_t>(n - kFlatPatchUnknowns)] += warp.deeper * step[n];
        }
        if (glm::distance(warp.centre, start.centre) > 2 * kFarthestMove_px) return std::nullopt;
        if (step.template head<2>().norm() < kEnough_px &&
            step.template segment<4>(2).norm() * kPatchHalf_px < 3 * kEnough_px) {
            break;
        }
    }
    if (round->correlation < kLeastCorrelation || !image.is_solid(warp.centre)) return std::nullopt;
    if (glm::distance(warp.centre, start.centre) > kFarthestMove_px) return std::nullopt;
    const glm::dmat2 change = warp.matrix - start.matrix;
    if (std::max(glm::length(change[0]), glm::length(change[1])) > 0.5) return std::nullopt;

    const typename Round<kUnknowns>::Matrix covariance = round->solver.solve(Round<kUnknowns>::Matrix::Identity());
    const Eigen::Matrix2d of_centre = covariance.template topLeftCorner<2, 2>().inverse() / round->noise;
    Alignment alignment{{0, warp.centre, whitening(of_centre)}, warp.matrix, curvature, {}};
    for (int n = kFlatPatchUnknowns; n < kUnknowns; ++n) {
        alignment.curvature_information[n - kFlatPatchUnknowns] =
            std::max(0.0, 1 / covariance(n, n) - kCurvaturePrior) / round->noise;
    }
    return alignment;
}

}  // namespace

std::optional<Patch> extract_patch(const PatchImage& image, glm::dvec2 centre) {
    Warp warp;
    warp.centre = centre;
    Patch patch;
    for (std::size_t row = 0; row < kPatchSide_px; ++row) {
        const SeenRow seen = image.row(warp, static_cast<int>(row) - kPatchHalf_px);
        patch.value[row] = seen.value;
        patch.counts[row] = seen.counts;
    }
    if (samples(patch) < kFewestSamples) return std::nullopt;
    subtract_plane(patch);
    if (contrast(patch) < kLeastPatchContrast) return std::nullopt;
    return patch;
}

std::optional<Alignment> align(const PatchImage& image, const Patch& patch, const Warp& warp, bool curvature_is_known) {
    return curvature_is_known ? align_with<kFlatPatchUnknowns>(image, patch, warp)
                              : align_with<kPatchUnknowns>(image, patch, warp);
}

}  // namespace rs::capture
