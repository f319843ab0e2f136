// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "residuals/marker_data.h"
#include "residuals/streamed_residual.h"

namespace hexcal {

// What the likelihood is made of at one point, its nuisances where they fit best.
struct MarkerFit {
  std::vector<Eigen::Vector3d> misfits;    // of each mean reading: measured - predicted, m, frame M
  std::vector<Pose3d> tracker_from_world;  // of each pose
  double squared_readings = 0.0;           // whitened misfits
  double squared_draws = 0.0;              // of the robot's noise, in its sigmas
  double draw_freedom = 0.0;               // degrees of freedom of the readings that the draws take
  Vector6d tool_variance = Vector6d::Zero();  // mean of the diagonals of ToolCovariance
};

// Maximum likelihood from marker readings. A reading of base marker b or tool marker t in pose i:
//   p = X_i b + n,   p = X_i world_from_base (A_i [+] r_i) platform_from_tool t + n,
//   n ~ N(0, diag(sigma^2)) in the tracker's axes, r_i ~ N(0, C_robot) in frame A,
// X_i = tracker_from_world. X_i (but of a static tracker) and r_i belong to one pose each: for
// every value of the other unknowns they are set to where they fit best (variable projection: Golub
// and Pereyra, SIAM J. Numer. Anal. 10 (1973)), so that the cost is that of the profile likelihood,
// its gradient is exact, and the normal matrix is the Schur complement of all parameters' one.
//
// Sums are taken over fixed chunks of poses in fixed order: results do not depend on threads.
class MarkerBatch final : public StreamedResidual {
 public:
  // Keeps a reference to data. sigma: of one reading along the tracker's axes, m.
  MarkerBatch(const MarkerData& data, const Eigen::Vector3d& sigma, int threads = 1);

  std::vector<int> BlockSizes() const override { return layout_.block_sizes; }
  NormalEquations Evaluate(double const* const* parameters) const override;

  // inverse: of the normal matrix there; it matters for draw_freedom only.
  MarkerFit FitAt(double const* const* parameters, const Eigen::MatrixXd& inverse) const;

 private:
  const MarkerData& data_;
  MarkerLayout layout_;
  Eigen::Vector3d sigma_;
  int threads_;
};

}  // namespace hexcal
