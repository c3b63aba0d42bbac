#include "capture/calibration/points/patch_equations.hpp"

#include <array>

namespace rs::capture {
namespace {

void add_row(PatchRow& sum, const PatchRow& row) {
    for (std::size_t c = 0; c < kPatchColumns; ++c) sum[c] += row[c];
}

PatchRow times(const PatchRow& a, const PatchRow& b) {
    PatchRow product;
    for (std::size_t c = 0; c < kPatchColumns; ++c) product[c] = a[c] * b[c];
    return product;
}

}  // namespace

PatchSums::PatchSums(bool curvature_is_known) {
    const int more = curvature_is_known ? 0 : 1;
    const int square = 2 + 2 * more, single = 1 + more;
    degree_[kXX] = degree_[kXY] = degree_[kYY] = square;
    degree_[kXT] = degree_[kYT] = degree_[kXR] = degree_[kYR] = single;
    degree_[kX] = degree_[kY] = single + 1;
    degree_[kT] = degree_[kR] = 1;
    degree_[kTT] = degree_[kTR] = degree_[kRR] = 0;
    degree_[kOne] = 2;
    for (std::size_t p = 0; p < kProducts; ++p) {
        for (int b = 0; b <= degree_[p]; ++b) sums_[p][static_cast<std::size_t>(b)].fill(0);
    }
}

void PatchSums::add(int j, const SeenRow& seen, const PatchRow& texture, const PatchRow& weight, float less) {
    PatchRow rest;
    for (std::size_t c = 0; c < kPatchColumns; ++c) rest[c] = seen.value[c] - less - texture[c];
    const PatchRow wx = times(weight, seen.slope_x), wy = times(weight, seen.slope_y);
    const PatchRow wt = times(weight, texture), wr = times(weight, rest);
    const auto by_powers = [&](Product product, PatchRow row) {
        const auto p = static_cast<std::size_t>(product);
        add_row(sums_[p][0], row);
        for (int b = 1; b <= degree_[p]; ++b) {
            for (float& value : row) value *= static_cast<float>(j);
            add_row(sums_[p][static_cast<std::size_t>(b)], row);
        }
    };
    by_powers(kXX, times(wx, seen.slope_x));
    by_powers(kXY, times(wx, seen.slope_y));
    by_powers(kYY, times(wy, seen.slope_y));
    by_powers(kXT, times(wx, texture));
    by_powers(kYT, times(wy, texture));
    by_powers(kX, wx);
    by_powers(kY, wy);
    by_powers(kT, wt);
    by_powers(kTT, times(wt, texture));
    by_powers(kXR, times(wx, rest));
    by_powers(kYR, times(wy, rest));
    by_powers(kTR, times(wt, rest));
    by_powers(kR, wr);
    by_powers(kRR, times(wr, rest));
    by_powers(kOne, weight);
}

double PatchSums::moment(Product product, int a, int b) const {
    const PatchRow& sums = sums_[static_cast<std::size_t>(product)][static_cast<std::size_t>(b)];
    double moment = 0;
    for (std::size_t c = 0; c + 1 < kPatchColumns; ++c) {
        const double i = static_cast<double>(c) - kPatchHalf_px;
        double value = static_cast<double>(sums[c]);
        for (int k = 0; k < a; ++k) value *= i;
        moment += value;
    }
    return moment;
}

PatchEquations PatchSums::equations(const glm::dvec2& deeper) const {
    // Each unknown's derivative is factor * (slope x, slope y, texture or 1) * i^a j^b; curvatures have two such terms.
    enum Kind { kSlopeX, kSlopeY, kTexture, kPlane };
    struct Term {
        Kind kind;
        int a, b;
    };
    constexpr std::array<Term, 16> kTerms{{{kSlopeX, 0, 0},
                                           {kSlopeY, 0, 0},
                                           {kSlopeX, 1, 0},
                                           {kSlopeX, 0, 1},
                                           {kSlopeY, 1, 0},
                                           {kSlopeY, 0, 1},
                                           {kTexture, 0, 0},
                                           {kPlane, 0, 0},
                                           {kPlane, 1, 0},
                                           {kPlane, 0, 1},
                                           {kSlopeX, 2, 0},
                                           {kSlopeX, 0, 2},
                                           {kSlopeX, 1, 1},
                                           {kSlopeY, 2, 0},
                                           {kSlopeY, 0, 2},
                                           {kSlopeY, 1, 1}}};
    constexpr std::array<std::array<Product, 4>, 4> kProduct{
        {{kXX, kXY, kXT, kX}, {kXY, kYY, kYT, kY}, {kXT, kYT, kTT, kT}, {kX, kY, kT, kOne}}};
    constexpr std::array<Product, 4> kWithRest{kXR, kYR, kTR, kR};
    const bool is_flat = degree_[kXX] < 4;
    const std::size_t count = is_flat ? kFlatPatchUnknowns : kTerms.size();

    // Moments are computed once for each product, because several pairs of terms share them.
    std::array<std::array<std::array<double, kPowers>, kPowers>, kProducts> moments{};
    for (std::size_t p = 0; p < kProducts; ++p) {
        for (int a = 0; a <= degree_[p]; ++a) {
            for (int b = 0; a + b <= degree_[p]; ++b) {
                moments[p][static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] =
                    moment(static_cast<Product>(p), a, b);
            }
        }
    }
    const auto of = [&](Product product, int a, int b) {
        return moments[static_cast<std::size_t>(product)][static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
    };
    Eigen::Matrix<double, 16, 16> by_terms;
    Eigen::Matrix<double, 16, 1> rest_by_terms;
    for (std::size_t k = 0; k < count; ++k) {
        const Term& t = kTerms[k];
        rest_by_terms(static_cast<Eigen::Index>(k)) = of(kWithRest[t.kind], t.a, t.b);
        for (std::size_t l = 0; l <= k; ++l) {
            const Term& u = kTerms[l];
            by_terms(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l)) =
                by_terms(static_cast<Eigen::Index>(l), static_cast<Eigen::Index>(k)) =
                    of(kProduct[t.kind][u.kind], t.a + u.a, t.b + u.b);
        }
    }
    PatchEquations equations;
    equations.squares = of(kRR, 0, 0);
    equations.texture = of(kTT, 0, 0);
    equations.weights = of(kOne, 0, 0);
    Eigen::Matrix<double, 16, kPatchUnknowns> factors = Eigen::Matrix<double, 16, kPatchUnknowns>::Zero();
    for (int k = 0; k < kFlatPatchUnknowns; ++k) factors(k, k) = k < 6 ? -1 : 1;
    if (is_flat) {
        const auto flat = factors.topLeftCorner<kFlatPatchUnknowns, kFlatPatchUnknowns>();
        equations.normal.topLeftCorner<kFlatPatchUnknowns, kFlatPatchUnknowns>() =
            flat.transpose() * by_terms.topLeftCorner<kFlatPatchUnknowns, kFlatPatchUnknowns>() * flat;
        equations.right_side.head<kFlatPatchUnknowns>() = flat.transpose() * rest_by_terms.head<kFlatPatchUnknowns>();
        return equations;
    }
    for (int k = 0; k < 3; ++k) {
        const double share = k < 2 ? -0.5 : -1;
        factors(10 + k, 10 + k) = share * deeper.x;
        factors(13 + k, 10 + k) = share * deeper.y;
    }
    equations.normal = factors.transpose() * by_terms * factors;
    equations.right_side = factors.transpose() * rest_by_terms;
    return equations;
}

}  // namespace rs::capture
