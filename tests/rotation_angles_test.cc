// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/rotation_angles.h"

#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::MatrixNear;
using testing::PoseNear;
using testing::RandomPose;
using testing::SeededByTest;
using testing::Uniform;

constexpr double kHalfPi = 1.5707963267948966;

Eigen::Matrix3d Product(double rx, double ry, double rz) {
  return (Eigen::AngleAxisd(rx, Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(ry, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(rz, Eigen::Vector3d::UnitZ()))
      .toRotationMatrix();
}

TEST(RotationAngles, IsTheProductRxRyRz) {
  EXPECT_TRUE(MatrixNear(RotationFromAngles({0.3, -0.7, 1.1}), Product(0.3, -0.7, 1.1), 1e-15));
}

TEST(RotationAngles, ComeBackAwayFromTheGimbal) {
  auto rng = SeededByTest();
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d angles(
        Uniform(rng, -3.14, 3.14), Uniform(rng, -1.57, 1.57), Uniform(rng, -3.14, 3.14));
    EXPECT_TRUE(MatrixNear(AnglesFromRotation(RotationFromAngles(angles)), angles, 1e-12));
  }
}

TEST(RotationAngles, AtTheGimbalTheRotationComesBackWithRxZero) {
  for (const double ry : {kHalfPi, -kHalfPi}) {
    const Eigen::Matrix3d rotation = RotationFromAngles({0.4, ry, 0.9});
    const Eigen::Vector3d angles = AnglesFromRotation(rotation);
    EXPECT_EQ(angles.x(), 0.0);
    EXPECT_NEAR(angles.y(), ry, 1e-12);
    EXPECT_TRUE(MatrixNear(RotationFromAngles(angles), rotation, 1e-12));
  }
}

TEST(RotationAngles, EveryRotationComesBack) {
  auto rng = SeededByTest();
  for (int i = 0; i < 1000; ++i) {
    const Pose3d x = RandomPose(rng, 1.0);
    EXPECT_TRUE(PoseNear(PoseFromVector(VectorFromPose(x)), x, 1e-15, 1e-14));
  }
}

TEST(RotationAngles, ByTurnIsTheDerivative) {
  auto rng = SeededByTest();
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d angles = testing::UniformVector(rng, 1.4);
    const Eigen::Quaterniond q(RotationFromAngles(angles));
    const Eigen::MatrixXd numeric = testing::NumericJacobian(
        [&](const Eigen::VectorXd& d) {
          return AnglesFromRotation((q * Exp(Eigen::Vector3d(d))).toRotationMatrix());
        },
        3);
    EXPECT_TRUE(testing::JacobianNear(AnglesByTurn(angles), numeric, 1e-7));
  }
}

TEST(RotationAngles, NearTheGimbalTheRotationStillComesBack) {
  for (const double off : {1e-4, 1e-7, 1e-9, 1e-11, 1e-13}) {
    const Eigen::Matrix3d rotation = RotationFromAngles({0.4, kHalfPi - off, 0.9});
    EXPECT_TRUE(MatrixNear(RotationFromAngles(AnglesFromRotation(rotation)), rotation, 1e-9))
        << off;
  }
}

}  // namespace
}  // namespace hexcal
