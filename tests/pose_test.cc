// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/pose.h"

#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::JacobianNear;
using testing::MatrixNear;
using testing::NumericJacobian;
using testing::PoseNear;
using testing::RandomPose;
using testing::SeededByTest;
using testing::UniformVector;

// Rotation vectors at zero, near zero, around the switches of the series, ordinary, and near pi.
std::vector<Eigen::Vector3d> RotationVectors() {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 2) / 3;
  std::vector<Eigen::Vector3d> vectors;
  for (const double angle :
       {0.0, 1e-12, 1e-8, 0.9e-6, 1.1e-6, 1.9e-6, 2.1e-6, 1e-3, 0.00999, 0.0101, 1.0, 3.0, 3.1415})
    vectors.push_back(angle * axis);
  return vectors;
}

TEST(Pose, ExpOfAQuarterTurnAboutZTakesXToY) {
  const Eigen::Vector3d v(0, 0, std::acos(0.0));
  EXPECT_TRUE(MatrixNear(Exp(v) * Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), 1e-15));
}

TEST(Pose, LogUndoesExpToRounding) {
  for (const Eigen::Vector3d& v : RotationVectors())
    EXPECT_TRUE(MatrixNear(Log(Exp(v)), v, 1e-15 * std::max(1.0, v.norm() * 4)));
}

TEST(Pose, LogTakesTheNearerOfBothQuaternions) {
  for (const Eigen::Vector3d& v : RotationVectors()) {
    Eigen::Quaterniond q = Exp(v);
    q.coeffs() = -q.coeffs();
    EXPECT_TRUE(MatrixNear(Log(q), v, 4e-15));
  }
}

TEST(Pose, StepLengthIsTheAngleAndTheDistance) {
  auto rng = SeededByTest();
  const Pose3d x = RandomPose(rng, 2.0);
  Vector6d d = Vector6d::Zero();
  d[4] = 0.01;
  EXPECT_NEAR(Eigen::AngleAxisd(x.rotation.conjugate() * Plus(x, d).rotation).angle(), 0.01, 1e-14);
  d.setZero();
  d[0] = 0.02;
  EXPECT_NEAR((Plus(x, d).translation - x.translation).norm(), 0.02, 1e-15);
}

TEST(Pose, PlusMovesAlongTheAxesOfTheRightFrame) {
  // x turns the right frame by 90 deg about z: its x axis is y of the left frame.
  const Pose3d x{Eigen::Vector3d(1, 2, 3), Exp(Eigen::Vector3d(0, 0, std::acos(0.0)))};
  Vector6d d = Vector6d::Zero();
  d[0] = 0.5;
  EXPECT_TRUE(MatrixNear(Plus(x, d).translation, Eigen::Vector3d(1, 2.5, 3), 1e-15));
}

TEST(Pose, PlusIsTheProductWithTheUncoupledStep) {
  auto rng = SeededByTest();
  const Pose3d x = RandomPose(rng, 2.0);
  Vector6d d;
  d << 0.1, -0.2, 0.3, 0.4, 0.5, -0.6;
  const Pose3d step{d.head<3>(), Exp(Eigen::Vector3d(d.tail<3>()))};
  EXPECT_TRUE(PoseNear(Plus(x, d), x * step, 1e-15, 1e-15));
}

TEST(Pose, MinusUndoesPlus) {
  auto rng = SeededByTest();
  for (int i = 0; i < 100; ++i) {
    const Pose3d x = RandomPose(rng, 2.0);
    Vector6d d;
    d << UniformVector(rng, 1.0), UniformVector(rng, 1.7);
    EXPECT_TRUE(MatrixNear(Minus(Plus(x, d), x), d, 1e-14));
    const Pose3d y = RandomPose(rng, 2.0);
    EXPECT_TRUE(PoseNear(Plus(x, Minus(y, x)), y, 1e-14, 1e-14));
  }
}

TEST(Pose, GroupLaws) {
  auto rng = SeededByTest();
  for (int i = 0; i < 100; ++i) {
    const Pose3d a = RandomPose(rng, 2.0), b = RandomPose(rng, 2.0), c = RandomPose(rng, 2.0);
    EXPECT_TRUE(PoseNear((a * b) * c, a * (b * c), 1e-14, 1e-14));
    EXPECT_TRUE(PoseNear(a * a.Inverse(), Pose3d(), 1e-14, 1e-14));
    EXPECT_TRUE(MatrixNear((a * b).Matrix(), a.Matrix() * b.Matrix(), 1e-14));
    const Eigen::Vector3d p = UniformVector(rng, 1.0);
    EXPECT_TRUE(MatrixNear((a * b) * p, a * (b * p), 1e-14));
  }
}

TEST(Pose, ParametersRoundTripInTheirOrder) {
  const Pose3d x{Eigen::Vector3d(1, 2, 3), Exp(Eigen::Vector3d(0.1, 0.2, 0.3))};
  double p[7];
  x.ToParameters(p);
  EXPECT_EQ(p[2], 3.0);
  EXPECT_EQ(p[3], x.rotation.x());
  EXPECT_EQ(p[6], x.rotation.w());
  EXPECT_TRUE(PoseNear(Pose3d::FromParameters(p), x, 0.0, 0.0));
}

TEST(Pose, InverseAdjointIsTheDerivativeOfALeftFactorsMotion) {
  auto rng = SeededByTest();
  for (int i = 0; i < 20; ++i) {
    const Pose3d a = RandomPose(rng, 1.0), b = RandomPose(rng, 1.0);
    const Eigen::MatrixXd numeric = NumericJacobian(
        [&](const Eigen::VectorXd& d) { return Minus(Plus(a, Vector6d(d)) * b, a * b); }, 6);
    EXPECT_TRUE(JacobianNear(InverseAdjoint(b), numeric, 1e-9));
  }
}

TEST(Pose, InverseAdjointIsTheLeftHalfOfThePapersEquation20) {
  auto rng = SeededByTest();
  const Pose3d u = RandomPose(rng, 1.0);
  const Eigen::Matrix3d axes = u.rotation.toRotationMatrix();  // n_u o_u a_u
  Matrix6d expected = Matrix6d::Zero();
  for (int i = 0; i < 3; ++i) {
    expected.block<1, 3>(i, 0) = axes.col(i).transpose();                       // Eq. (16)
    expected.block<1, 3>(i, 3) = u.translation.cross(axes.col(i)).transpose();  // Eq. (17)
    expected.block<1, 3>(i + 3, 3) = axes.col(i).transpose();
  }
  EXPECT_TRUE(MatrixNear(InverseAdjoint(u), expected, 1e-15));
}

TEST(Pose, RightJacobianIsTheDerivativeOfExp) {
  std::mt19937_64 rng = SeededByTest();
  for (const double angle : {0.0, 1e-7, 0.99e-2, 1.01e-2, 0.5, 3.1}) {
    const Eigen::Vector3d v = angle * testing::Normal(rng, 3).normalized();
    const Eigen::MatrixXd numeric = NumericJacobian(
        [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
          return Log(Eigen::Quaterniond(Exp(v).conjugate() * Exp(Eigen::Vector3d(v + d))));
        },
        3);
    EXPECT_TRUE(JacobianNear(RightJacobian(v), numeric, 1e-8)) << angle;
  }
}

TEST(Pose, LeftJacobianInverseIsTheDerivativeOfLog) {
  for (const Eigen::Vector3d& v : RotationVectors()) {
    if (v.norm() > 3.05) continue;  // Log jumps at pi
    const Eigen::MatrixXd numeric = NumericJacobian(
        [&](const Eigen::VectorXd& d) { return Log(Exp(Eigen::Vector3d(d)) * Exp(v)); }, 3);
    EXPECT_TRUE(JacobianNear(LeftJacobianInverse(v), numeric, 1e-8)) << v.norm();
  }
}

}  // namespace
}  // namespace hexcal
