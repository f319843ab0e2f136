// SPDX-License-Identifier: BSD-3-Clause
#include "model/predict.h"

#include <algorithm>

#include "model/hexapod.h"
#include "testing/datasets.h"
#include "testing/hexapods.h"
#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::MatrixNear;
using testing::PoseNear;
using testing::SeededByTest;

std::vector<Pose3d> WorkspacePoses(int count) {
  std::mt19937_64 rng = SeededByTest();
  std::vector<Pose3d> poses;
  for (int i = 0; i < count; ++i)
    poses.push_back(testing::RandomWorkspacePose(rng, testing::kLargeHeight, 0.3));
  return poses;
}

std::string MessageOf(const Dataset& dataset) {
  try {
    ReportedPoses(dataset);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

TEST(ReportedPoses, AreTheRecordedOnesToTheLastBit) {
  const std::vector<Pose3d> poses = WorkspacePoses(20);
  const std::vector<Pose3d> reported = ReportedPoses(testing::DatasetOfPoses(poses));
  ASSERT_EQ(reported.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(reported[i].translation, poses[i].translation);
    EXPECT_EQ(reported[i].rotation.coeffs(), poses[i].rotation.coeffs());
  }
}

TEST(ReportedPoses, OfLegLengthsAreTheirForwardKinematics) {
  const std::vector<Pose3d> poses = WorkspacePoses(200);
  const std::vector<Pose3d> reported =
      ReportedPoses(testing::DatasetOfLegs(testing::LargeHexapod(), poses));
  ASSERT_EQ(reported.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i)
    EXPECT_TRUE(PoseNear(reported[i], poses[i], 1e-9, 1e-9)) << i;
}

TEST(ReportedPoses, DoNotDependOnTheOrderOfRows) {
  Dataset dataset = testing::DatasetOfLegs(testing::LargeHexapod(), WorkspacePoses(50));
  const std::vector<Pose3d> forward = ReportedPoses(dataset);
  std::reverse(dataset.robot_poses.rows.begin(), dataset.robot_poses.rows.end());
  std::vector<Pose3d> backward = ReportedPoses(dataset);
  std::reverse(backward.begin(), backward.end());
  for (std::size_t i = 0; i < forward.size(); ++i)
    EXPECT_TRUE(PoseNear(backward[i], forward[i], 0.0, 0.0)) << i;
}

TEST(ReportedPoses, UseTheHexapodThatIsGiven) {
  const std::vector<Pose3d> poses = WorkspacePoses(5);
  HexapodGeometry calibrated = testing::LargeHexapod();
  calibrated.base_joints_in_base.row(0).array() += 0.25;  // the base stands 0.25 m further on
  const Dataset dataset = testing::DatasetOfLegs(testing::LargeHexapod(), poses);
  const std::vector<Pose3d> reported = ReportedPoses(dataset.robot_poses, calibrated);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Pose3d moved = poses[i];
    moved.translation.x() += 0.25;
    EXPECT_TRUE(PoseNear(reported[i], moved, 1e-9, 1e-9));
  }
}

TEST(ReportedPoses, NameTheRowWhoseLegsReachNoPose) {
  Dataset dataset = testing::DatasetOfLegs(testing::LargeHexapod(), WorkspacePoses(5));
  dataset.robot_poses.rows[3].leg_lengths[4] += 2.0;
  const std::string message = MessageOf(dataset);
  EXPECT_EQ(message.find("poses.csv:5: found the leg lengths of pose 'p4' ("), 0u) << message;
  EXPECT_NE(message.find("leg 5 would be "), std::string::npos) << message;
  EXPECT_NE(message.find(" mm shorter"), std::string::npos) << message;
  EXPECT_NE(message.find("expected lengths, joint centre to joint centre"), std::string::npos);
}

TEST(ReportedPoses, AskForTheHexapodThatLegLengthsNeed) {
  Dataset dataset = testing::DatasetOfLegs(testing::LargeHexapod(), WorkspacePoses(3));
  dataset.hexapod.reset();
  EXPECT_EQ(MessageOf(dataset),
            "poses.csv: found leg lengths, but no hexapod that has these legs, expected hexapod: "
            "with base_joints and platform_joints beside robot_poses");
}

TEST(ReportedCovariances, AreEmptyForARobotTakenAsExact) {
  const std::vector<Pose3d> poses = WorkspacePoses(3);
  EXPECT_TRUE(ReportedCovariances(testing::DatasetOfPoses(poses), poses).empty());
}

TEST(ReportedCovariances, OfPosesAreTheStatedVariances) {
  const std::vector<Pose3d> poses = WorkspacePoses(3);
  Dataset dataset = testing::DatasetOfPoses(poses);
  dataset.robot_poses.noise = PoseNoise{{1, 2, 3}, {4, 5, 6}};
  const std::vector<Matrix6d> covariances = ReportedCovariances(dataset, poses);
  Vector6d variances;
  variances << 1, 4, 9, 16, 25, 36;
  ASSERT_EQ(covariances.size(), 3u);
  for (const Matrix6d& covariance : covariances)
    EXPECT_TRUE(MatrixNear(covariance, Matrix6d(variances.asDiagonal()), 1e-12));
}

TEST(ReportedCovariances, OfLegsAreTheLegNoiseSeenAtTheLegs) {
  const std::vector<Pose3d> poses = WorkspacePoses(20);
  Dataset dataset = testing::DatasetOfLegs(testing::LargeHexapod(), poses);
  dataset.robot_poses.leg_noise = 2e-5;
  const std::vector<Matrix6d> covariances = ReportedCovariances(dataset, poses);
  ASSERT_EQ(covariances.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Matrix6d jacobian = LegJacobian(testing::LargeHexapod(), poses[i]);
    const Matrix6d of_legs = jacobian * covariances[i] * jacobian.transpose() / (2e-5 * 2e-5);
    EXPECT_TRUE(MatrixNear(of_legs, Matrix6d::Identity(), 1e-9));
  }
}

// Forward kinematics of noisy lengths scatters as the covariance says.
TEST(ReportedCovariances, OfLegsAgreeWithRepeatedForwardKinematics) {
  std::mt19937_64 rng = SeededByTest();
  const HexapodGeometry hexapod = testing::LargeHexapod();
  const std::vector<Pose3d> poses = WorkspacePoses(1);
  Dataset dataset = testing::DatasetOfLegs(hexapod, poses);
  dataset.robot_poses.leg_noise = 1e-5;
  const Matrix6d stated = ReportedCovariances(dataset, poses)[0];
  const LegLengths lengths = InverseKinematics(hexapod, poses[0]);
  constexpr int kDraws = 4000;
  Matrix6d seen = Matrix6d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const LegLengths noisy = lengths + 1e-5 * testing::Normal(rng, 6);
    const ForwardKinematicsResult result = ForwardKinematics(hexapod, noisy, poses[0]);
    const Vector6d d = Minus(result.base_from_platform, poses[0]);
    seen += d * d.transpose() / kDraws;
  }
  const Vector6d scale = stated.diagonal().cwiseSqrt().cwiseInverse();
  EXPECT_TRUE(MatrixNear(scale.asDiagonal() * seen * scale.asDiagonal(),
                         scale.asDiagonal() * stated * scale.asDiagonal(),
                         0.07));
}

TEST(ReportedCovariances, RefuseAPoseAtWhichTheLegsDoNotHold) {
  HexapodGeometry upright = testing::SmallHexapod();
  upright.platform_joints_in_platform = upright.base_joints_in_base;
  const std::vector<Pose3d> poses = {{Eigen::Vector3d(0, 0, 0.2), Eigen::Quaterniond::Identity()}};
  Dataset dataset = testing::DatasetOfLegs(upright, poses);
  dataset.robot_poses.leg_noise = 1e-5;
  EXPECT_THROW(ReportedCovariances(dataset, poses), InputError);
}

TEST(PredictToolPoses, ChainsTheFramesOfEquation1) {
  Machine machine;
  machine.world_from_base = {Eigen::Vector3d(1, 0, 0), Exp(Eigen::Vector3d(0, 0, M_PI / 2))};
  machine.platform_from_tool = {Eigen::Vector3d(0.1, 0, 0), Exp(Eigen::Vector3d(M_PI / 2, 0, 0))};
  const Pose3d platform = {Eigen::Vector3d(0, 0.2, 0.5), Eigen::Quaterniond::Identity()};
  const std::vector<Pose3d> world_from_tool = PredictToolPoses(machine, {platform});
  ASSERT_EQ(world_from_tool.size(), 1u);
  EXPECT_TRUE(MatrixNear(world_from_tool[0].translation, Eigen::Vector3d(0.8, 0.1, 0.5), 1e-15));
  // The tool's y points up, its x along the world's y.
  EXPECT_TRUE(MatrixNear(
      world_from_tool[0].rotation * Eigen::Vector3d::UnitY(), Eigen::Vector3d(0, 0, 1), 1e-15));
  EXPECT_TRUE(MatrixNear(
      world_from_tool[0].rotation * Eigen::Vector3d::UnitX(), Eigen::Vector3d(0, 1, 0), 1e-15));
}

}  // namespace
}  // namespace hexcal
