// SPDX-License-Identifier: BSD-3-Clause
#include "model/hexapod.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <limits>

#include "testing/hexapods.h"
#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::JacobianNear;
using testing::MatrixNear;
using testing::PoseNear;
using testing::SeededByTest;
using testing::Uniform;

constexpr double kDegree = M_PI / 180.0;

// Base and platform joints on the same circle: legs are vertical at a level pose.
HexapodGeometry UprightHexapod() {
  HexapodGeometry hexapod = testing::SmallHexapod();
  hexapod.platform_joints_in_platform = hexapod.base_joints_in_base;
  return hexapod;
}

Pose3d Level(double x, double y, double z) {
  return {Eigen::Vector3d(x, y, z), Eigen::Quaterniond::Identity()};
}

// The singular poses part the workspace; only poses on start's side can be meant.
bool SameAssembly(const HexapodGeometry& hexapod, const Pose3d& a, const Pose3d& b) {
  return LegJacobian(hexapod, a).determinant() * LegJacobian(hexapod, b).determinant() > 0.0;
}

// Well away from singular poses, where solutions merge and none is the near one.
bool HoldsFirmly(const HexapodGeometry& hexapod, const Pose3d& pose) {
  return LegJacobian(hexapod, pose).inverse().norm() < 200.0;
}

TEST(InverseKinematics, OfUprightLegsIsTheHeight) {
  const LegLengths lengths = InverseKinematics(UprightHexapod(), Level(0, 0, 0.3));
  EXPECT_TRUE(MatrixNear(lengths, LegLengths::Constant(0.3), 1e-15));
}

TEST(InverseKinematics, OfShiftedUprightLegsIsTheHypotenuse) {
  const LegLengths lengths = InverseKinematics(UprightHexapod(), Level(0.4, 0, 0.3));
  EXPECT_TRUE(MatrixNear(lengths, LegLengths::Constant(0.5), 1e-15));
}

TEST(InverseKinematics, TurnsPlatformJointsIntoTheBase) {
  HexapodGeometry hexapod;
  hexapod.platform_joints_in_platform.col(0) << 1.0, 0.0, 0.0;
  hexapod.base_joints_in_base.col(0) << 0.0, 1.0, 0.0;
  const Eigen::Vector3d quarter_turn(0, 0, M_PI / 2);
  const Pose3d pose = {Eigen::Vector3d(0, 0, 2), Exp(quarter_turn)};
  EXPECT_NEAR(InverseKinematics(hexapod, pose)[0], 2.0, 1e-15);
}

TEST(InverseKinematics, DoesNotDependOnWhereTheWholeRobotStands) {
  std::mt19937_64 rng = SeededByTest();
  const HexapodGeometry hexapod = testing::LargeHexapod();
  for (int i = 0; i < 100; ++i) {
    const Pose3d moved_from_base = testing::RandomPose(rng, 1.0);
    const Pose3d pose = testing::RandomPose(rng, 1.0);
    HexapodGeometry moved = hexapod;
    for (int leg = 0; leg < kNumLegs; ++leg) {
      const Eigen::Vector3d joint = hexapod.base_joints_in_base.col(leg);
      moved.base_joints_in_base.col(leg) = moved_from_base * joint;
    }
    EXPECT_TRUE(MatrixNear(
        InverseKinematics(moved, moved_from_base * pose), InverseKinematics(hexapod, pose), 1e-14));
  }
}

TEST(LegJacobian, OfUprightLegsIsKnown) {
  const HexapodGeometry hexapod = UprightHexapod();
  Matrix6d expected = Matrix6d::Zero();
  for (int i = 0; i < kNumLegs; ++i) {
    const Eigen::Vector3d a = hexapod.platform_joints_in_platform.col(i);
    expected.row(i) << 0, 0, 1, a.y(), -a.x(), 0;
  }
  EXPECT_TRUE(MatrixNear(LegJacobian(hexapod, Level(0, 0, 0.3)), expected, 1e-15));
}

TEST(LegJacobian, AgreesWithDifferencesOnTheManifold) {
  std::mt19937_64 rng = SeededByTest();
  for (const HexapodGeometry& hexapod : {testing::SmallHexapod(), testing::LargeHexapod()}) {
    for (int i = 0; i < 200; ++i) {
      const Pose3d pose = testing::RandomPose(rng, 1.0);
      const auto lengths = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
        return InverseKinematics(hexapod, Plus(pose, Vector6d(d)));
      };
      const Eigen::MatrixXd numeric = testing::NumericJacobian(lengths, 6);
      EXPECT_TRUE(JacobianNear(LegJacobian(hexapod, pose), numeric, 1e-8));
    }
  }
}

TEST(NeutralPose, IsHomeWhereHomeIsKnown) {
  HexapodGeometry hexapod = testing::SmallHexapod();
  hexapod.home = Level(0.01, 0.02, 0.25);
  const Pose3d neutral = NeutralPose(hexapod, LegLengths::Constant(0.3));
  EXPECT_TRUE(PoseNear(neutral, *hexapod.home, 0.0, 0.0));
}

TEST(NeutralPose, IsTheLevelPoseOverTheCentroidWithTheseLengths) {
  for (const HexapodGeometry& hexapod : {testing::SmallHexapod(), testing::LargeHexapod()}) {
    const Eigen::Vector3d above = hexapod.base_joints_in_base.rowwise().mean() -
                                  hexapod.platform_joints_in_platform.rowwise().mean();
    const Pose3d pose = {above + Eigen::Vector3d(0, 0, 0.3), Eigen::Quaterniond::Identity()};
    const Pose3d neutral = NeutralPose(hexapod, InverseKinematics(hexapod, pose));
    EXPECT_TRUE(PoseNear(neutral, pose, 1e-14, 0.0));
  }
}

TEST(NeutralPose, OfLegsShorterThanTheRadiiIsLow) {
  const Pose3d neutral = NeutralPose(testing::LargeHexapod(), LegLengths::Constant(0.05));
  EXPECT_TRUE(MatrixNear(neutral.translation, Eigen::Vector3d(0, 0, 0.025 + 0.02 + 0.005), 1e-15));
}

TEST(NeutralPose, OfAPlatformWithOtherAxesHasItsJointsOverTheirPartners) {
  const HexapodGeometry hexapod = testing::SmallHexapod();
  const LegLengths lengths = InverseKinematics(hexapod, Level(0, 0, 0.2));
  for (const Eigen::Vector3d& turn : {Eigen::Vector3d(0, 0, 2 * M_PI / 3),
                                      Eigen::Vector3d(0, 0, M_PI),
                                      Eigen::Vector3d(M_PI, 0, 0),
                                      Eigen::Vector3d(M_PI / 2, 0, 0)}) {
    const Pose3d platform_from_other = {Eigen::Vector3d(0.01, 0.02, 0.03), Exp(turn)};
    HexapodGeometry other = hexapod;
    for (int i = 0; i < kNumLegs; ++i) {
      const Eigen::Vector3d joint = hexapod.platform_joints_in_platform.col(i);
      other.platform_joints_in_platform.col(i) = platform_from_other.Inverse() * joint;
    }
    const Pose3d neutral = NeutralPose(other, lengths);
    EXPECT_TRUE(PoseNear(neutral, Level(0, 0, 0.2) * platform_from_other, 1e-8, 1e-8));
  }
}

struct Robot {
  HexapodGeometry hexapod;
  double height;
};

class ForwardKinematicsTest : public ::testing::TestWithParam<int> {
 protected:
  const Robot robot_ = GetParam() == 0 ? Robot{testing::SmallHexapod(), testing::kSmallHeight}
                                       : Robot{testing::LargeHexapod(), testing::kLargeHeight};
  const HexapodGeometry& hexapod_ = robot_.hexapod;
};
INSTANTIATE_TEST_SUITE_P(Small, ForwardKinematicsTest, ::testing::Values(0));
INSTANTIATE_TEST_SUITE_P(Large, ForwardKinematicsTest, ::testing::Values(1));

TEST_P(ForwardKinematicsTest, InvertsInverseKinematicsFromTheNeutralPose) {
  std::mt19937_64 rng = SeededByTest();
  int tried = 0, iterations = 0;
  while (tried < 1000) {
    const Pose3d pose = testing::RandomWorkspacePose(rng, robot_.height, 40 * kDegree);
    const LegLengths lengths = InverseKinematics(hexapod_, pose);
    const Pose3d neutral = NeutralPose(hexapod_, lengths);
    if (!SameAssembly(hexapod_, neutral, pose)) continue;
    ++tried;
    const ForwardKinematicsResult result = ForwardKinematics(hexapod_, lengths, neutral);
    ASSERT_TRUE(result.converged) << result.message;
    EXPECT_LE(result.largest_misfit, 1e-12 * lengths.maxCoeff());
    EXPECT_TRUE(MatrixNear(InverseKinematics(hexapod_, result.base_from_platform), lengths, 1e-12));
    EXPECT_TRUE(PoseNear(result.base_from_platform, pose, 1e-8, 1e-8));
    EXPECT_TRUE(result.message.empty());
    iterations += result.iterations;
  }
  EXPECT_LT(iterations, 7 * tried);
}

TEST_P(ForwardKinematicsTest, ConvergesFromPerturbedStarts) {
  std::mt19937_64 rng = SeededByTest();
  int strayed = 0;
  for (int i = 0; i < 3000; ++i) {
    const Pose3d pose = testing::RandomWorkspacePose(rng, robot_.height, 30 * kDegree);
    // Each draw by itself: of two in one expression every compiler has its own order.
    const double shift = Uniform(rng, 0, 0.1);
    const Eigen::Vector3d shift_axis = testing::Normal(rng, 3).normalized();
    const double turn = Uniform(rng, 0, 30 * kDegree);
    const Eigen::Vector3d turn_axis = testing::Normal(rng, 3).normalized();
    Vector6d d;
    d << shift * shift_axis, turn * turn_axis;
    const Pose3d start = Plus(pose, d);
    const LegLengths lengths = InverseKinematics(hexapod_, pose);
    const ForwardKinematicsResult result = ForwardKinematics(hexapod_, lengths, start);
    ASSERT_TRUE(result.converged) << result.message;
    EXPECT_TRUE(MatrixNear(InverseKinematics(hexapod_, result.base_from_platform), lengths, 1e-12));
    strayed += HoldsFirmly(hexapod_, start) && HoldsFirmly(hexapod_, pose) &&
               SameAssembly(hexapod_, start, pose) &&
               !SameAssembly(hexapod_, start, result.base_from_platform);
  }
  // The straight way in leg lengths may pass a singular pose where a detour would not: of 300,000
  // starts it did for 168 (small) and 11 (large).
  EXPECT_LE(strayed, 6);
}

TEST_P(ForwardKinematicsTest, FindsTheNearPoseFromANearStart) {
  std::mt19937_64 rng = SeededByTest();
  for (int i = 0; i < 1000; ++i) {
    const Pose3d pose = testing::RandomWorkspacePose(rng, robot_.height, 30 * kDegree);
    const Pose3d start = pose * testing::SmallPose(rng, 0.005, 2 * kDegree);
    if (!SameAssembly(hexapod_, start, pose) || !HoldsFirmly(hexapod_, pose)) continue;
    const LegLengths lengths = InverseKinematics(hexapod_, pose);
    const ForwardKinematicsResult result = ForwardKinematics(hexapod_, lengths, start);
    EXPECT_TRUE(result.converged) << result.message;
    EXPECT_TRUE(PoseNear(result.base_from_platform, pose, 1e-9, 1e-9));
  }
}

TEST_P(ForwardKinematicsTest, EndsQuadratically) {
  const Pose3d pose = Level(0.01, -0.02, robot_.height);
  const LegLengths lengths = InverseKinematics(hexapod_, pose);
  Vector6d d;
  d << 1e-4, -1e-4, 1e-4, 1e-3, -1e-3, 1e-3;
  EXPECT_LE(ForwardKinematics(hexapod_, lengths, Plus(pose, d)).iterations, 3);
  EXPECT_EQ(ForwardKinematics(hexapod_, lengths, pose).iterations, 0);
}

// Whatever the lengths, reachable or not, low or high: what the neutral start, above the base,
// finds is above the base. The mirror image below it has the same lengths.
TEST_P(ForwardKinematicsTest, StaysAboveTheBaseFromTheNeutralPose) {
  std::mt19937_64 rng = SeededByTest();
  int converged = 0;
  for (int i = 0; i < 2000; ++i) {
    const double height = Uniform(rng, 0.2, 1.5) * robot_.height;
    const Pose3d pose = testing::RandomWorkspacePose(rng, height, 40 * kDegree);
    LegLengths lengths = InverseKinematics(hexapod_, pose);
    lengths += 0.1 * robot_.height * testing::Normal(rng, 6);
    const Pose3d neutral = NeutralPose(hexapod_, lengths);
    const ForwardKinematicsResult result = ForwardKinematics(hexapod_, lengths, neutral);
    if (!result.converged) continue;
    ++converged;
    const Eigen::Vector3d centre = hexapod_.platform_joints_in_platform.rowwise().mean();
    EXPECT_GT((result.base_from_platform * centre).z(), 0.0) << i;
  }
  EXPECT_GT(converged, 500);
}

TEST_P(ForwardKinematicsTest, SaysHowFarTheLegsMissWhereNoPoseHasTheirLengths) {
  LegLengths lengths = InverseKinematics(hexapod_, Level(0, 0, robot_.height));
  lengths[2] += 1.0;
  const ForwardKinematicsResult result =
      ForwardKinematics(hexapod_, lengths, NeutralPose(hexapod_, lengths));
  EXPECT_FALSE(result.converged);
  EXPECT_GT(result.largest_misfit, 0.1);
  const LegLengths reached = InverseKinematics(hexapod_, result.base_from_platform);
  EXPECT_NEAR((reached - lengths).cwiseAbs().maxCoeff(), result.largest_misfit, 1e-12);
  const std::string leg_3 =
      fmt::format("leg 3 would be {:.4g} mm shorter", 1e3 * (lengths - reached)[2]);
  EXPECT_NE(result.message.find(leg_3), std::string::npos) << result.message;
}

TEST(ForwardKinematics, RefusesLengthsThatAreNotFinite) {
  LegLengths lengths = LegLengths::Constant(0.3);
  lengths[1] = std::numeric_limits<double>::quiet_NaN();
  const HexapodGeometry hexapod = testing::SmallHexapod();
  const ForwardKinematicsResult result = ForwardKinematics(hexapod, lengths, Level(0, 0, 0.2));
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.message, "the leg lengths are not finite numbers");
}

TEST(ForwardKinematics, CountsInAnyUnit) {
  HexapodGeometry in_mm = testing::SmallHexapod();
  in_mm.base_joints_in_base *= 1e3;
  in_mm.platform_joints_in_platform *= 1e3;
  const Pose3d pose = {Eigen::Vector3d(10, -20, 200), Exp(Eigen::Vector3d(0.2, -0.1, 0.3))};
  const LegLengths lengths = InverseKinematics(in_mm, pose);
  const ForwardKinematicsResult result =
      ForwardKinematics(in_mm, lengths, NeutralPose(in_mm, lengths));
  EXPECT_TRUE(result.converged);
  EXPECT_TRUE(PoseNear(result.base_from_platform, pose, 1e-9, 1e-12));
}

}  // namespace
}  // namespace hexcal
