// SPDX-License-Identifier: BSD-3-Clause
// Q = B A T can be closed in four frames: by the error of Q in T, of its inverse in W, of A in its
// frame A, of the inverse of A in B. Equal weights make four different answers of that. With the
// noise stated on the side where it is, and carried along, it is one.
#include <Eigen/Cholesky>
#include <array>

#include "estimator/calibrate.h"
#include "estimator/calibrate_markers.h"
#include "testing/marker_scenes.h"
#include "testing/matchers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::Difference;
using testing::SeededByTest;

enum class Closing { kTool, kWorld, kPlatform, kBase };
constexpr std::array<Closing, 4> kClosings = {
    Closing::kTool, Closing::kWorld, Closing::kPlatform, Closing::kBase};

Vector6d ErrorOf(Closing closing, const BaseAndTool& m, const Pose3d& a, const Pose3d& q) {
  const Pose3d& b = m.world_from_base;
  const Pose3d& t = m.platform_from_tool;
  switch (closing) {
    case Closing::kTool:
      return Minus(q, b * a * t);
    case Closing::kWorld:
      return Minus(q.Inverse(), (b * a * t).Inverse());
    case Closing::kPlatform:
      return Minus(a, b.Inverse() * q * t.Inverse());
    case Closing::kBase:
      return Minus(a.Inverse(), t * q.Inverse() * b);
  }
  return {};
}

// Of the error: both measurements' covariance, carried by their derivatives.
Matrix6d CovarianceOf(Closing closing, const BaseAndTool& m, const Observation& o) {
  const auto by_tool = [&](const Eigen::VectorXd& d) {
    return Eigen::VectorXd(
        ErrorOf(closing, m, o.base_from_platform, Plus(o.world_from_tool, Vector6d(d))));
  };
  const auto by_robot = [&](const Eigen::VectorXd& d) {
    return Eigen::VectorXd(
        ErrorOf(closing, m, Plus(o.base_from_platform, Vector6d(d)), o.world_from_tool));
  };
  const Matrix6d jt = testing::NumericJacobian(by_tool, 6);
  const Matrix6d jr = testing::NumericJacobian(by_robot, 6);
  return jt * o.tool_covariance * jt.transpose() + jr * o.robot_covariance * jr.transpose();
}

BaseAndTool MovedMounts(const BaseAndTool& m, const Eigen::VectorXd& y) {
  return {Plus(m.world_from_base, Vector6d(y.head<6>())),
          Plus(m.platform_from_tool, Vector6d(y.tail<6>()))};
}

// Gauss-Newton with numeric derivatives; weights follow the solution, as constants.
BaseAndTool Solve(Closing closing,
                  const std::vector<Observation>& rows,
                  BaseAndTool mounts,
                  bool is_weighted) {
  for (int step = 0; step < 8; ++step) {
    Matrix12d normal = Matrix12d::Zero();
    Vector12d gradient = Vector12d::Zero();
    for (const Observation& o : rows) {
      const Matrix6d covariance =
          is_weighted ? CovarianceOf(closing, mounts, o) : Matrix6d(Matrix6d::Identity());
      const auto f = [&](const Eigen::VectorXd& y) {
        const Vector6d e =
            ErrorOf(closing, MovedMounts(mounts, y), o.base_from_platform, o.world_from_tool);
        return Eigen::VectorXd(covariance.llt().matrixL().solve(e));
      };
      const Eigen::MatrixXd j = testing::NumericJacobian(f, 12);
      normal += j.transpose() * j;
      gradient += j.transpose() * f(Eigen::VectorXd::Zero(12));
    }
    mounts = MovedMounts(mounts, -normal.ldlt().solve(gradient));
  }
  return mounts;
}

struct Apart {
  double weighted = 0.0, equal = 0.0;  // largest difference of two closings, in sigmas
};

// tracker, robot: factors on the noise of the two sides.
Apart LargestDifference(double tracker, double robot) {
  auto rng = SeededByTest();
  const BaseAndTool truth = testing::AnyMounts(rng);
  auto rows = testing::HexapodObservations(rng, truth, 20);
  const Matrix6d of_tool = tracker * tracker * testing::TrackerLikeCovariance();
  Vector6d sigma;
  sigma << 1e-4, 2e-4, 0.5e-4, 2e-3, 1e-3, 0.5e-3;
  const Matrix6d of_robot = robot * robot * Matrix6d(sigma.cwiseAbs2().asDiagonal());
  for (Observation& o : rows) {
    o.tool_covariance = of_tool;
    o.robot_covariance = of_robot;
    o.world_from_tool =
        truth.world_from_base *
        Plus(o.base_from_platform,
             Vector6d(robot * sigma.cwiseProduct(Vector6d(testing::Normal(rng, 6))))) *
        truth.platform_from_tool;
  }
  if (tracker > 0) testing::AddNoise(rng, of_tool, &rows);
  Observations observations;
  observations.items = rows;
  observations.tool_noise_is_known = true;
  observations.has_robot_noise = robot > 0;
  const Estimate ours = Calibrate(observations, {}, {});
  EXPECT_TRUE(ours.IsTrustworthy());
  const Vector12d deviation = ours.covariance.diagonal().cwiseSqrt();
  Apart apart;
  for (const Closing closing : kClosings) {
    const auto largest = [&](bool is_weighted) {
      return Difference(Solve(closing, rows, ours.mounts, is_weighted), ours.mounts)
          .cwiseQuotient(deviation)
          .cwiseAbs()
          .maxCoeff();
    };
    apart.weighted = std::max(apart.weighted, largest(true));
    apart.equal = std::max(apart.equal, largest(false));
  }
  return apart;
}

// What is left between the closings is of second order: a tenth of the noise leaves a tenth of it,
// in sigmas. What equal weights leave stays.
void ExpectOneAnswer(double tracker, double robot) {
  const Apart apart = LargestDifference(tracker, robot);
  const Apart nearer = LargestDifference(0.1 * tracker, 0.1 * robot);
  EXPECT_LT(apart.weighted, 0.2);
  EXPECT_LT(nearer.weighted, 0.15 * apart.weighted);
  EXPECT_GT(apart.equal, 1.0);
  EXPECT_GT(nearer.equal, 1.0);
}

TEST(LoopClosing, IsOneWithTheNoiseOnTheTrackersSide) { ExpectOneAnswer(1.0, 0.0); }
TEST(LoopClosing, IsOneWithTheNoiseOnTheRobotsSide) { ExpectOneAnswer(0.0, 1.0); }
TEST(LoopClosing, IsOneWithTheNoiseOnBothSides) { ExpectOneAnswer(1.0, 1.0); }

// The likelihood of the readings knows no closing: it is that one answer.
TEST(LoopClosing, OfMarkersIsTheSame) {
  auto rng = SeededByTest();
  for (const double robot_noise : {0.0, 1e-4}) {
    testing::MarkerScene scene;
    scene.robot_noise = robot_noise;
    const Dataset dataset = testing::DrawMarkers(testing::MakeMarkerTruth(rng, scene), 1);
    const Observations observations = MakeObservations(dataset);
    const Estimate by_markers =
        CalibrateMarkers(observations, MakeMarkerObservations(dataset, observations), {}, {});
    const Vector12d deviation = by_markers.covariance.diagonal().cwiseSqrt();
    for (const Closing closing : kClosings) {
      const BaseAndTool closed = Solve(closing, observations.items, by_markers.mounts, true);
      EXPECT_LT(
          Difference(closed, by_markers.mounts).cwiseQuotient(deviation).cwiseAbs().maxCoeff(),
          0.05);
    }
  }
}

}  // namespace
}  // namespace hexcal
