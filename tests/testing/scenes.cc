// SPDX-License-Identifier: BSD-3-Clause
#include "testing/scenes.h"

#include "geometry/rotation_angles.h"

namespace hexcal::testing {

BaseAndTool PaperMounts() {
  Vector6d base, tool;
  base << 0.008, 0.001, -0.004, 0.02, 0.01, 0.005;
  tool << 0.007, 0.002, -0.006, 0.03, 0.04, 0.001;
  return {PoseFromVector(base), PoseFromVector(tool)};
}

std::vector<Observation> PaperObservations() {
  const double table[6][6] = {{0.005, 0, 0, 0, 0, 0},
                              {0.005, 0, 0, 0.0872, 0, 0},
                              {0.005, 0.005, 0, 0.0872, 0, 0},
                              {0.005, 0.005, 0, 0.0872, 0.0523, 0},
                              {0.005, 0.005, 0.003, 0.0872, 0.0523, 0},
                              {0.005, 0.005, 0.003, 0.0872, 0.0523, 0.0349}};
  std::vector<Observation> rows;
  for (const auto& row : table) {
    Observation o;
    o.label = std::to_string(rows.size() + 1);
    o.base_from_platform = PoseFromVector(Eigen::Map<const Vector6d>(row));
    o.world_from_tool =
        PaperMounts().world_from_base * o.base_from_platform * PaperMounts().platform_from_tool;
    rows.push_back(o);
  }
  return rows;
}

Matrix6d TrackerLikeCovariance() {
  Vector6d sigma;
  sigma << 1e-4, 2e-4, 0.5e-4, 1e-3, 0.4e-3, 2e-3;
  Matrix6d correlation = Matrix6d::Identity();
  const auto correlate = [&](int i, int j, double r) { correlation(i, j) = correlation(j, i) = r; };
  correlate(0, 1, 0.5);
  correlate(0, 4, -0.4);
  correlate(2, 3, 0.6);
  correlate(1, 5, 0.3);
  correlate(3, 5, -0.2);
  return sigma.asDiagonal() * correlation * sigma.asDiagonal();
}

Matrix6d Isotropic(double position, double orientation) {
  Vector6d sigma;
  sigma << Eigen::Vector3d::Constant(position), Eigen::Vector3d::Constant(orientation);
  return sigma.cwiseAbs2().asDiagonal();
}

Observations KnownNoise(std::vector<Observation> rows, const Matrix6d& covariance) {
  for (Observation& o : rows) o.tool_covariance = covariance;
  Observations observations;
  observations.items = std::move(rows);
  observations.tool_noise_is_known = true;
  return observations;
}

Observations UnknownNoise(std::vector<Observation> rows) {
  Observations observations;
  observations.items = std::move(rows);
  return observations;
}

Eigen::Matrix<double, 12, 1> Difference(const BaseAndTool& estimate, const BaseAndTool& truth) {
  Eigen::Matrix<double, 12, 1> d;
  d << Minus(estimate.world_from_base, truth.world_from_base),
      Minus(estimate.platform_from_tool, truth.platform_from_tool);
  return d;
}

}  // namespace hexcal::testing
