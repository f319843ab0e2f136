// SPDX-License-Identifier: BSD-3-Clause
// The solution and its covariance against a solver written from the definition of the likelihood
// alone: 4 x 4 matrices, numeric derivatives, dense inverses; none of hexcal's Jacobians, whiteners
// or closed forms.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "estimator/calibrate.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::AnyMounts;
using testing::HexapodObservations;
using testing::SeededByTest;

Eigen::Matrix4d Small(const Vector6d& d) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  const double angle = d.tail<3>().norm();
  if (angle > 0)
    m.topLeftCorner<3, 3>() = Eigen::AngleAxisd(angle, d.tail<3>() / angle).toRotationMatrix();
  m.topRightCorner<3, 1>() = d.head<3>();
  return m;
}

// measured = predicted * (d, Exp delta), the rotation by its angle and axis.
Vector6d ErrorOf(const Eigen::Matrix4d& measured, const Eigen::Matrix4d& predicted) {
  const Eigen::Matrix4d m = predicted.inverse() * measured;
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(m.topLeftCorner<3, 3>()));
  Vector6d error;
  error << m.topRightCorner<3, 1>(), turn.angle() * turn.axis();
  return error;
}

// Central differences, six directions of a right perturbation of m.
template <typename Error>
Matrix6d Derivative(const Eigen::Matrix4d& m, const Error& error) {
  const double step = 1e-5;
  Matrix6d derivative;
  for (int i = 0; i < 6; ++i) {
    const Vector6d d = step * Vector6d::Unit(i);
    derivative.col(i) = (error(m * Small(d)) - error(m * Small(-d))) / (2 * step);
  }
  return derivative;
}

struct Solution12 {
  Eigen::Matrix4d base, tool;
  Matrix12d covariance;
};

Solution12 SolveFromTheDefinition(const Observations& observations, const BaseAndTool& start) {
  Solution12 s{start.world_from_base.Matrix(), start.platform_from_tool.Matrix(), {}};
  for (int iteration = 0; iteration < 12; ++iteration) {
    Matrix12d normal = Matrix12d::Zero();
    Vector12d gradient = Vector12d::Zero();
    for (const Observation& o : observations.items) {
      const Eigen::Matrix4d robot = o.base_from_platform.Matrix(),
                            measured = o.world_from_tool.Matrix();
      const Eigen::Matrix4d predicted = s.base * robot * s.tool;
      // How a motion of the platform moves the predicted tool.
      const Matrix6d carry = Derivative(robot, [&](const Eigen::Matrix4d& moved) {
        return ErrorOf(s.base * moved * s.tool, predicted);
      });
      const Matrix6d weight =
          (o.tool_covariance + carry * o.robot_covariance * carry.transpose()).inverse();
      Matrix6x12d j;
      j << Derivative(
          s.base,
          [&](const Eigen::Matrix4d& moved) { return ErrorOf(measured, moved * robot * s.tool); }),
          Derivative(s.tool, [&](const Eigen::Matrix4d& moved) {
            return ErrorOf(measured, s.base * robot * moved);
          });
      normal += j.transpose() * weight * j;
      gradient += j.transpose() * weight * ErrorOf(measured, predicted);
    }
    s.covariance = normal.inverse();
    const Vector12d y = -s.covariance * gradient;
    s.base = s.base * Small(y.head<6>());
    s.tool = s.tool * Small(y.tail<6>());
  }
  return s;
}

// Every pose has its own covariance, far from diagonal; with and without noise of the robot.
TEST(IndependentSolution, AgreesToAMillionthOfASigmaAndInTheWholeCovariance) {
  auto rng = SeededByTest();
  for (const bool with_robot : {false, true}) {
    const BaseAndTool truth = AnyMounts(rng);
    Observations observations;
    observations.tool_noise_is_known = true;
    observations.has_robot_noise = with_robot;
    observations.items = HexapodObservations(rng, truth, 25);
    for (Observation& o : observations.items) {
      const Matrix6d carry = InverseAdjoint(testing::RandomPose(rng, 0.2));
      o.tool_covariance = carry * testing::TrackerLikeCovariance() * carry.transpose();
      const Matrix6d l = o.tool_covariance.llt().matrixL();
      o.world_from_tool = Plus(o.world_from_tool, Vector6d(l * testing::Normal(rng, 6)));
      if (with_robot) o.robot_covariance = 0.3 * testing::TrackerLikeCovariance();
    }
    const Estimate estimate = Calibrate(observations, {}, {});
    ASSERT_TRUE(estimate.IsTrustworthy());
    const Solution12 independent = SolveFromTheDefinition(observations, truth);
    Vector12d off;
    off << ErrorOf(estimate.mounts.world_from_base.Matrix(), independent.base),
        ErrorOf(estimate.mounts.platform_from_tool.Matrix(), independent.tool);
    const Vector12d sigma = independent.covariance.diagonal().cwiseSqrt();
    EXPECT_LT(off.cwiseQuotient(sigma).cwiseAbs().maxCoeff(), 1e-7);
    const Matrix12d difference = estimate.covariance - independent.covariance;
    EXPECT_LT((sigma.cwiseInverse().asDiagonal() * difference * sigma.cwiseInverse().asDiagonal())
                  .cwiseAbs()
                  .maxCoeff(),
              1e-7);
    EXPECT_EQ(estimate.degrees_of_freedom, 6 * 25 - 12);
  }
}

}  // namespace
}  // namespace hexcal
