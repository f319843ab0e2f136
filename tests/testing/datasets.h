// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "measurement/dataset.h"
#include "model/hexapod.h"

namespace hexcal::testing {

// A dataset without measurement whose poses p1, p2, ... stand in lines 2, 3, ... of poses.csv.
inline Dataset DatasetOfPoses(const std::vector<Pose3d>& base_from_platform) {
  Dataset dataset;
  dataset.path = "dataset.yaml";
  dataset.name = "test";
  dataset.robot_poses.where = FileLocation("poses.csv");
  for (const Pose3d& pose : base_from_platform) {
    const int row = static_cast<int>(dataset.robot_poses.rows.size());
    dataset.robot_poses.rows.push_back({"p" + std::to_string(row + 1), pose, {}, row + 2});
  }
  return dataset;
}

// The same poses recorded as leg lengths.
inline Dataset DatasetOfLegs(const HexapodGeometry& hexapod,
                             const std::vector<Pose3d>& base_from_platform) {
  Dataset dataset = DatasetOfPoses(base_from_platform);
  dataset.hexapod = hexapod;
  dataset.robot_poses.are_leg_lengths = true;
  for (RobotPose& row : dataset.robot_poses.rows) {
    const LegLengths lengths = InverseKinematics(hexapod, row.base_from_platform);
    std::copy(lengths.data(), lengths.data() + kNumLegs, row.leg_lengths.begin());
    row.base_from_platform = Pose3d();
  }
  return dataset;
}

}  // namespace hexcal::testing
