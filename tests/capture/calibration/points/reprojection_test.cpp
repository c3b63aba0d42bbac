#include "capture/calibration/points/reprojection.hpp"

#include "capture/calibration/model/projection.hpp"

#include <ceres/autodiff_cost_function.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace rs::capture {
namespace {

// The same residual with automatic derivatives by Ceres.
struct PlainReprojection {
    Observation seen;

    template <class T>
    bool operator()(const T* lens, const T* pose, const T* angle, const T* point, T* residuals) const {
        if (!project_turned(lens, pose, angle[0], point, residuals)) return false;
        const T dx = residuals[0] - T(seen.p.x);
        const T dy = residuals[1] - T(seen.p.y);
        residuals[0] = T(seen.weight[0][0]) * dx + T(seen.weight[1][0]) * dy;
        residuals[1] = T(seen.weight[0][1]) * dx + T(seen.weight[1][1]) * dy;
        return true;
    }
};

// Derivatives in Ceres' row-major layout.
struct Derived {
    std::array<double, 2> residual{};
    std::array<double, 10> by_lens{};
    std::array<double, 6> by_pose{};
    std::array<double, 2> by_angle{};
    std::array<double, 6> by_point{};
};

Derived derived(const TurntableModel& model, const glm::dvec3& point, const Observation& seen) {
    const std::array<double, 5> lens{model.lens.f_px, model.lens.cx, model.lens.cy, model.lens.k1, model.lens.k2};
    const std::array<double, 3> pose{model.pose.pan_rad, model.pose.tilt_rad, model.pose.roll_rad};
    const double& angle = model.angles_rad[static_cast<std::size_t>(seen.view)];
    const ceres::AutoDiffCostFunction<PlainReprojection, 2, 5, 3, 1, 3> plain(new PlainReprojection{seen});
    Derived d;
    const std::array<const double*, 4> blocks{lens.data(), pose.data(), &angle, &point.x};
    std::array<double*, 4> jacobians{d.by_lens.data(), d.by_pose.data(), d.by_angle.data(), d.by_point.data()};
    EXPECT_TRUE(plain.Evaluate(blocks.data(), d.residual.data(), jacobians.data()));
    return d;
}

// Column `column` of the two rows.
template <std::size_t N>
void expect_equal(const glm::dvec2& written, const std::array<double, N>& rows, std::size_t column, const char* what) {
    for (std::size_t row = 0; row < 2; ++row) {
        const double plain = rows[row * (N / 2) + column];
        EXPECT_NEAR(written[static_cast<int>(row)], plain, 1e-9 * std::max(1.0, std::abs(plain)))
            << what << " " << column;
    }
}

TEST(Reprojection, EqualsItsAutomaticDerivatives) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> d(-1, 1);
    for (int i = 0; i < 500; ++i) {
        Observation seen{i % 2, {300 + 200 * d(random), 200 + 200 * d(random)}, {}};
        const double shared = d(random);
        seen.weight = {{1 + d(random), shared}, {shared, 1 + d(random)}};
        const TurntableModel model{{640, 480, 900 + 300 * d(random), 320 + 20 * d(random), 240 + 20 * d(random),
                                    0.2 * d(random), 0.1 * d(random)},
                                   {0.3 * d(random), 0.7 * d(random), 1.6 * d(random)},
                                   {0, 3 * d(random)}};
        const glm::dvec3 point{0.4 * d(random), 0.4 * d(random), 0.4 * d(random)};
        const auto written = Reprojections(model).of(point, seen);
        ASSERT_TRUE(written.has_value());
        const Derived plain = derived(model, point, seen);
        expect_equal(written->residual, plain.residual, 0, "residual");
        for (std::size_t k = 0; k < 5; ++k) expect_equal(written->by_camera[k], plain.by_lens, k, "lens");
        for (std::size_t k = 0; k < 3; ++k) expect_equal(written->by_camera[5 + k], plain.by_pose, k, "pose");
        expect_equal(written->by_angle, plain.by_angle, 0, "angle");
        for (std::size_t k = 0; k < 3; ++k) expect_equal(written->by_point[k], plain.by_point, k, "point");
    }
}

TEST(Reprojection, ThereIsNoneBehindTheCamera) {
    const TurntableModel model{{640, 480, 900, 320, 240, 0, 0}, {}, {0}};
    EXPECT_FALSE(Reprojections(model).of({0, 0, 1.5}, {}).has_value());
    EXPECT_TRUE(Reprojections(model).of({0, 0, 0.5}, {}).has_value());
}

}  // namespace
}  // namespace rs::capture
