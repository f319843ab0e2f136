// SPDX-License-Identifier: BSD-3-Clause
#include "hidden/legs.h"

#include <Eigen/Dense>
#include <cmath>

namespace hexcal::hidden {

using Square = Eigen::Matrix<double, 6, 6>;

Joints RadialAxes(const Joints& joints) {
  const Joints spread = joints.colwise() - joints.rowwise().mean();
  // The plate z = slope' (x, y), least squares along z: plates lie nearly level in their frames.
  const Eigen::Matrix<double, 6, 2> flat = spread.topRows<2>().transpose();
  const Eigen::Vector2d slope = Eigen::Matrix2d(flat.transpose() * flat).inverse() *
                                (flat.transpose() * spread.row(2).transpose());
  const Eigen::Vector3d normal = Eigen::Vector3d(-slope[0], -slope[1], 1).normalized();
  const Joints axes = spread - normal * (normal.transpose() * spread);
  return axes.colwise().normalized();
}

Six LegLengths(const Joints& base, const Joints& platform, const Motion& base_from_platform) {
  Six lengths;
  for (int i = 0; i < 6; ++i)
    lengths[i] = (base_from_platform * Eigen::Vector3d(platform.col(i)) - base.col(i)).norm();
  return lengths;
}

Joints LegDirections(const Joints& base, const Joints& platform, const Motion& base_from_platform) {
  Joints directions;
  for (int i = 0; i < 6; ++i)
    directions.col(i) =
        (base_from_platform * Eigen::Vector3d(platform.col(i)) - base.col(i)).normalized();
  return directions;
}

bool CloseLoop(const Joints& base,
               const Joints& platform,
               const Six& lengths,
               Motion* base_from_platform) {
  constexpr double kStep = 1e-6;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const Six open = lengths - LegLengths(base, platform, *base_from_platform);
    if (open.cwiseAbs().maxCoeff() < 2e-15) return true;
    Square slope;
    for (int k = 0; k < 6; ++k) {
      const Six d = kStep * Six::Unit(k);
      slope.col(k) = (LegLengths(base, platform, Moved(*base_from_platform, d)) -
                      LegLengths(base, platform, Moved(*base_from_platform, -d))) /
                     (2 * kStep);
    }
    const Six step = slope.partialPivLu().solve(open);
    if (!step.allFinite() || step.norm() > 1.0) return false;
    *base_from_platform = Moved(*base_from_platform, step);
    if (step.norm() < 1e-14) break;
  }
  return (lengths - LegLengths(base, platform, *base_from_platform)).cwiseAbs().maxCoeff() < 1e-12;
}

namespace {

Six Rolls(const Hexapod& hexapod, const Motion& base_from_platform) {
  const Joints u = LegDirections(hexapod.base, hexapod.platform, base_from_platform);
  Six rolls;
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector3d leg = u.col(i);
    const Eigen::Vector3d lower = Eigen::Vector3d(hexapod.base_axes.col(i)).cross(leg);
    const Eigen::Vector3d upper =
        Eigen::Vector3d(base_from_platform.turn * hexapod.platform_axes.col(i)).cross(leg);
    rolls[i] = std::atan2(leg.dot(lower.cross(upper)), lower.dot(upper));
  }
  return rolls;
}

}  // namespace

Six ForkRoll(const Hexapod& hexapod, const Motion& home, const Motion& base_from_platform) {
  Six roll = Rolls(hexapod, base_from_platform) - Rolls(hexapod, home);
  for (double& angle : roll) angle = std::remainder(angle, 2.0 * M_PI);
  return roll;
}

Six LegForces(const Hexapod& hexapod,
              const Motion& base_from_platform,
              double mass,
              const Eigen::Vector3d& centre,
              const Eigen::Vector3d& gravity) {
  const Joints u = LegDirections(hexapod.base, hexapod.platform, base_from_platform);
  // A leg under tension t pulls the platform down along -u: the six pulls and the load are in
  // balance.
  Square pulls;
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector3d arm = base_from_platform.turn * hexapod.platform.col(i);
    pulls.col(i) << -u.col(i), -arm.cross(Eigen::Vector3d(u.col(i)));
  }
  const Eigen::Vector3d weight = 9.80665 * mass * gravity;
  const Eigen::Vector3d arm = base_from_platform.turn * centre;
  Six load;
  load << weight, arm.cross(weight);
  return pulls.partialPivLu().solve(-load);
}

}  // namespace hexcal::hidden
