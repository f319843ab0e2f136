// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "estimator/calibrate.h"
#include "estimator/monte_carlo.h"
#include "residuals/pose_batch.h"

namespace hexcal {

// A calibration by poses that is to be repeated, as it was made.
struct RepeatedFit {
  CalibrateOptions options;            // solver, loss, start, iterations; outliers are not sought
  std::optional<BaseAndTool> initial;  // where the linearized iteration starts
  bool keeps_draws = false;  // as many as asked for, however long each may take; else a fifth
};

// The estimated machine measured again with the noise of every pose, and calibrated: by least
// squares, under a loss (from near the truth, so that its minimum is the one of the estimate), or
// by the linearized iteration from its own start.
class PoseRepetition final : public Repetition {
 public:
  // All must outlive it. levels: of the tool noise, where the observations do not know it.
  PoseRepetition(const Observations& observations,
                 const NoiseLevels& levels,
                 const Estimate& estimate,
                 const RepeatedFit& fit = {});

  const Eigen::VectorXd& sigma() const override { return sigma_; }
  Block Run(int draws, std::uint64_t seed, std::size_t number) const override;

  // Of the 12 by first order, the noise being as it is drawn: what sigma() is of.
  const Matrix12d& first_order() const { return first_order_; }

 private:
  using Gain = Eigen::Matrix<double, 12, 6>;

  void AddLeastSquares();
  void AddPaper();
  void AddCommon();
  template <typename Normal>
  Vector12d Draw(const Normal& normal, std::vector<Observation>* rows) const;
  bool Solve(const std::vector<Observation>& rows, BaseAndTool* mounts) const;
  bool SolveLeastSquares(const PoseBatch& batch, BaseAndTool* mounts) const;
  bool SolveAsCalibrate(const std::vector<Observation>& rows, BaseAndTool* mounts) const;

  const Observations& observations_;
  const NoiseLevels& levels_;
  const BaseAndTool& mounts_;
  const RepeatedFit fit_;
  std::vector<Matrix6d> covariances_, roots_;
  std::vector<Gain> gains_;  // of the linear estimator: what a draw of variance one moves it by
  PoseWeights weights_;
  Matrix6d root_of_common_ = Matrix6d::Zero();
  Matrix12d first_order_ = Matrix12d::Zero();
  Eigen::VectorXd sigma_;
};

// By how much the variance of an estimate under this loss exceeds that of least squares where the
// noise is Gaussian: Huber (1981), sec. 7.6, for residuals of six dimensions. 1 without a loss.
double VarianceUnderLoss(const RobustLoss& loss);

// The repetition of such a fit, and its covariance by first order.
struct FitPropagation {
  PropagationCheck check;
  Matrix12d first_order = Matrix12d::Zero();
};
FitPropagation CheckFitPropagation(const Observations& observations,
                                   const NoiseLevels& levels,
                                   const Estimate& estimate,
                                   const RepeatedFit& fit,
                                   const MonteCarloOptions& options);

}  // namespace hexcal
