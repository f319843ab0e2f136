// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "estimator/observations.h"
#include "residuals/pose_error.h"
#include "testing/random.h"

namespace hexcal::testing {

// The paper's Tables I and II: mounts as Tra(dx,dy,dz) Rot(x) Rot(y) Rot(z) of the preset errors,
// six poses, no noise.
BaseAndTool PaperMounts();
std::vector<Observation> PaperObservations();

// Poses within a hexapod's travel (+-40 mm, +-0.3 rad each axis about a height of 0.2 m) and what
// an exact tracker sees.
template <typename Rng>
std::vector<Observation> HexapodObservations(Rng& rng, const BaseAndTool& truth, int poses) {
  std::vector<Observation> rows(poses);
  for (int i = 0; i < poses; ++i) {
    rows[i].label = std::to_string(i + 1);
    rows[i].base_from_platform = SmallPose(rng, 0.04, 0.3);
    rows[i].base_from_platform.translation.z() += 0.2;
    rows[i].world_from_tool =
        truth.world_from_base * rows[i].base_from_platform * truth.platform_from_tool;
  }
  return rows;
}

template <typename Rng>
BaseAndTool AnyMounts(Rng& rng) {
  return {RandomPose(rng, 2.0), RandomPose(rng, 0.3)};
}

// A covariance of the size of an optical tracker's, unequal and far from diagonal: m^2, rad^2.
Matrix6d TrackerLikeCovariance();

// The same 1-sigma for each coordinate, m, and for each angle, rad.
Matrix6d Isotropic(double position, double orientation);
inline Matrix6d Isotropic(const NoiseLevels& levels) {
  return Isotropic(levels.position, levels.orientation);
}

Observations KnownNoise(std::vector<Observation> rows, const Matrix6d& covariance);
Observations UnknownNoise(std::vector<Observation> rows);

// Moves every measured pose by a draw of the covariance.
template <typename Rng>
void AddNoise(Rng& rng, const Matrix6d& covariance, std::vector<Observation>* rows) {
  const Matrix6d l = covariance.llt().matrixL();
  for (Observation& o : *rows)
    o.world_from_tool = Plus(o.world_from_tool, Vector6d(l * Normal(rng, 6)));
}

// The 12 differences [estimate [-] truth] of base and tool.
Eigen::Matrix<double, 12, 1> Difference(const BaseAndTool& estimate, const BaseAndTool& truth);

}  // namespace hexcal::testing
