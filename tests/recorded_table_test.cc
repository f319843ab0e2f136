// SPDX-License-Identifier: BSD-3-Clause
// Poses written in a dataset's own columns are read back as they were.
#include "measurement/recorded_table.h"

#include <gtest/gtest.h>

#include "testing/random.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using ::hexcal::testing::RandomPose;
using ::hexcal::testing::SeededByTest;
using ::hexcal::testing::TemporaryFolder;

constexpr const char* kYaml = R"(format: hexcal/dataset/1
name: recorded
units: {length: mm, angle: deg}
covariates: {time: min, payload: kg}
robot_poses: {file: poses.csv}
measurement: {kind: poses}
)";

class RecordedTable : public ::testing::TestWithParam<const char*> {};

TEST_P(RecordedTable, IsReadBackAsItWas) {
  auto rng = SeededByTest();
  const TemporaryFolder folder;
  const std::string yaml = folder.Write("dataset.yaml", kYaml);
  const std::string identity =
      std::string(GetParam()).find("qw") != std::string::npos    ? "0,1,2,3,1,0,0,0,a,4\n"
      : std::string(GetParam()).find("r11") != std::string::npos ? "0,1,2,3,1,0,0,0,1,0,0,0,1,a,4\n"
                                                                 : "0,1,2,3,0,0,0,a,4\n";
  // The covariates before and behind the pose, in another order than declared.
  folder.Write("poses.csv", std::string("payload,x,y,z,") + GetParam() + ",pose,time\n" + identity);
  const Dataset dataset = ReadDataset(yaml, false);
  RobotPoses poses = dataset.robot_poses;
  poses.rows.clear();
  for (Covariate& covariate : poses.covariates) covariate.values.clear();
  std::vector<Pose3d> truth;
  for (int i = 0; i < 20; ++i) {
    truth.push_back(RandomPose(rng, 0.4));
    RobotPose row;
    row.label = "plan-" + std::to_string(i);
    row.base_from_platform = truth.back();
    row.leg_lengths = {};
    poses.rows.push_back(row);
    poses.covariates[0].values.push_back(90.0 * i);
    poses.covariates[1].values.push_back(0.5 * i);
  }
  const RecordedColumns columns = ReadRecordedColumns(yaml);
  EXPECT_EQ(columns.names.front(), "payload");
  EXPECT_EQ(columns.names.back(), "time");
  folder.Write("poses.csv", ::hexcal::RecordedTable(columns, poses, truth));
  const Dataset again = ReadDataset(yaml, false);
  ASSERT_EQ(again.robot_poses.rows.size(), 20u);
  for (int i = 0; i < 20; ++i) {
    const RobotPose& row = again.robot_poses.rows[i];
    EXPECT_EQ(row.label, poses.rows[i].label);
    EXPECT_LT(Minus(row.base_from_platform, truth[i]).norm(), 1e-12) << i;
    EXPECT_NEAR(again.robot_poses.covariates[0].values[i], 90.0 * i, 1e-10);
    EXPECT_EQ(again.robot_poses.covariates[1].values[i], 0.5 * i);
  }
}

INSTANTIATE_TEST_SUITE_P(Rotations,
                         RecordedTable,
                         ::testing::Values("rx,ry,rz",
                                           "qw,qx,qy,qz",
                                           "r11,r12,r13,r21,r22,r23,r31,r32,r33"));

TEST(RecordedLegs, AreWrittenInTheTablesUnit) {
  const TemporaryFolder folder;
  const std::string yaml = folder.Write("dataset.yaml", std::string(kYaml) + R"(hexapod:
  base_joints: [[200, 0, 0], [100, 170, 0], [-100, 170, 0], [-200, 0, 0], [-100, -170, 0], [100, -170, 0]]
  platform_joints: [[90, 50, 0], [0, 100, 0], [-90, 50, 0], [-90, -50, 0], [0, -100, 0], [90, -50, 0]]
)");
  folder.Write("poses.csv", "pose,l1,l2,l3,l4,l5,l6,time,payload\n1,300,300,300,300,300,300,0,0\n");
  RobotPoses poses = ReadDataset(yaml, false).robot_poses;
  poses.rows[0].leg_lengths = {0.301, 0.302, 0.303, 0.304, 0.305, 0.306};
  const std::string table = ::hexcal::RecordedTable(ReadRecordedColumns(yaml), poses, {Pose3d()});
  folder.Write("poses.csv", table);
  const Dataset again = ReadDataset(yaml, false);
  for (int leg = 0; leg < kNumLegs; ++leg)
    EXPECT_NEAR(again.robot_poses.rows[0].leg_lengths[leg], 0.301 + 0.001 * leg, 1e-15);
}

}  // namespace
}  // namespace hexcal
