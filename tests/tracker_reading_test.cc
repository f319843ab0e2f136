// SPDX-License-Identifier: BSD-3-Clause
#include "model/tracker_reading.h"

#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::JacobianNear;
using testing::MatrixNear;
using testing::NumericJacobian;
using testing::PoseNear;
using testing::SeededByTest;

constexpr int kSize = 9;  // scale, depth scale, distortion, twist

Corrections<double> OfNumbers(const Eigen::VectorXd& v) {
  Corrections<double> c;
  c.tracker_scale = v[0];
  c.tracker_depth_scale = v[1];
  c.tracker_distortion = v[2];
  c.tracker_twist = v.tail<6>();
  return c;
}

TEST(TrackerReading, IsThePointItselfWithoutCorrections) {
  const Eigen::Vector3d p(0.1, -0.2, 2.3);
  EXPECT_EQ(TrackerReading({}, p), p);
  EXPECT_EQ(PointOfReading({}, p), p);
}

TEST(TrackerReading, IsWhereHandWorkPutsIt) {
  Corrections<double> c;
  c.tracker_scale = 0.01;
  c.tracker_depth_scale = 0.02;
  c.tracker_distortion = 0.1;
  // x^2 + y^2 = 0.25: x and y grow by 0.01 + 0.025, z by 0.01 + 0.02.
  EXPECT_TRUE(MatrixNear(TrackerReading(c, {0.3, 0.4, 2}),
                         Eigen::Vector3d(0.3 * 1.035, 0.4 * 1.035, 2 * 1.03),
                         1e-15));
  // The tracker has gone 0.1 m along its x and turned a quarter about its z.
  Corrections<double> moved;
  moved.tracker_twist << 0.1, 0, 0, 0, 0, M_PI / 2;
  EXPECT_TRUE(
      MatrixNear(TrackerReading(moved, {0.3, 0.4, 2}), Eigen::Vector3d(0.4, -0.2, 2), 1e-15));
}

TEST(TrackerReading, DerivativesAreThoseOfDifferences) {
  std::mt19937_64 rng = SeededByTest();
  for (const double size : {0.0, 1e-3, 0.1}) {
    const Eigen::VectorXd v = size * testing::Normal(rng, kSize);
    const Eigen::Vector3d p = testing::UniformVector(rng, 1.0) + Eigen::Vector3d(0, 0, 2);
    const Corrections<double> c = OfNumbers(v);
    const auto by_point = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
      return TrackerReading(c, Eigen::Vector3d(p + d));
    };
    EXPECT_TRUE(JacobianNear(TrackerReadingByPoint(c, p), NumericJacobian(by_point, 3), 1e-8));
    const auto by_corrections = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
      return TrackerReading(OfNumbers(v + d), p);
    };
    Eigen::MatrixXd analytic(3, kSize);
    for (int k = 0; k < kSize; ++k)
      analytic.col(k) = TrackerReadingBy(c, p, OfNumbers(Eigen::VectorXd::Unit(kSize, k)));
    EXPECT_TRUE(JacobianNear(analytic, NumericJacobian(by_corrections, kSize), 1e-8)) << size;
  }
}

TEST(TrackerReading, IsTurnedRound) {
  std::mt19937_64 rng = SeededByTest();
  for (int i = 0; i < 200; ++i) {
    const Corrections<double> c = OfNumbers(0.02 * testing::Normal(rng, kSize));
    const Eigen::Vector3d p = testing::UniformVector(rng, 1.0) + Eigen::Vector3d(0, 0, 2);
    EXPECT_TRUE(MatrixNear(PointOfReading(c, TrackerReading(c, p)), p, 1e-14));
    const Pose3d pose = testing::RandomPose(rng, 1.0);
    EXPECT_TRUE(PoseNear(PoseOfReading(c, TrackerPoseReading(c, pose)), pose, 1e-14, 1e-14));
  }
}

TEST(TrackerReading, ThatNoPointHasIsNotANumber) {
  Corrections<double> c;
  c.tracker_scale = -1.0;  // every reading is the origin
  EXPECT_FALSE(PointOfReading(c, {0.5, 0, 2}).allFinite());
}

// A pose's reading is that of points of a body that keeps its size.
TEST(TrackerReading, OfAPoseIsThatOfItsOriginAndAxes) {
  std::mt19937_64 rng = SeededByTest();
  Corrections<double> c = OfNumbers(0.1 * testing::Normal(rng, kSize));
  c.tracker_depth_scale = c.tracker_distortion = 0.0;
  const Pose3d pose = testing::RandomPose(rng, 1.0);
  const Pose3d reading = TrackerPoseReading(c, pose);
  EXPECT_TRUE(MatrixNear(reading.translation, TrackerReading(c, pose.translation), 1e-15));
  const Eigen::Vector3d axis(1, 0, 0);
  const Eigen::Vector3d along =
      TrackerReading(c, Eigen::Vector3d(pose * axis)) - reading.translation;
  EXPECT_TRUE(MatrixNear(Eigen::Vector3d(reading.rotation * axis), along.normalized(), 1e-14));
}

}  // namespace
}  // namespace hexcal
