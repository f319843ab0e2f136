// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "estimator/grown_levels.h"
#include "estimator/grown_solution.h"
#include "model/place_visits.h"
#include "residuals/pose_error.h"

namespace hexcal {

// Where a machine with effects says that the tool is, at any place, and how that depends on all
// that was estimated. Effects of the tracker and of markers do not move the tool: they count by
// their correlation with the mounts alone.
class GrownTarget {
 public:
  // solution: converged.
  explicit GrownTarget(std::shared_ptr<const GrownSolution> solution);

  // A row of the dataset: its own time, load, way there...; kNoRow: as PlaceVisits has it.
  static constexpr int kNoRow = -1;

  // The chain T_B^W T_A^B T_T^A with the effects in it.
  struct Chain {
    BaseAndTool mounts;
    Pose3d base_from_platform;
    Pose3d WorldFromPlatform() const { return mounts.world_from_base * base_from_platform; }
    Pose3d WorldFromTool() const { return WorldFromPlatform() * mounts.platform_from_tool; }
  };
  // step: off the solution, of the 12 and the free numbers. Nothing where the legs reach no pose.
  std::optional<Chain> ChainAt(const Pose3d& base_from_platform,
                               int row,
                               const Eigen::VectorXd& step) const;

  struct Uncertain {
    Chain chain;
    // d(right perturbation of world_from_tool) / d(the 12, the free numbers), 6 x size().
    Eigen::Matrix<double, 6, Eigen::Dynamic> by_parameters;
  };
  std::optional<Uncertain> At(const Pose3d& base_from_platform, int row) const;

  Eigen::Index size() const { return covariance_.rows(); }
  const GrownSolution& solution() const { return *solution_; }
  // size() x size(); of the 12, were the effects known exactly; the part of the first that comes
  // from priors.
  const Eigen::MatrixXd& covariance() const { return covariance_; }
  const Matrix12d& covariance_of_known_effects() const { return of_known_effects_; }
  const Eigen::MatrixXd& covariance_by_priors() const { return by_priors_; }
  // With which the trace of j covariance() j' is known, j by all parameters; where the noise was
  // estimated.
  std::optional<double> FreedomOf(const Eigen::MatrixXd& j) const;
  // The same machine, its noise as known as the fit took it to be.
  GrownTarget OfKnownNoise() const;

 private:
  Visit VisitAt(const Pose3d& base_from_platform, int row) const;
  Mounts MountsAt(const Eigen::VectorXd& step) const;
  const HexapodGeometry* hexapod() const { return solution_->data.hexapod; }

  std::shared_ptr<const GrownSolution> solution_;
  PlaceVisits places_;
  std::optional<GrownLevels> levels_;
  Eigen::MatrixXd covariance_, by_priors_;
  Matrix12d of_known_effects_;
};

}  // namespace hexcal
