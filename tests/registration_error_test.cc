// SPDX-License-Identifier: BSD-3-Clause
// Three roads to the error of a point of a rigid body that a tracker reads: the closed form, the
// covariance of the fit carried to the point, and repetition.
#include "estimator/registration_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimator/target_error.h"
#include "geometry/align_points.h"
#include "testing/random.h"

namespace hexcal {
namespace {

constexpr double kSigma = 1e-4;

// A plane body of four markers with the measures of a common passive tool, m.
Eigen::Matrix3Xd PlaneBody() {
  Eigen::Matrix3Xd markers(3, 4);
  markers.row(0).setZero();
  markers.row(1) << 0.0, 0.02859, 0.0, -0.04432;
  markers.row(2) << 0.0, 0.04102, 0.088, 0.04045;
  return markers;
}

const Eigen::Vector3d kTarget(0.0, 0.0, -0.15);

// Root mean square lengths of the markers' misfit and of the target's error.
struct Repeated {
  double markers = 0.0, target = 0.0;
};
Repeated Repeat(const Eigen::Matrix3Xd& body, const Eigen::Vector3d& target) {
  constexpr int kDraws = 40000;
  auto rng = testing::SeededByTest();
  Repeated sums;
  for (int i = 0; i < kDraws; ++i) {
    Eigen::Matrix3Xd read = body;
    for (Eigen::Index k = 0; k < body.cols(); ++k) read.col(k) += kSigma * testing::Normal(rng, 3);
    const Pose3d found = AlignPoints(read, body);
    for (Eigen::Index k = 0; k < body.cols(); ++k)
      sums.markers += (read.col(k) - found * Eigen::Vector3d(body.col(k))).squaredNorm();
    sums.target += (found * target - target).squaredNorm();
  }
  return {std::sqrt(sums.markers / (kDraws * static_cast<double>(body.cols()))),
          std::sqrt(sums.target / kDraws)};
}

double ByCovariance(const Eigen::Matrix3Xd& body, const Eigen::Vector3d& target) {
  const Eigen::Matrix3Xd sigma = Eigen::Matrix3Xd::Constant(3, body.cols(), kSigma);
  const Alignment fit = AlignPointsWeighted(body, body, sigma);
  const Eigen::Matrix<double, 3, 6> j = PointJacobian(fit.a_from_b, target);
  return std::sqrt((j * fit.covariance * j.transpose()).trace());
}

TEST(RegistrationError, ClosedFormCovarianceAndRepetitionAgreeWithinAPercent) {
  const double closed = TargetRegistrationError(PlaneBody(), kSigma, kTarget);
  const Repeated repeated = Repeat(PlaneBody(), kTarget);
  EXPECT_NEAR(ByCovariance(PlaneBody(), kTarget) / closed, 1.0, 1e-6);
  EXPECT_NEAR(repeated.target / closed, 1.0, 0.01);
  EXPECT_NEAR(repeated.markers / FiducialRegistrationError(4, kSigma), 1.0, 0.01);
  EXPECT_NEAR(FiducialRegistrationError(4, kSigma), 1.2247e-4, 1e-8);
}

// Turning and moving everything changes no digit, whatever the axes.
TEST(RegistrationError, IsInvariantUnderRotation) {
  auto rng = testing::SeededByTest();
  const double aligned = TargetRegistrationError(PlaneBody(), kSigma, kTarget);
  for (int i = 0; i < 50; ++i) {
    const Pose3d move = testing::RandomPose(rng, 0.5);
    Eigen::Matrix3Xd body = PlaneBody();
    for (Eigen::Index k = 0; k < body.cols(); ++k)
      body.col(k) = move * Eigen::Vector3d(body.col(k));
    const Eigen::Vector3d target = move * kTarget;
    EXPECT_NEAR(TargetRegistrationError(body, kSigma, target) / aligned, 1.0, 1e-12);
    EXPECT_NEAR(ByCovariance(body, target) / aligned, 1.0, 1e-6);
  }
}

// By hand: four markers at the corners of a square of half diagonal a. At the centroid sigma
// sqrt(3/4); at a distance h above it f is a / sqrt(2) for the axes in the plane.
TEST(RegistrationError, OfASquareIsAsByHand) {
  Eigen::Matrix3Xd square(3, 4);
  square << 0.1, -0.1, 0.0, 0.0, 0.0, 0.0, 0.1, -0.1, 0.0, 0.0, 0.0, 0.0;
  EXPECT_NEAR(TargetRegistrationError(square, 1.0, {0.0, 0.0, 0.0}), std::sqrt(0.75), 1e-12);
  const double ratio = 0.3 * 0.3 / (0.1 * 0.1 / 2.0);  // of each of two axes
  EXPECT_NEAR(TargetRegistrationError(square, 1.0, {0.0, 0.0, 0.3}),
              std::sqrt(0.75 * (1.0 + 2.0 * ratio / 3.0)),
              1e-12);
}

}  // namespace
}  // namespace hexcal
