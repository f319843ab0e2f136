// SPDX-License-Identifier: BSD-3-Clause
// Not covered: that real machines never look odd; the thresholds are far from all that were tried.
#include "measurement/dataset_warnings.h"

#include <gtest/gtest.h>

#include "testing/hexapods.h"
#include "testing/random.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using testing::RandomPose;
using testing::SeededByTest;
using testing::TemporaryFolder;

constexpr int kNumPoses = 20;
const Pose3d kWorldFromBase = {{1, 2, 3}, Eigen::Quaterniond(0.6, 0, 0.8, 0)};

// A good dataset: a robot that moves some 0.1 m, measured by poses.
Dataset Good(std::mt19937_64& rng) {
  Dataset dataset;
  dataset.path = "d.yaml";
  dataset.hexapod = testing::SmallHexapod();
  Measurement& measurement = dataset.measurement.emplace();
  const Pose3d platform_from_tool = {{0.1, 0, 0.2}, Eigen::Quaterniond::Identity()};
  for (int i = 0; i < kNumPoses; ++i) {
    RobotPose pose;
    pose.label = std::to_string(i);
    pose.base_from_platform = testing::RandomWorkspacePose(rng, testing::kSmallHeight, 0.3);
    dataset.robot_poses.rows.push_back(pose);
    measurement.poses.push_back({i, kWorldFromBase * pose.base_from_platform * platform_from_tool});
  }
  return dataset;
}

// The same, seen as markers by a tracker that stands elsewhere for every pose.
Dataset GoodMarkers(std::mt19937_64& rng) {
  Dataset dataset = Good(rng);
  Measurement& measurement = *dataset.measurement;
  measurement.kind = Measurement::Kind::kMarkers;
  for (MarkerBody& body : measurement.bodies) {
    body.markers = {"a", "b", "c", "d"};
    body.p_in_body = 0.1 * Eigen::Matrix3Xd::Random(3, 4);
  }
  for (const MeasuredPose& pose : measurement.poses) {
    const Pose3d tracker_from_world = RandomPose(rng, 5.0);
    for (int body = 0; body < 2; ++body)
      for (int marker = 0; marker < 4; ++marker) {
        const Eigen::Vector3d p = measurement.bodies[body].p_in_body.col(marker);
        measurement.readings.push_back(
            {pose.pose,
             0,
             static_cast<BodyId>(body),
             marker,
             tracker_from_world * (body == 0 ? p : pose.world_from_tool * p)});
      }
  }
  measurement.poses.clear();
  return dataset;
}

::testing::AssertionResult WarnsOnce(const Dataset& dataset, const std::string& words) {
  const std::vector<std::string> warnings = FindOddities(dataset);
  if (warnings.size() == 1 && warnings[0].find(words) != std::string::npos)
    return ::testing::AssertionSuccess();
  auto result = ::testing::AssertionFailure() << warnings.size() << " warnings:";
  for (const std::string& warning : warnings) result << "\n" << warning;
  return result;
}

TEST(DatasetWarnings, GoodDataLookGood) {
  std::mt19937_64 rng = SeededByTest();
  for (int repeat = 0; repeat < 50; ++repeat) {
    EXPECT_TRUE(FindOddities(Good(rng)).empty());
    EXPECT_TRUE(FindOddities(GoodMarkers(rng)).empty());
  }
}

TEST(DatasetWarnings, MeasuredPosesInTheOtherUnit) {
  std::mt19937_64 rng = SeededByTest();
  for (const double factor : {1000.0, 0.001}) {
    Dataset dataset = Good(rng);
    for (MeasuredPose& pose : dataset.measurement->poses)
      pose.world_from_tool.translation *= factor;
    EXPECT_TRUE(WarnsOnce(dataset, "the travel in robot_poses and that in the measurement"));
  }
}

TEST(DatasetWarnings, RobotPosesInTheOtherUnit) {
  std::mt19937_64 rng = SeededByTest();
  Dataset dataset = GoodMarkers(rng);
  dataset.hexapod.reset();
  for (RobotPose& pose : dataset.robot_poses.rows) pose.base_from_platform.translation *= 1000;
  EXPECT_TRUE(WarnsOnce(dataset, "the travel in robot_poses and that in the measurement"));
}

TEST(DatasetWarnings, LegLengthsInTheOtherUnit) {
  std::mt19937_64 rng = SeededByTest();
  Dataset dataset = Good(rng);
  dataset.hexapod.reset();
  dataset.robot_poses.are_leg_lengths = true;
  for (RobotPose& pose : dataset.robot_poses.rows)
    for (double& length : pose.leg_lengths) length = testing::Uniform(rng, 0.2, 0.3);
  EXPECT_TRUE(FindOddities(dataset).empty());
  for (RobotPose& pose : dataset.robot_poses.rows)
    for (double& length : pose.leg_lengths) length *= 1000;
  EXPECT_TRUE(WarnsOnce(dataset, "the travel in robot_poses and that in the measurement"));
}

TEST(DatasetWarnings, AllInTheOtherUnit) {
  auto rng = SeededByTest();
  for (const double factor : {1.0, 1000.0, 0.001})
    for (const bool has_joints : {true, false}) {
      Dataset dataset = Good(rng);
      dataset.hexapod->base_joints_in_base *= factor;
      dataset.hexapod->platform_joints_in_platform *= factor;
      if (!has_joints) dataset.hexapod.reset();
      for (RobotPose& pose : dataset.robot_poses.rows)
        pose.base_from_platform.translation *= factor;
      for (MeasuredPose& pose : dataset.measurement->poses)
        pose.world_from_tool.translation *= factor;
      if (factor == 1.0 || (factor < 1.0 && !has_joints))
        EXPECT_TRUE(FindOddities(dataset).empty());
      else
        EXPECT_TRUE(WarnsOnce(dataset, "are all lengths in the other unit"));
    }
}

TEST(DatasetWarnings, ABodyInTheOtherUnit) {
  std::mt19937_64 rng = SeededByTest();
  for (const double factor : {1000.0, 0.001}) {
    Dataset dataset = GoodMarkers(rng);
    dataset.measurement->bodies[1].p_in_body *= factor;
    EXPECT_TRUE(WarnsOnce(dataset, "the markers of the tool body are"));
    EXPECT_TRUE(WarnsOnce(
        dataset, factor > 1 ? "as far apart in bodies: as" : "as far apart in the table as"));
  }
}

TEST(DatasetWarnings, JointsInTheOtherUnit) {
  std::mt19937_64 rng = SeededByTest();
  for (const double factor : {1000.0, 0.001}) {
    Dataset dataset = Good(rng);
    dataset.hexapod->base_joints_in_base *= factor;
    EXPECT_TRUE(WarnsOnce(dataset, "the joints of the hexapod and the lengths in robot_poses"));
  }
}

TEST(DatasetWarnings, JointsThatCoincide) {
  std::mt19937_64 rng = SeededByTest();
  Dataset dataset = Good(rng);
  dataset.hexapod->platform_joints_in_platform.col(4) =
      dataset.hexapod->platform_joints_in_platform.col(1);
  EXPECT_TRUE(WarnsOnce(dataset, "platform_joints 2 and 5 are the same point"));
}

TEST(DatasetWarnings, ARobotThatOnlyTurnsIsNotOdd) {
  std::mt19937_64 rng = SeededByTest();
  Dataset dataset = Good(rng);
  for (RobotPose& pose : dataset.robot_poses.rows)
    pose.base_from_platform.translation = Eigen::Vector3d(0.1, 0.2, 0.3);
  EXPECT_TRUE(FindOddities(dataset).empty());
}

TEST(DatasetWarnings, MarkersThatWereNotSeenAreNoTravel) {
  // A positioner that moves some micrometres: the centre of a body moves more when a marker is
  // missing.
  std::mt19937_64 rng = SeededByTest();
  Dataset dataset = GoodMarkers(rng);
  dataset.hexapod.reset();
  for (RobotPose& pose : dataset.robot_poses.rows)
    pose.base_from_platform.translation = testing::UniformVector(rng, 1e-5);
  std::vector<MarkerReading>& readings = dataset.measurement->readings;
  const std::vector<MarkerReading> first(readings.begin(), readings.begin() + 8);
  readings.clear();
  for (int pose = 0; pose < kNumPoses; ++pose)
    for (MarkerReading reading : first) {
      reading.pose = pose;
      reading.p_in_tracker += testing::UniformVector(rng, 1e-5);
      if (reading.marker != pose % 8) readings.push_back(reading);
    }
  EXPECT_TRUE(FindOddities(dataset).empty());
}

TEST(DatasetWarnings, DegreesUnderRadians) {
  const std::string poses =
      "format: hexcal/dataset/1\nname: d\nunits: {length: m, angle: UNIT}\nrobot_poses:\n"
      "  rows: [[pose, x, y, z, rx, ry, rz], [a, 0, 0, 0, 0, 6.2, 0], [b, 0, 0, 0, 0, 0, -6.3], "
      "[c, 0, 0, 0, 0, 0, 45]]\n";
  const auto warnings = [&](const std::string& unit) {
    const TemporaryFolder folder;
    std::string yaml = poses;
    yaml.replace(yaml.find("UNIT"), 4, unit);
    return ReadDataset(folder.Write("d.yaml", yaml), false).warnings;
  };
  ASSERT_EQ(warnings("rad").size(), 1u);  // once, for the first pose of them
  EXPECT_NE(warnings("rad")[0].find("pose 'b' has an angle of more than a turn"),
            std::string::npos);
  EXPECT_TRUE(warnings("deg").empty());
}

}  // namespace
}  // namespace hexcal
