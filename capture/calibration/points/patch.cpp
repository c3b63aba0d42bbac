#include "capture/calibration/points/patch.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace rs::capture {
namespace {

constexpr int kHalfSide_px = kPatchHalf_px;
constexpr std::size_t kSamples = kPatchSamples;
constexpr double kLeastCorrelation = 0.85;
constexpr double kFarthestMove_px = 3;      // from where the bundle expects the point
constexpr double kLeastContrast = 3;        // of a levelled patch's grey values; below, there is nothing to align
constexpr double kSharpDeviation_px = 0.1;  // an alignment surer than this in all directions has full weight
constexpr double kTypicalNoise = 4;         // grey values squared
constexpr double kWindowDeviation_px = 3;
constexpr int kMostIterations = 10;

constexpr std::size_t kFewestSamples = 40;

// The surface is not the plane that an affine warp is right for, and its curvature moves what is found by the mean
// square of the window's width: so the window falls off gently, and is narrow.
const std::array<double, kSamples> kWindow = [] {
    std::array<double, kSamples> window{};
    for (std::size_t n = 0; n < kSamples; ++n) {
        const std::size_t column = n % kPatchSide_px, row = n / kPatchSide_px;
        const double i = static_cast<double>(column) - kHalfSide_px;
        const double j = static_cast<double>(row) - kHalfSide_px;
        window[n] = std::exp(-0.5 * (i * i + j * j) / (kWindowDeviation_px * kWindowDeviation_px));
    }
    return window;
}();

// Bilinear; (x, y) in px with centres at +0.5, at least one pixel inside.
float sample(const Image<float>& picture, double x, double y) {
    const int left = static_cast<int>(std::floor(x - 0.5));
    const int top = static_cast<int>(std::floor(y - 0.5));
    const auto u = static_cast<float>(x - 0.5 - left);
    const auto v = static_cast<float>(y - 0.5 - top);
    const float upper = picture(left, top) * (1 - u) + picture(left + 1, top) * u;
    const float lower = picture(left, top + 1) * (1 - u) + picture(left + 1, top + 1) * u;
    return upper * (1 - v) + lower * v;
}

bool is_inside(const Image<std::uint8_t>& alpha, double x, double y) {
    const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
    return column >= 2 && row >= 2 && column < alpha.width() - 2 && row < alpha.height() - 2 &&
           alpha(column, row) > 250;
}

// The middle lies on the object; samples beside it do not count.
bool centre_is_inside(const Warp& warp, const Image<std::uint8_t>& alpha) {
    return is_inside(alpha, warp.centre.x, warp.centre.y);
}

Patch cut(const Image<float>& picture, const Image<std::uint8_t>& alpha, const Warp& warp) {
    Patch patch;
    std::size_t n = 0;
    for (int j = -kHalfSide_px; j <= kHalfSide_px; ++j) {
        for (int i = -kHalfSide_px; i <= kHalfSide_px; ++i, ++n) {
            const glm::dvec2 p = warp.at(i, j);
            patch.counts[n] = is_inside(alpha, p.x, p.y);
            patch.value[n] = patch.counts[n] ? sample(picture, p.x, p.y) : 0.0F;
        }
    }
    return patch;
}

// Takes the plane that fits a patch's values best away from them: light changes slowly over a patch as the object
// turns, and what changes with the light is no texture.
void level(Patch& patch) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right_side = Eigen::Vector3d::Zero();
    const auto each = [&](auto&& visit) {
        std::size_t n = 0;
        for (int j = -kHalfSide_px; j <= kHalfSide_px; ++j) {
            for (int i = -kHalfSide_px; i <= kHalfSide_px; ++i, ++n) {
                if (patch.counts[n]) visit(Eigen::Vector3d(1, i, j), patch.value[n]);
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

std::size_t samples(const Patch& patch) {
    return static_cast<std::size_t>(std::count(patch.counts.begin(), patch.counts.end(), true));
}

// Root mean square of a levelled patch.
double contrast(const Patch& patch) {
    double squares = 0;
    for (const float value : patch.value) squares += static_cast<double>(value) * static_cast<double>(value);
    return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, samples(patch))));
}

// One round of alignment: what the picture shows there is gain * patch + a plane, and the warp is off by `step`.
struct Round {
    Eigen::Matrix<double, 6, 1> step;    // centre x, y; matrix row by row
    Eigen::Matrix2d centre_information;  // of the centre, in 1/px^2, everything else being unknown
    glm::dvec3 curvature_step{0.0};      // 1/px
    glm::dvec3 curvature_information{0.0};
    double correlation = 0;  // of texture and what is explained by it
};

std::optional<Round> align_once(const Image<float>& picture, const Image<std::uint8_t>& alpha, const Patch& patch,
                                const Warp& warp, bool curvature_is_known) {
    constexpr int kUnknowns = 13;  // warp 6, gain, plane 3, curvature 3
    Eigen::Matrix<double, kUnknowns, kUnknowns> normal = Eigen::Matrix<double, kUnknowns, kUnknowns>::Zero();
    Eigen::Matrix<double, kUnknowns, 1> right_side = Eigen::Matrix<double, kUnknowns, 1>::Zero();
    const Patch seen = cut(picture, alpha, warp);
    double squares = 0, texture = 0, weights = 0;
    std::size_t count = 0;
    std::size_t n = 0;
    for (int j = -kHalfSide_px; j <= kHalfSide_px; ++j) {
        for (int i = -kHalfSide_px; i <= kHalfSide_px; ++i, ++n) {
            if (!seen.counts[n] || !patch.counts[n]) continue;
            const glm::dvec2 p = warp.at(i, j);
            const double sx = 0.5 * static_cast<double>(sample(picture, p.x + 1, p.y) - sample(picture, p.x - 1, p.y));
            const double sy = 0.5 * static_cast<double>(sample(picture, p.x, p.y + 1) - sample(picture, p.x, p.y - 1));
            const auto wanted = static_cast<double>(patch.value[n]);
            const auto value = static_cast<double>(seen.value[n]);
            Eigen::Matrix<double, kUnknowns, 1> slope;
            const double when_deeper = sx * warp.deeper.x + sy * warp.deeper.y;
            slope << -sx, -sy, -sx * i, -sx * j, -sy * i, -sy * j, wanted, 1, i, j, -0.5 * when_deeper * i * i,
                -0.5 * when_deeper * j * j, -when_deeper * i * j;
            const double weight = kWindow[n];
            normal.noalias() += slope * (weight * slope).transpose();
            right_side += (weight * value) * slope;
            squares += weight * value * value;
            texture += weight * wanted * wanted;
            weights += weight;
            ++count;
        }
    }
    if (count < kFewestSamples) return std::nullopt;
    // Held at what is known, or near nothing known: surfaces are rarely more curved than the object's outline.
    const double prior = curvature_is_known ? 1e12 : kTypicalNoise / (kTypicalCurvature * kTypicalCurvature);
    for (int k = 10; k < kUnknowns; ++k) normal(k, k) += prior;
    const Eigen::LDLT<Eigen::Matrix<double, kUnknowns, kUnknowns>> solver(normal);
    if (solver.info() != Eigen::Success || !(solver.vectorD().minCoeff() > 1e-9)) return std::nullopt;
    const Eigen::Matrix<double, kUnknowns, 1> solution = solver.solve(right_side);
    if (!solution.allFinite()) return std::nullopt;
    const double gain = solution[6];
    if (!(gain > 0.3 && gain < 3)) return std::nullopt;
    const double noise = std::max(0.05, (squares - solution.dot(right_side)) / weights);
    const double signal = gain * gain * texture / weights;
    Round round;
    round.step = solution.head<6>();
    const Eigen::Matrix<double, kUnknowns, kUnknowns> covariance =
        solver.solve(Eigen::Matrix<double, kUnknowns, kUnknowns>::Identity());
    round.centre_information = covariance.topLeftCorner<2, 2>().inverse() / noise;
    for (int k = 0; k < 3; ++k) {
        round.curvature_step[k] = solution[10 + k];
        round.curvature_information[k] = std::max(0.0, 1 / covariance(10 + k, 10 + k) - prior) / noise;
    }
    round.correlation = std::sqrt(signal / (signal + noise));
    return round;
}

// How an alignment with this information counts: directions in which it is vague count less. Symmetric.
glm::dmat2 whitening(const Eigen::Matrix2d& information) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(information);
    Eigen::Vector2d weight = (axes.eigenvalues().cwiseMax(0.0)).cwiseSqrt() * kSharpDeviation_px;
    weight = weight.cwiseMin(1.0);
    const Eigen::Matrix2d w = axes.eigenvectors() * weight.asDiagonal() * axes.eigenvectors().transpose();
    return {w(0, 0), w(1, 0), w(0, 1), w(1, 1)};
}

}  // namespace

Image<float> smoothed(const Image<std::uint8_t>& grey) {
    constexpr std::array<float, 5> kKernel{0.03F, 0.235F, 0.47F, 0.235F, 0.03F};
    const int width = grey.width(), height = grey.height();
    Image<float> across(width, height), result(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            float sum = 0;
            for (int k = -2; k <= 2; ++k) {
                sum += kKernel[static_cast<std::size_t>(k + 2)] *
                       static_cast<float>(grey(std::clamp(x + k, 0, width - 1), y));
            }
            across(x, y) = sum;
        }
    }
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            float sum = 0;
            for (int k = -2; k <= 2; ++k) {
                sum += kKernel[static_cast<std::size_t>(k + 2)] * across(x, std::clamp(y + k, 0, height - 1));
            }
            result(x, y) = sum;
        }
    }
    return result;
}

std::optional<Patch> textured_patch(const Image<float>& picture, const Image<std::uint8_t>& alpha, glm::dvec2 centre) {
    Warp warp;
    warp.centre = centre;
    Patch patch = cut(picture, alpha, warp);
    if (samples(patch) < kFewestSamples) return std::nullopt;
    level(patch);
    if (contrast(patch) < kLeastContrast) return std::nullopt;
    return patch;
}

std::optional<Alignment> align(const Image<float>& picture, const Image<std::uint8_t>& alpha, const Patch& patch,
                               Warp warp, bool curvature_is_known) {
    const Warp start = warp;
    std::optional<Round> round;
    glm::dvec3 curvature(0.0);  // beside what the warp began with
    for (int k = 0; k < kMostIterations; ++k) {
        if (!centre_is_inside(warp, alpha)) return std::nullopt;
        round = align_once(picture, alpha, patch, warp, curvature_is_known);
        if (!round) return std::nullopt;
        const auto& step = round->step;
        warp.centre += glm::dvec2(step[0], step[1]);
        warp.matrix += glm::dmat2(step[2], step[4], step[3], step[5]);  // columns
        for (int n = 0; n < 3; ++n) {
            curvature[n] += round->curvature_step[n];
            warp.bent[static_cast<std::size_t>(n)] += warp.deeper * round->curvature_step[n];
        }
        if (glm::distance(warp.centre, start.centre) > 2 * kFarthestMove_px) return std::nullopt;
        const double enough = curvature_is_known ? 0.003 : 0.02;  // px
        if (step.head<2>().norm() < enough && step.tail<4>().norm() * kHalfSide_px < 3 * enough) break;
    }
    if (round->correlation < kLeastCorrelation || !centre_is_inside(warp, alpha)) return std::nullopt;
    if (glm::distance(warp.centre, start.centre) > kFarthestMove_px) return std::nullopt;
    const glm::dmat2 change = warp.matrix - start.matrix;
    if (std::max(glm::length(change[0]), glm::length(change[1])) > 0.5) return std::nullopt;
    return Alignment{
        {0, warp.centre, whitening(round->centre_information)}, warp.matrix, curvature, round->curvature_information};
}

}  // namespace rs::capture
