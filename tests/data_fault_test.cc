// SPDX-License-Identifier: BSD-3-Clause
#include "model/data_fault.h"

#include "geometry/rotation_angles.h"
#include "model/hexapod.h"
#include "model/predict.h"
#include "testing/datasets.h"
#include "testing/hexapods.h"
#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::PoseNear;
using testing::SeededByTest;

std::vector<Pose3d> Truth(int count) {
  std::mt19937_64 rng = SeededByTest();
  std::vector<Pose3d> poses;
  for (int i = 0; i < count; ++i)
    poses.push_back(testing::RandomWorkspacePose(rng, testing::kLargeHeight, 0.3));
  return poses;
}

Effect Fault(const std::string& name) {
  Effect effect;
  effect.name = name;
  return effect;
}

// Truth recorded as `record` does, then mended.
template <typename Record>
void ExpectMended(const Effect& fault, const Record& record) {
  const std::vector<Pose3d> truth = Truth(20);
  std::vector<Pose3d> recorded;
  for (const Pose3d& pose : truth) recorded.push_back(record(pose));
  const HexapodGeometry hexapod = testing::LargeHexapod();
  const RobotPoses mended =
      MendedRobotPoses(testing::DatasetOfPoses(recorded).robot_poses, {fault}, &hexapod);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_FALSE(PoseNear(recorded[i], truth[i], 1e-4, 1e-4)) << "the record is no fault";
    EXPECT_TRUE(PoseNear(mended.rows[i].base_from_platform, truth[i], 1e-10, 1e-10));
  }
}

TEST(DataFault, RotationsInAnotherOrderAreMended) {
  Effect fault = Fault("wrong_rotation_order");
  fault.found["order"] = "zyx";
  // R = Rz(c) Ry(b) Rx(a) was meant; the angles a b c were taken for Rx Ry Rz. Of R' = Rx(-a)
  // Ry(-b) Rz(-c) the angles are -a -b -c.
  ExpectMended(fault, [](const Pose3d& pose) {
    const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
    const Eigen::Vector3d angles = -AnglesFromRotation(rotation.transpose());
    return MakePose(RotationFromAngles(angles), pose.translation);
  });
}

TEST(DataFault, TransposedRotationsAreMended) {
  ExpectMended(Fault("transposed_rotation"), [](const Pose3d& pose) {
    return MakePose(pose.rotation.toRotationMatrix().transpose(), pose.translation);
  });
}

TEST(DataFault, QuaternionsWithTheScalarLastAreMended) {
  ExpectMended(Fault("wrong_quaternion_order"), [](const Pose3d& pose) {
    const Eigen::Quaterniond& q = pose.rotation;
    return Pose3d{pose.translation, Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w())};
  });
}

TEST(DataFault, LengthsInAnotherUnitAreMended) {
  Effect fault = Fault("wrong_unit");
  fault.found["of"] = "lengths";
  fault.reference["factor"] = {25.4};
  ExpectMended(fault, [](Pose3d pose) {
    pose.translation /= 25.4;
    return pose;
  });
}

TEST(DataFault, AnglesInAnotherUnitAreMended) {
  Effect fault = Fault("wrong_unit");
  fault.found["of"] = "angles";
  fault.reference["factor"] = {180.0 / M_PI};
  ExpectMended(fault, [](const Pose3d& pose) {
    const Eigen::Vector3d angles = AnglesFromRotation(pose.rotation.toRotationMatrix());
    return MakePose(RotationFromAngles(angles * M_PI / 180.0), pose.translation);
  });
}

TEST(DataFault, SwappedLegsOfRecordedLengthsAreMended) {
  Effect fault = Fault("swapped_legs");
  fault.reference["permutation"] = {2, 3, 1, 4, 5, 6};
  Dataset dataset = testing::DatasetOfLegs(testing::LargeHexapod(), Truth(5));
  const RobotPoses truth = dataset.robot_poses;
  // In the place of leg 1 stands leg 2, of leg 2 leg 3, of leg 3 leg 1.
  for (RobotPose& row : dataset.robot_poses.rows) {
    const auto legs = row.leg_lengths;
    row.leg_lengths = {legs[1], legs[2], legs[0], legs[3], legs[4], legs[5]};
  }
  const RobotPoses mended = MendedRobotPoses(dataset.robot_poses, {fault}, nullptr);
  for (std::size_t i = 0; i < truth.rows.size(); ++i)
    EXPECT_EQ(mended.rows[i].leg_lengths, truth.rows[i].leg_lengths);
}

TEST(DataFault, SwappedLegsOfRecordedPosesAreMended) {
  Effect fault = Fault("swapped_legs");
  fault.reference["permutation"] = {1, 2, 4, 3, 5, 6};
  const HexapodGeometry hexapod = testing::LargeHexapod();
  std::vector<Pose3d> truth, recorded;
  for (const Pose3d& pose : Truth(40)) {
    LegLengths lengths = InverseKinematics(hexapod, pose);
    std::swap(lengths[2], lengths[3]);
    const ForwardKinematicsResult swapped = ForwardKinematics(hexapod, lengths, pose);
    if (!swapped.converged) continue;
    truth.push_back(pose);
    recorded.push_back(swapped.base_from_platform);
  }
  ASSERT_GT(truth.size(), 10u);
  const RobotPoses mended =
      MendedRobotPoses(testing::DatasetOfPoses(recorded).robot_poses, {fault}, &hexapod);
  for (std::size_t i = 0; i < truth.size(); ++i)
    EXPECT_TRUE(PoseNear(mended.rows[i].base_from_platform, truth[i], 1e-9, 1e-9));
}

TEST(DataFault, ShiftedRowsAreMendedUpToTheEnds) {
  Effect fault = Fault("shifted_rows");
  fault.reference["rows"] = {1};
  const std::vector<Pose3d> poses = Truth(4);
  const RobotPoses recorded = testing::DatasetOfPoses(poses).robot_poses;
  const RobotPoses mended = MendedRobotPoses(recorded, {fault}, nullptr);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(mended.rows[i].base_from_platform.translation, poses[std::min(i + 1, 3)].translation);
    EXPECT_EQ(mended.rows[i].label, recorded.rows[i].label);
  }
}

TEST(DataFault, SeveralAreMendedInTheirOrder) {
  Effect unit = Fault("wrong_unit"), shift = Fault("shifted_rows");
  unit.found["of"] = "lengths";
  unit.reference["factor"] = {1000};
  shift.reference["rows"] = {-1};
  const std::vector<Pose3d> poses = Truth(3);
  const RobotPoses mended =
      MendedRobotPoses(testing::DatasetOfPoses(poses).robot_poses, {unit, shift}, nullptr);
  EXPECT_EQ(mended.rows[2].base_from_platform.translation, 1000 * poses[1].translation);
}

TEST(DataFault, OtherEffectsMendNothing) {
  const std::vector<Pose3d> poses = Truth(3);
  const RobotPoses mended =
      MendedRobotPoses(testing::DatasetOfPoses(poses).robot_poses, {Fault("leg_offset")}, nullptr);
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(mended.rows[i].base_from_platform.translation, poses[i].translation);
}

TEST(DataFault, SwappedMarkersHaveEachOthersName) {
  Effect fault = Fault("swapped_markers");
  fault.index = {2, 4};
  EXPECT_EQ(MarkersAsRead({fault}, 5), (std::vector<int>{0, 3, 2, 1, 4}));
}

}  // namespace
}  // namespace hexcal
