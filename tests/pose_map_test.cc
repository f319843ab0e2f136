// SPDX-License-Identifier: BSD-3-Clause
#include "model/pose_map.h"

#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::MatrixNear;
using testing::SeededByTest;

PoseMap RandomMap(std::mt19937_64& rng, int degree) {
  PoseMap map;
  map.degree = degree;
  map.reference = testing::RandomPose(rng, 0.5);
  map.centre = 0.01 * testing::Normal(rng, 6);
  map.half_width = 0.1 * testing::Normal(rng, 6).cwiseAbs() + Eigen::VectorXd::Constant(6, 0.05);
  map.coefficients.resize(6, PoseMapTermCount(degree));
  for (int k = 0; k < map.coefficients.cols(); ++k)
    map.coefficients.col(k) = 1e-4 * testing::Normal(rng, 6);
  return map;
}

Pose3d At(const PoseMap& map, const Vector6d& normalised) {
  return Plus(map.reference, Vector6d(map.centre + map.half_width.cwiseProduct(normalised)));
}

TEST(PoseMap, IsItsConstantAtTheCentreOfItsBox) {
  std::mt19937_64 rng = SeededByTest();
  for (const int degree : {1, 2}) {
    const PoseMap map = RandomMap(rng, degree);
    EXPECT_TRUE(
        MatrixNear(PoseMapTwist(map, At(map, Vector6d::Zero())), map.coefficients.col(0), 1e-15));
  }
}

TEST(PoseMap, IsItsPolynomialInTheBox) {
  std::mt19937_64 rng = SeededByTest();
  const PoseMap map = RandomMap(rng, 2);
  Vector6d x;
  x << 0.5, -0.25, 0.125, -1, 1, 0.75;
  Vector6d expected = map.coefficients.col(0);
  int term = 7;
  for (int i = 0; i < 6; ++i) {
    expected += x[i] * map.coefficients.col(1 + i);
    for (int j = i; j < 6; ++j) expected += x[i] * x[j] * map.coefficients.col(term++);
  }
  EXPECT_TRUE(MatrixNear(PoseMapTwist(map, At(map, x)), expected, 1e-15));
}

TEST(PoseMap, OutsideItsBoxIsThatOfTheNearestPointOfTheBox) {
  std::mt19937_64 rng = SeededByTest();
  const PoseMap map = RandomMap(rng, 2);
  Vector6d outside, nearest;
  outside << 3, -0.5, 0.5, -2, 1.5, 0;
  nearest << 1, -0.5, 0.5, -1, 1, 0;
  EXPECT_TRUE(
      MatrixNear(PoseMapTwist(map, At(map, outside)), PoseMapTwist(map, At(map, nearest)), 1e-15));
}

TEST(PoseMap, DoesNotFollowACoordinateThatDidNotMove) {
  std::mt19937_64 rng = SeededByTest();
  PoseMap map = RandomMap(rng, 2);
  map.half_width[2] = 0.0;
  const Vector6d coordinates = map.centre + 0.5 * map.half_width;
  const Pose3d pose = Plus(map.reference, coordinates);
  const Pose3d higher = Plus(map.reference, Vector6d(coordinates + 0.2 * Vector6d::Unit(2)));
  EXPECT_TRUE(MatrixNear(PoseMapTwist(map, pose), PoseMapTwist(map, higher), 1e-15));
}

}  // namespace
}  // namespace hexcal
