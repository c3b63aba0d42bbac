#include "capture/calibration/silhouettes/silhouette_adjustment.hpp"

#include "capture/calibration/points/bundle.hpp"

#include <ceres/ceres.h>
#include <ceres/normal_prior.h>

#include <cmath>

namespace rs::capture {
namespace {

// Robustified residuals, whose squares are the Geman-McClure loss of the residuals, and their derivatives.
struct Robust {
    Eigen::ArrayXd values, slopes;

    Robust(const std::vector<double>& residuals, double outlier_px) {
        const Eigen::Map<const Eigen::ArrayXd> r(residuals.data(), static_cast<Eigen::Index>(residuals.size()));
        const Eigen::ArrayXd tail = 1 + (r / outlier_px).square();
        values = r / tail.sqrt();
        slopes = 1 / (tail * tail.sqrt());
    }
};

// Loss as a function of the sum of squares of all robustified residuals.
class SilhouetteLoss final : public ceres::LossFunction {
public:
    SilhouetteLoss(const SilhouetteErrors& errors, std::size_t residuals)
        : errors_(errors), expected_(static_cast<double>(residuals) * errors.deviation_px * errors.deviation_px) {}

    void Evaluate(double sum, double out[3]) const override {
        const bool is_more = errors_.is_least && sum > expected_;
        out[0] = errors_.independent * (is_more ? 1 + std::log(sum / expected_) : sum / expected_);
        out[1] = errors_.independent / (is_more ? sum : expected_);
        out[2] = is_more ? -out[1] / sum : 0;
    }

private:
    SilhouetteErrors errors_;
    double expected_;
};

class RobustResiduals final : public ceres::CostFunction {
public:
    RobustResiduals(SilhouetteAdjustment& of, const Eigen::VectorXd& z, double outlier_px)
        : of_(of), outlier_px_(outlier_px) {
        set_num_residuals(static_cast<int>(of.residuals(z).size()));
        mutable_parameter_block_sizes()->push_back(static_cast<int>(z.size()));
    }

    bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
        const Eigen::VectorXd z = Eigen::Map<const Eigen::VectorXd>(parameters[0], parameter_block_sizes()[0]);
        const Robust robust(of_.residuals(z), outlier_px_);
        Eigen::Map<Eigen::ArrayXd>(residuals, num_residuals()) = robust.values;
        if (jacobians != nullptr && jacobians[0] != nullptr) {
            using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
            Eigen::Map<RowMajor>(jacobians[0], num_residuals(), z.size()) =
                robust.slopes.matrix().asDiagonal() * of_.slopes(z);
        }
        return robust.values.allFinite();
    }

private:
    SilhouetteAdjustment& of_;
    double outlier_px_;
};

}  // namespace

void SilhouetteAdjustment::expect(const SilhouetteErrors& errors, double prior_scale) {
    errors_ = errors;
    disbelief_ = prior_scale;
}

const std::vector<double>& SilhouetteAdjustment::residuals(const Eigen::VectorXd& z) {
    if (residuals_.empty() || z_of_residuals_ != z) {
        residuals_ = comparison_.residuals(z);
        z_of_residuals_ = z;
    }
    return residuals_;
}

const Eigen::MatrixXd& SilhouetteAdjustment::slopes(const Eigen::VectorXd& z) {
    if (slopes_.size() > 0 && z_of_slopes_ == z) return slopes_;
    const Eigen::VectorXd& widths = comparison_.widths;
    const auto count = static_cast<Eigen::Index>(residuals(z).size());
    slopes_.resize(count, z.size());
    const SilhouetteResiduals beside = comparison_.beside ? comparison_.beside(z) : comparison_.residuals;
    for (Eigen::Index k = 0; k < z.size(); ++k) {
        Eigen::VectorXd before = z, behind = z;
        before(k) -= widths(k);
        behind(k) += widths(k);
        const std::vector<double> low = beside(before), high = beside(behind);
        slopes_.col(k) = (Eigen::Map<const Eigen::VectorXd>(high.data(), count) -
                          Eigen::Map<const Eigen::VectorXd>(low.data(), count)) /
                         (2 * widths(k));
    }
    z_of_slopes_ = z;
    return slopes_;
}

double SilhouetteAdjustment::cost(const Eigen::VectorXd& z) {
    double loss[3];
    SilhouetteLoss(errors_, residuals(z).size())
        .Evaluate(Robust(residuals(z), errors_.outlier_px).values.square().sum(), loss);
    return loss[0] + z.squaredNorm() / disbelief_;
}

bool SilhouetteAdjustment::improve(Eigen::VectorXd& z, int most_steps, double enough) {
    RobustResiduals robust(*this, z, errors_.outlier_px);
    SilhouetteLoss loss(errors_, residuals(z).size());
    ceres::NormalPrior known(Eigen::MatrixXd::Identity(z.size(), z.size()) / std::sqrt(disbelief_),
                             Eigen::VectorXd::Zero(z.size()));
    ceres::Problem::Options ownership;
    ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem problem(ownership);
    Eigen::VectorXd found = z;
    problem.AddResidualBlock(&robust, &loss, found.data());
    problem.AddResidualBlock(&known, nullptr, found.data());
    ceres::Solver::Options how;
    how.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    how.max_num_iterations = most_steps;
    how.function_tolerance = enough / errors_.independent;  // the cost where residuals are as expected
    how.num_threads = 1;
    how.logging_type = ceres::SILENT;
    silence_ceres();
    ceres::Solver::Summary summary;
    ceres::Solve(how, &problem, &summary);
    if (!summary.IsSolutionUsable()) return false;
    z = found;
    return true;
}

Eigen::MatrixXd SilhouetteAdjustment::information(const Eigen::VectorXd& z) {
    const Robust robust(residuals(z), errors_.outlier_px);
    double loss[3];
    SilhouetteLoss(errors_, residuals(z).size()).Evaluate(robust.values.square().sum(), loss);
    const Eigen::MatrixXd by_z = robust.slopes.matrix().asDiagonal() * slopes(z);
    return loss[1] * by_z.transpose() * by_z;
}

}  // namespace rs::capture
