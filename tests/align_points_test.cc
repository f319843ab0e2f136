// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/align_points.h"

#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::MatrixNear;
using testing::PoseNear;
using testing::RandomPose;
using testing::SeededByTest;

Eigen::Matrix3Xd Move(const Pose3d& a_from_b, const Eigen::Matrix3Xd& p_in_b) {
  Eigen::Matrix3Xd p_in_a(3, p_in_b.cols());
  for (Eigen::Index k = 0; k < p_in_b.cols(); ++k)
    p_in_a.col(k) = a_from_b * Eigen::Vector3d(p_in_b.col(k));
  return p_in_a;
}

Eigen::Matrix3Xd Body() {
  Eigen::Matrix3Xd body(3, 4);
  body << 0.10, -0.05, -0.06, 0.00,  //
      0.00, 0.08, -0.07, 0.02,       //
      0.00, 0.01, 0.00, 0.06;
  return body;
}

Eigen::Matrix3Xd UnequalSigma(int markers) {
  return Eigen::Vector3d(1e-4, 2e-4, 4e-4).replicate(1, markers);
}

TEST(AlignPoints, RecoversAnyMotionExactly) {
  auto rng = SeededByTest();
  for (int i = 0; i < 200; ++i) {
    const Pose3d truth = RandomPose(rng, 3.0);
    const Eigen::Matrix3Xd seen = Move(truth, Body());
    EXPECT_TRUE(PoseNear(AlignPoints(seen, Body()), truth, 1e-14, 1e-14));
    EXPECT_TRUE(
        PoseNear(AlignPointsWeighted(seen, Body(), UnequalSigma(4)).a_from_b, truth, 1e-13, 1e-13));
  }
}

TEST(AlignPoints, ThreePointsInAPlaneDoNotBecomeAReflection) {
  auto rng = SeededByTest();
  const Eigen::Matrix3Xd flat = Body().leftCols(3);
  for (int i = 0; i < 200; ++i) {
    const Pose3d truth = RandomPose(rng, 3.0);
    const Pose3d fit = AlignPoints(Move(truth, flat), flat);
    EXPECT_TRUE(PoseNear(fit, truth, 1e-13, 1e-13));
  }
}

TEST(AlignPoints, NearestRotationOfAReflectionIsARotation) {
  const Eigen::Matrix3d flipped = Eigen::Vector3d(1, 1, -1).asDiagonal();
  EXPECT_NEAR(NearestRotation(flipped).determinant(), 1.0, 1e-15);
}

TEST(AlignPoints, PlanarSpreadOfCollinearPointsIsZero) {
  Eigen::Matrix3Xd line(3, 4);
  line << 0, 1, 2, 5, 0, 1, 2, 5, 0, 1, 2, 5;
  EXPECT_NEAR(PlanarSpread(line), 0.0, 1e-7);
  EXPECT_GT(PlanarSpread(Body()), 0.05);
}

TEST(AlignPoints, EqualWeightsGiveTheClosedForm) {
  auto rng = SeededByTest();
  const Pose3d truth = RandomPose(rng, 1.0);
  Eigen::Matrix3Xd seen = Move(truth, Body());
  for (Eigen::Index k = 0; k < seen.cols(); ++k) seen.col(k) += 1e-3 * testing::Normal(rng, 3);
  const Eigen::Matrix3Xd equal = Eigen::Matrix3Xd::Constant(3, 4, 2e-4);
  EXPECT_TRUE(PoseNear(
      AlignPointsWeighted(seen, Body(), equal).a_from_b, AlignPoints(seen, Body()), 1e-12, 1e-12));
}

// Unequal sigmas along the axes of a: the covariance is that of the estimates, in the frame of b,
// and the misfit is chi-square.
TEST(AlignPoints, CovarianceIsTheSpreadOfRepeats) {
  auto rng = SeededByTest();
  const Pose3d truth = RandomPose(rng, 1.0);
  const Eigen::Matrix3Xd exact = Move(truth, Body());
  const Eigen::Matrix3Xd sigma = UnequalSigma(4);
  const int draws = 20000;
  Matrix6d sum = Matrix6d::Zero();
  Alignment fit;
  double chi_square = 0.0;
  for (int i = 0; i < draws; ++i) {
    Eigen::Matrix3Xd seen = exact;
    for (Eigen::Index k = 0; k < 4; ++k)
      seen.col(k) += sigma.col(k).cwiseProduct(Eigen::Vector3d(testing::Normal(rng, 3)));
    fit = AlignPointsWeighted(seen, Body(), sigma);
    const Vector6d d = Minus(fit.a_from_b, truth);
    sum += d * d.transpose() / draws;
    chi_square += fit.chi_square / draws;
  }
  const Vector6d s = fit.covariance.diagonal().cwiseSqrt().cwiseInverse();
  EXPECT_TRUE(MatrixNear(s.asDiagonal() * sum * s.asDiagonal(),
                         s.asDiagonal() * fit.covariance * s.asDiagonal(),
                         0.04));
  EXPECT_NEAR(chi_square, 6.0, 0.15);
}

}  // namespace
}  // namespace hexcal
