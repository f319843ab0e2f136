// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/grown_repeat.h"

#include <glog/logging.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <utility>

#include "geometry/linear_algebra.h"

namespace hexcal {
namespace {

constexpr int kMaxSteps = 400;  // most take ten; a wave of hardly any height has a long valley
// Squared length of a step in standard deviations after which nothing is left to do.
constexpr double kArrived = 1e-8;
// Of a step so short the derivative, which is that at the measured pose, tells no sign of the cost.
constexpr double kNear = 0.1;
// Steps that turn back with so much of the square of their length go too far each time.
constexpr double kSlow = 0.1;
// Damping in units of the solution's curvature: where a step is too long first, and then.
constexpr double kFirstDamping = 0.1, kTighten = 4.0, kEase = 0.1, kLeastDamping = 1e-3;
// Keeps steps finite where a wave has no height left.
constexpr double kLeastCurvature = 1e-9;

// A root of a symmetric matrix that may have no full rank.
Eigen::MatrixXd RootOf(const Eigen::MatrixXd& covariance) {
  const Eigenvalues eigen = DecomposeSymmetric(covariance);
  return eigen.vectors * eigen.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

// The same of parameters of very different sizes.
Eigen::MatrixXd ScaledRootOf(const Eigen::MatrixXd& covariance) {
  const Eigen::VectorXd sigma = covariance.diagonal().cwiseSqrt();
  const Eigen::VectorXd inverse = sigma.unaryExpr([](double s) { return s > 0.0 ? 1.0 / s : 0.0; });
  return sigma.asDiagonal() * RootOf(inverse.asDiagonal() * covariance * inverse.asDiagonal());
}

class GrownRepetition final : public Repetition {
 public:
  explicit GrownRepetition(const GrownSolution& solution)
      : solution_(solution),
        problem_(solution.Problem()),
        covariance_(solution.fit.covariance),
        root_(ScaledRootOf(covariance_)),
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

  struct Here {
    Eigen::VectorXd residual;
    Eigen::VectorXd gradient;  // by steps in standard deviations, as the curvature
    Eigen::MatrixXd curvature;
    double cost = 0.0;
  };

  std::optional<Here> EvaluateAt(const Noise& noise, const Eigen::VectorXd& at) const {
    const Mounts& mounts = solution_.fit.mounts;
    const auto found =
        problem_.Evaluate({Plus(mounts.world_from_base, Vector6d(at.head<6>())),
                           Plus(mounts.platform_from_tool, Vector6d(at.segment<6>(6)))},
                          solution_.fit.free + at.tail(at.size() - 12),
                          true);
    if (!found) return std::nullopt;
    const Eigen::Index others = problem_.num_rows() - 6 * static_cast<Eigen::Index>(roots_.size());
    Here here;
    here.residual.resize(problem_.num_rows());
    for (std::size_t i = 0; i < roots_.size(); ++i)
      here.residual.segment<6>(6 * static_cast<Eigen::Index>(i)) =
          solution_.data.poses[i].whitener *
          Minus(found->seen[i] * noise.seen_from_measured[i], found->predicted[i]);
    here.residual.tail(others) =
        found->residual.tail(others) - at_fit_.residual.tail(others) + noise.whitened.tail(others);
    const Eigen::MatrixXd jacobian = found->jacobian * root_;
    here.gradient = jacobian.transpose() * here.residual;
    here.curvature = jacobian.transpose() * jacobian;
    here.cost = here.residual.squaredNorm();
    if (!std::isfinite(here.cost)) return std::nullopt;
    return here;
  }

  // Levenberg and Marquardt's steps from the solution until they are nothing. The curvature is that
  // of where it stands: of a wave it grows as the square of the amplitude.
  bool Solve(const Noise& noise, Eigen::VectorXd* at) const {
    at->setZero();
    std::optional<Here> here = EvaluateAt(noise, *at);
    double damping = 0.0, last_size = 0.0;
    Eigen::VectorXd last = Eigen::VectorXd::Zero(at->size());
    for (int k = 0; here && k < kMaxSteps; ++k) {
      Eigen::MatrixXd curvature = here->curvature;
      curvature.diagonal().array() += damping + kLeastCurvature;
      const Eigen::VectorXd step = -curvature.llt().solve(here->gradient);
      const double size = -step.dot(here->gradient);
      if (!std::isfinite(size)) return false;
      const Eigen::VectorXd next = *at + root_ * step;
      std::optional<Here> there = EvaluateAt(noise, next);
      const bool is_better = there && (there->cost <= here->cost || size < kNear);
      if (size * (1.0 + damping) < kArrived) {
        if (is_better) *at = next;
        return true;
      }
      const bool reverses = last.dot(step) < 0.0 && size > kSlow * last_size;
      last = step, last_size = size;
      damping = !is_better ? std::max(kTighten * damping, kFirstDamping)
                : reverses ? std::max(damping, 1.0)
                           : (damping > kLeastDamping ? kEase * damping : 0.0);
      if (!is_better) continue;
      *at = next;
      here = std::move(there);
    }
    return false;
  }

  const GrownSolution& solution_;
  GrownProblem problem_;
  GrownProblem::Evaluation at_fit_;
  const Eigen::MatrixXd& covariance_;
  Eigen::MatrixXd root_;
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
