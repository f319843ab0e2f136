// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/grown_repeat.h"

#include <glog/logging.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "geometry/linear_algebra.h"

namespace hexcal {
namespace {

constexpr int kMaxSteps = 30;
// Squared length of a step in standard deviations after which nothing is left to do.
constexpr double kArrived = 1e-8;

// A root of a symmetric matrix that may have no full rank.
Matrix6d RootOf(const Matrix6d& covariance) {
  const Eigenvalues eigen = DecomposeSymmetric(covariance);
  return eigen.vectors * eigen.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

class GrownRepetition final : public Repetition {
 public:
  explicit GrownRepetition(const GrownSolution& solution)
      : solution_(solution),
        problem_(solution.Problem()),
        covariance_(solution.fit.covariance),
        root_of_common_(RootOf(solution.common)),
        sigma_(solution.CovarianceUnscaled().diagonal().cwiseSqrt()) {
    auto at_fit = problem_.Evaluate(solution.fit.mounts, solution.fit.free, true);
    CHECK(at_fit) << "a solution that cannot be evaluated";
    at_fit_ = std::move(*at_fit);
    for (const GrownPose& pose : solution.data.poses)
      roots_.push_back(pose.whitener.partialPivLu().solve(Matrix6d::Identity()));
  }

  const Eigen::VectorXd& sigma() const override { return sigma_; }

  Block Run(int draws, std::uint64_t seed, std::size_t number) const override {
    Block block;
    block.estimator.resize(sigma_.size(), draws);
    block.linear.resize(sigma_.size(), draws);
    std::seed_seq words{seed & 0xffffffffU, seed >> 32, static_cast<std::uint64_t>(number)};
    std::mt19937_64 rng(words);
    std::normal_distribution<double> normal;
    for (int k = 0; k < draws; ++k) {
      Noise noise = Draw([&] { return normal(rng); });
      Eigen::VectorXd at = -covariance_ * (at_fit_.jacobian.transpose() * noise.whitened);
      Vector6d common;
      for (double& value : common) value = normal(rng);
      common = root_of_common_ * common;
      block.linear.col(k) = at;
      block.linear.col(k).head<6>() += common;
      block.not_converged += !Solve(noise, &at);
      block.estimator.col(k) = at;
      const Pose3d& base = solution_.fit.mounts.world_from_base;
      block.estimator.col(k).head<6>() =
          Minus(Plus(Plus(base, Vector6d(at.head<6>())), common), base);
    }
    return block;
  }

 private:
  // Of every row, of variance one; and how far off what is seen it puts each pose.
  struct Noise {
    Eigen::VectorXd whitened;
    std::vector<Pose3d> seen_from_measured;
  };

  template <typename Normal>
  Noise Draw(const Normal& normal) const {
    Noise noise;
    noise.whitened.resize(problem_.num_rows());
    for (double& value : noise.whitened) value = normal();
    for (std::size_t i = 0; i < roots_.size(); ++i) {
      const Vector6d error =
          roots_[i] * noise.whitened.segment<6>(6 * static_cast<Eigen::Index>(i));
      noise.seen_from_measured.push_back(at_fit_.seen[i].Inverse() *
                                         Plus(at_fit_.predicted[i], error));
    }
    return noise;
  }

  // Gauss-Newton steps until they are nothing, the curvature that of the solution.
  bool Solve(const Noise& noise, Eigen::VectorXd* at) const {
    const Mounts& mounts = solution_.fit.mounts;
    const Eigen::Index pose_rows = 6 * static_cast<Eigen::Index>(roots_.size());
    const Eigen::Index others = problem_.num_rows() - pose_rows;
    for (int k = 0; k < kMaxSteps; ++k) {
      const auto here =
          problem_.Evaluate({Plus(mounts.world_from_base, Vector6d(at->head<6>())),
                             Plus(mounts.platform_from_tool, Vector6d(at->segment<6>(6)))},
                            solution_.fit.free + at->tail(at->size() - 12),
                            true);
      if (!here) return false;
      Eigen::VectorXd residual(problem_.num_rows());
      for (std::size_t i = 0; i < roots_.size(); ++i)
        residual.segment<6>(6 * static_cast<Eigen::Index>(i)) =
            solution_.data.poses[i].whitener *
            Minus(here->seen[i] * noise.seen_from_measured[i], here->predicted[i]);
      residual.tail(others) =
          here->residual.tail(others) - at_fit_.residual.tail(others) + noise.whitened.tail(others);
      const Eigen::VectorXd gradient = here->jacobian.transpose() * residual;
      const Eigen::VectorXd step = -covariance_ * gradient;
      const double size = -step.dot(gradient);
      if (!std::isfinite(size)) return false;
      *at += step;
      if (size < kArrived) return true;
    }
    return false;
  }

  const GrownSolution& solution_;
  GrownProblem problem_;
  GrownProblem::Evaluation at_fit_;
  const Eigen::MatrixXd& covariance_;
  Matrix6d root_of_common_;
  std::vector<Matrix6d> roots_;  // of the poses' covariances: the whiteners' inverses
  Eigen::VectorXd sigma_;
};

}  // namespace

PropagationCheck CheckGrownPropagation(const GrownSolution& solution,
                                       const Estimate& estimate,
                                       const MonteCarloOptions& options) {
  PropagationCheck check;
  check.why_not = WhyNotRepeated(solution.cleaned, estimate);
  if (!check.why_not.empty()) return check;
  return CheckRepetition(GrownRepetition(solution), options);
}

}  // namespace hexcal
