// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/covariance.h"

#include <Eigen/LU>

#include "estimator/calibrate.h"
#include "residuals/whitener.h"
#include "testing/matchers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::AnyMounts;
using testing::Difference;
using testing::HexapodObservations;
using testing::MatrixNear;
using testing::SeededByTest;
using testing::TrackerLikeCovariance;

TEST(Covariance, IsTheInverseNormalMatrixOfAllRows) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  const Matrix6d whitener = WhitenerOf(TrackerLikeCovariance());
  JacobianFactor factor;
  Matrix12d normal = Matrix12d::Zero();
  for (const Observation& o : HexapodObservations(rng, truth, 100)) {
    const Matrix6x12d j =
        whitener *
        PoseErrorJacobian(Vector6d::Zero(), o.base_from_platform * truth.platform_from_tool);
    factor.Add(j);
    normal += j.transpose() * j;
  }
  const ParameterCovariance result = ComputeCovariance(factor.R(), {});
  const Vector12d scale = result.covariance.diagonal().cwiseSqrt();
  EXPECT_TRUE(MatrixNear(
      scale.cwiseInverse().asDiagonal() * result.covariance * scale.cwiseInverse().asDiagonal(),
      scale.cwiseInverse().asDiagonal() * Matrix12d(normal.inverse()) *
          scale.cwiseInverse().asDiagonal(),
      1e-8));
  EXPECT_EQ(result.observability.null_directions, 0);
  EXPECT_GT(result.observability.singular_values[11], 0.0);
  EXPECT_NEAR(result.observability.condition_number,
              result.observability.singular_values[0] / result.observability.singular_values[11],
              1e-12);
}

// The reported standard deviations and all correlations are those of the estimates: 4,000 draws,
// unequal and correlated noise.
TEST(Covariance, EveryOneOfTheTwelveIsTheSpreadOfRepeats) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  const auto exact = HexapodObservations(rng, truth, 15);
  const int draws = 4000;
  Matrix12d spread = Matrix12d::Zero(), reported = Matrix12d::Zero();
  double normalised = 0.0;
  for (int i = 0; i < draws; ++i) {
    auto rows = exact;
    testing::AddNoise(rng, TrackerLikeCovariance(), &rows);
    const Estimate estimate = Calibrate(testing::KnownNoise(rows, TrackerLikeCovariance()), {}, {});
    ASSERT_TRUE(estimate.IsTrustworthy());
    const Vector12d d = Difference(estimate.mounts, truth);
    spread += d * d.transpose() / draws;
    reported += estimate.covariance / draws;
    normalised += d.dot(estimate.covariance.ldlt().solve(d)) / draws;
  }
  const Vector12d sigma = reported.diagonal().cwiseSqrt();
  for (int i = 0; i < 12; ++i)
    EXPECT_NEAR(std::sqrt(spread(i, i)) / sigma[i], 1.0, 0.05) << kParameters[i].name;
  EXPECT_NEAR(normalised, 12.0, 0.5);
  const auto correlation = [&](const Matrix12d& c) {
    return Matrix12d(sigma.cwiseInverse().asDiagonal() * c * sigma.cwiseInverse().asDiagonal());
  };
  EXPECT_TRUE(MatrixNear(correlation(spread), correlation(reported), 0.08));
}

// All rotations about one axis: one direction is lost, has no variance at all, and is named.
TEST(Covariance, NamesTheDirectionThatOneAxisLoses) {
  auto rng = SeededByTest();
  BaseAndTool truth = AnyMounts(rng);
  truth.platform_from_tool.rotation.setIdentity();
  auto rows = HexapodObservations(rng, truth, 20);
  for (Observation& o : rows) {
    o.base_from_platform.rotation = Exp(Eigen::Vector3d(0, 0, testing::Uniform(rng, -2, 2)));
    o.world_from_tool = truth.world_from_base * o.base_from_platform * truth.platform_from_tool;
  }
  testing::AddNoise(rng, TrackerLikeCovariance(), &rows);
  const Estimate estimate = Calibrate(testing::UnknownNoise(rows), {}, {});
  EXPECT_TRUE(estimate.converged);
  EXPECT_FALSE(estimate.IsTrustworthy());
  ASSERT_EQ(estimate.observability.null_directions, 1);
  const std::string& words = estimate.observability.weak_directions[0];
  EXPECT_NE(words.find("base.dz"), std::string::npos) << words;
  EXPECT_NE(words.find("tool.dz"), std::string::npos) << words;
  EXPECT_EQ(words.find("base.dx"), std::string::npos) << words;
  for (int i = 0; i < 12; ++i) {
    const bool lost =
        kParameters[i].name == "base.dz" || kParameters[i].name.substr(0, 6) == "tool.d";
    if (!lost) {
      EXPECT_TRUE(estimate.observability.determined[i]) << kParameters[i].name;
    }
  }
  EXPECT_FALSE(estimate.observability.determined[2]);
  EXPECT_LT(estimate.covariance.diagonal().maxCoeff(), 1.0);  // never 1e17
}

TEST(Covariance, PosesThatDoNotRotateLoseSixDirections) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  auto rows = HexapodObservations(rng, truth, 20);
  for (Observation& o : rows) {
    o.base_from_platform.rotation.setIdentity();
    o.world_from_tool = truth.world_from_base * o.base_from_platform * truth.platform_from_tool;
  }
  testing::AddNoise(rng, TrackerLikeCovariance(), &rows);
  const Estimate estimate = Calibrate(testing::KnownNoise(rows, TrackerLikeCovariance()), {}, {});
  // The tool's shift is free against the base's, all three axes; turns are told by the positions.
  EXPECT_EQ(estimate.observability.null_directions, 3);
  EXPECT_FALSE(estimate.IsTrustworthy());
}

// A direction that is told by next to nothing is not trusted either.
TEST(Covariance, ASigmaLongerThanTheMachineIsNoMeasurement) {
  Matrix12d r = Matrix12d::Identity() * 1e4;
  r(2, 2) = 0.1;  // one sigma of 10 m
  const ParameterCovariance result = ComputeCovariance(r, {});
  EXPECT_EQ(result.observability.null_directions, 1);
  EXPECT_FALSE(result.observability.determined[2]);
  EXPECT_EQ(result.covariance(2, 2), 0.0);
}

TEST(Covariance, RobotNoiseOfTheSizeOfTheRotationsMakesADirectionWeak) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  auto rows = HexapodObservations(rng, truth, 30);
  for (Observation& o : rows) {  // tilts of a milliradian about a single axis's motion
    o.base_from_platform.rotation = Exp(Eigen::Vector3d(0, 0, testing::Uniform(rng, -2, 2))) *
                                    Exp(testing::UniformVector(rng, 1e-3));
    o.world_from_tool = truth.world_from_base * o.base_from_platform * truth.platform_from_tool;
    o.robot_covariance = 1e-6 * Matrix6d::Identity();
  }
  Observations observations = testing::KnownNoise(rows, 1e-12 * Matrix6d::Identity());
  EXPECT_EQ(Calibrate(observations, {}, {}).observability.null_directions, 0);
  observations.has_robot_noise = true;
  EXPECT_EQ(Calibrate(observations, {}, {}).observability.null_directions, 1);
}

}  // namespace
}  // namespace hexcal
