// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "discovery/gap_noise.h"
#include "discovery/linear_problem.h"
#include "measurement/hexapod_geometry.h"

namespace hexcal {

// How well a hexapod that the controller might compute with explains a gap by errors of its joints'
// places and of its legs' zeros. Where these are none, the pose is right whatever the hexapod; with
// them the error is smooth in the pose, and its shape tells of the hexapod.

// The poses of a linear problem, as the controller reports them.
struct ReportedGap {
  const LinearProblem* problem = nullptr;  // base and tool, and effects given, as nuisances
  std::vector<Pose3d> base_from_platform;  // one a pose of the problem
  Pose3d platform_from_tool;
  Pose3d home;  // centre of the travel

  ReportedGap Restricted(const LinearProblem& part, const std::vector<int>& poses) const;
};

// Leg offsets (6), gains of the legs about home (6: what they are over a leg's mean length, m),
// places of the base's joints (18: x, y, z of joint 1, ...), and of the platform's. All are metres
// and equally plausible: an error in proportion to the machine.
inline constexpr int kGeometryErrors = 48;
// 6 poses x 48: d(world_from_tool, right twist, frame T) / d(error), [m, rad] per m, where there
// are no errors yet.
Eigen::MatrixXd GeometryColumns(const ReportedGap& gap, const HexapodGeometry& hexapod);

// The likelihood of hexapods with the errors, which are Gaussian beforehand, integrated out (base
// and tool projected out: restricted likelihood). So a hexapod whose errors fit anything earns
// nothing by it.
class GeometryLikelihood {
 public:
  // Refers to gap. noise: of its poses.
  GeometryLikelihood(const ReportedGap& gap, const GapNoise& noise);

  // ln of the likelihood ratio against no errors at all. width: 1-sigma of each error, m. Minus
  // infinity for a hexapod that does not hold its platform in some pose.
  double LogGain(const HexapodGeometry& hexapod, double width) const;

  // The errors under their prior, and the nuisances beside them.
  struct Fit {
    Eigen::VectorXd nuisances, errors;
    double chi_square = 0.0;  // of the poses
    double freedom = 0.0;     // that errors of this width take, at most 48
  };
  Fit Solve(const HexapodGeometry& hexapod, double width) const;

 private:
  struct Normal {
    Eigen::MatrixXd columns, square;
    Eigen::VectorXd product;
  };
  Normal NormalOf(const HexapodGeometry& hexapod) const;

  const ReportedGap& gap_;
  const GapNoise& noise_;
  Eigen::MatrixXd nuisance_;  // whitened; pose rows
  Eigen::MatrixXd basis_;     // of it, pose rows
  Eigen::VectorXd error_, residual_;
};

}  // namespace hexcal
