// The adjustment of residuals that are linear in their numbers, with known solutions.

#include "capture/calibration/silhouettes/silhouette_adjustment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace rs::capture {
namespace {

// Residuals z - at of both numbers, each `times` times, then others that are constant.
struct Line {
    Eigen::Vector2d at{1, -2};
    int times = 50;
    std::vector<double> others = {};
    int asked = 0;

    SilhouetteComparison comparison() {
        const auto residuals = [this](const Eigen::VectorXd& z) {
            ++asked;
            std::vector<double> all;
            for (int i = 0; i < times; ++i) all.insert(all.end(), {z(0) - at(0), z(1) - at(1)});
            all.insert(all.end(), others.begin(), others.end());
            return all;
        };
        return {residuals, Eigen::VectorXd::Constant(2, 0.1)};
    }
};

constexpr double kFar_px = 1e6;  // no residual is an outlier

Eigen::VectorXd adjusted(Line& line, const SilhouetteErrors& errors, double prior_scale = 1) {
    SilhouetteAdjustment adjustment(line.comparison(), errors);
    adjustment.expect(errors, prior_scale);
    Eigen::VectorXd z = Eigen::VectorXd::Zero(2);
    EXPECT_TRUE(adjustment.improve(z, 50, 1e-9));
    return z;
}

TEST(SilhouetteAdjustment, WeighsSilhouettesAgainstThePrior) {
    Line line;
    const SilhouetteErrors errors{4, kFar_px, 0.5};
    // Each number is measured by half of the four points: an information of 2 / 0.25, plus 1 of the prior.
    const double share = 8.0 / 9.0;
    const Eigen::VectorXd z = adjusted(line, errors);
    EXPECT_NEAR(z(0), share * 1, 1e-6);
    EXPECT_NEAR(z(1), share * -2, 1e-6);
    SilhouetteAdjustment adjustment(line.comparison(), errors);
    const Eigen::MatrixXd information = adjustment.information(z);
    EXPECT_NEAR(information(0, 0), 8, 1e-6);
    EXPECT_NEAR(information(0, 1), 0, 1e-6);
    EXPECT_NEAR(adjustment.cost(z), 8 * std::pow(1 - share, 2) * 5 + share * share * 5, 1e-6);
    line.times = 500;  // of the same silhouettes
    EXPECT_NEAR(adjusted(line, errors)(0), share, 1e-6);
    EXPECT_NEAR(adjusted(line, errors, 10)(0), 80.0 / 81.0, 1e-6);
}

TEST(SilhouetteAdjustment, OutliersCountLittle) {
    Line line;
    const SilhouetteErrors errors{1000, 1, 0.1};
    const double before = adjusted(line, errors)(0);
    line.others.assign(30, 40);
    EXPECT_NEAR(adjusted(line, errors)(0), before, 0.001);
    SilhouetteAdjustment adjustment(line.comparison(), errors);
    // 30 of 130 residuals saturate at outlier_px each, however large they are.
    EXPECT_NEAR(adjustment.cost(line.at), 1000 * 100 * 30 / 130.0 + 5, 30);
}

TEST(SilhouetteAdjustment, DeviationFollowsTheResiduals) {
    Line line;
    const SilhouetteErrors errors{40, kFar_px, 0.1, true};
    SilhouetteAdjustment fine(line.comparison(), errors);
    EXPECT_NEAR(fine.information(line.at)(0, 0), 40 / 0.01 / 2, 1e-3);  // limited by the deviation of 0.1 px
    line.others.assign(100, 0.5);
    line.others.insert(line.others.end(), 100, -0.5);
    SilhouetteAdjustment coarse(line.comparison(), errors);
    EXPECT_NEAR(coarse.information(line.at)(0, 0), 40.0 / (200 * 0.25) * 50, 1e-3);
    // At the minimum the derivative of the cost is zero: n dS / S + 2 z.
    const Eigen::VectorXd z = adjusted(line, errors);
    const double off = z(0) - 1, sum = 50 * 5 * off * off + 200 * 0.25;
    EXPECT_NEAR(40 * 50 * off / sum + z(0), 0, 1e-4);
}

TEST(SilhouetteAdjustment, AsksNothingTwiceAndRefusesWhatIsNotFinite) {
    Line line;
    SilhouetteAdjustment adjustment(line.comparison(), {4, kFar_px, 0.5});
    const Eigen::VectorXd z = Eigen::VectorXd::Zero(2);
    adjustment.information(z);
    const int asked = line.asked;
    EXPECT_EQ(asked, 1 + 2 * 2);
    adjustment.information(z);
    adjustment.cost(z);
    EXPECT_EQ(line.asked, asked);
    line.others.push_back(std::numeric_limits<double>::quiet_NaN());
    SilhouetteAdjustment none(line.comparison(), {4, kFar_px, 0.5});
    Eigen::VectorXd there = z;
    EXPECT_FALSE(none.improve(there, 5, 1e-3));
    EXPECT_EQ(there, z);
}

}  // namespace
}  // namespace rs::capture
