#include "capture/calibration/points/reprojection.hpp"

#include "capture/calibration/model/projection.hpp"

#include <ceres/autodiff_cost_function.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace rs::capture {
namespace {

// The same residual, differentiated by Ceres.
struct PlainReprojection {
    Observation seen;
    double turns = 1;

    template <class T>
    bool operator()(const T* lens, const T* pose, const T* angle, const T* point, T* residuals) const {
        const T at = angle[0] * T(turns);
        if (!project_turned(lens, pose, at, point, residuals)) return false;
        const T dx = residuals[0] - T(seen.p.x);
        const T dy = residuals[1] - T(seen.p.y);
        residuals[0] = T(seen.weight[0][0]) * dx + T(seen.weight[1][0]) * dy;
        residuals[1] = T(seen.weight[0][1]) * dx + T(seen.weight[1][1]) * dy;
        return true;
    }
};

struct Values {
    std::array<double, 2> residuals{};
    std::array<double, 10> by_lens{};
    std::array<double, 6> by_pose{};
    std::array<double, 2> by_angle{};
    std::array<double, 6> by_point{};
    bool ok = false;
};

struct Numbers {
    std::array<double, 5> lens;
    std::array<double, 3> pose;
    double angle;
    std::array<double, 3> point;
};

Values evaluate(const ceres::CostFunction& cost, const Numbers& at) {
    Values v;
    const std::array<const double*, 4> blocks{at.lens.data(), at.pose.data(), &at.angle, at.point.data()};
    std::array<double*, 4> jacobians{v.by_lens.data(), v.by_pose.data(), v.by_angle.data(), v.by_point.data()};
    v.ok = cost.Evaluate(blocks.data(), v.residuals.data(), jacobians.data());
    return v;
}

template <std::size_t N>
void expect_equal(const std::array<double, N>& a, const std::array<double, N>& b, const char* what) {
    for (std::size_t i = 0; i < N; ++i) {
        EXPECT_NEAR(a[i], b[i], 1e-9 * std::max(1.0, std::abs(b[i]))) << what << " " << i;
    }
}

TEST(Reprojection, EqualsItsAutomaticDerivatives) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> d(-1, 1);
    for (int i = 0; i < 500; ++i) {
        Observation seen;
        seen.p = {300 + 200 * d(random), 200 + 200 * d(random)};
        const double shared = d(random);
        seen.weight = {{1 + d(random), shared}, {shared, 1 + d(random)}};
        const double turns = i % 3 == 0 ? 7 : 1;
        const Numbers at{
            {900 + 300 * d(random), 320 + 20 * d(random), 240 + 20 * d(random), 0.2 * d(random), 0.1 * d(random)},
            {0.3 * d(random), 0.7 * d(random), 1.6 * d(random)},
            3 * d(random),
            {0.4 * d(random), 0.4 * d(random), 0.4 * d(random)}};
        const Values written = evaluate(Reprojection(seen, turns), at);
        const ceres::AutoDiffCostFunction<PlainReprojection, 2, 5, 3, 1, 3> plain(new PlainReprojection{seen, turns});
        const Values derived = evaluate(plain, at);
        ASSERT_TRUE(written.ok && derived.ok);
        expect_equal(written.residuals, derived.residuals, "residual");
        expect_equal(written.by_lens, derived.by_lens, "lens");
        expect_equal(written.by_pose, derived.by_pose, "pose");
        expect_equal(written.by_angle, derived.by_angle, "angle");
        expect_equal(written.by_point, derived.by_point, "point");
    }
}

TEST(Reprojection, FailsBehindTheCamera) {
    const Numbers behind{{900, 320, 240, 0, 0}, {0, 0, 0}, 0, {0, 0, 1.5}};
    EXPECT_FALSE(evaluate(Reprojection({}, 1), behind).ok);
}

TEST(Reprojection, WritesOnlyTheDerivativesAskedFor) {
    const Numbers at{{900, 320, 240, 0, 0}, {0.1, 0.2, 0}, 0.3, {0.1, 0, 0.2}};
    const std::array<const double*, 4> blocks{at.lens.data(), at.pose.data(), &at.angle, at.point.data()};
    const Values all = evaluate(Reprojection({}, 1), at);
    Values some;
    std::array<double*, 4> jacobians{nullptr, some.by_pose.data(), nullptr, nullptr};
    ASSERT_TRUE(Reprojection({}, 1).Evaluate(blocks.data(), some.residuals.data(), jacobians.data()));
    EXPECT_EQ(some.residuals, all.residuals);
    EXPECT_EQ(some.by_pose, all.by_pose);
    ASSERT_TRUE(Reprojection({}, 1).Evaluate(blocks.data(), some.residuals.data(), nullptr));
    EXPECT_EQ(some.residuals, all.residuals);
}

}  // namespace
}  // namespace rs::capture
