// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "estimator/covariance.h"
#include "estimator/deletion.h"
#include "estimator/observations.h"

namespace hexcal {

// How sure the noise is that a pose's error is compared with.
enum class NoiseBasis {
  kStated,    // chi-square
  kScaled,    // stated, but for a common factor that the residuals have disproved: F
  kTwoLevels  // levels of position and orientation from the residuals: F of either
};

// How far a pose is off, in sigmas of what the other poses let expect, and how often chance alone
// brings a clean pose as far.
struct PoseTest {
  double statistic = 0.0;  // squared, externally studentised; 6 expected
  double p_value = 1.0;
  DeletionError off = {Vector6d::Zero(), Matrix6d::Identity()};  // studentised
};

// The least-squares fit to some of the poses, and how well each pose, in it or not, agrees.
class SubsetFit {
 public:
  // noise: in place of one that the observations do not know; else levels are estimated.
  SubsetFit(const Observations& observations, const std::optional<NoiseLevels>& noise);

  // kept: one a pose. near: mounts and levels from which Gauss-Newton steps lead to the fit.
  // is_nearest: the kept poses were taken because they fit best; what they leave is then smaller
  // than the noise by a factor that is known for Gaussian noise, and is corrected.
  void Fit(const std::vector<bool>& kept, bool is_nearest);
  void StartFrom(const BaseAndTool& mounts, const NoiseLevels& levels);

  PoseTest Test(std::size_t pose, bool with_p_value) const;

  // What the statistic of a clean pose exceeds with this probability, or a little more than that.
  double Limit(double probability) const;

  const BaseAndTool& mounts() const { return mounts_; }
  const NoiseLevels& levels() const { return levels_; }
  NoiseBasis basis() const { return basis_; }

 private:
  void Iterate(const Observations& kept);
  void SetFreedom(const Observations& kept, double variance_share);
  Matrix6d NoiseOf(const Observation& o) const;
  double Tail(double statistic, bool in_fit) const;

  const Observations& observations_;
  NoiseLevels rounding_;
  bool levels_estimated_;
  std::vector<bool> kept_;
  BaseAndTool mounts_;
  NoiseLevels levels_;
  double scale_ = 1.0;  // of the stated noise; 1 unless disproved
  NoiseBasis basis_ = NoiseBasis::kStated;
  Matrix12d covariance_ = Matrix12d::Zero();
  double freedom_ = 0.0;                                // degrees of freedom of all residuals
  double position_freedom_ = 0.0, turn_freedom_ = 0.0;  // of either part
};

}  // namespace hexcal
