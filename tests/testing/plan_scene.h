// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "model/simulate.h"
#include "testing/grown_scene.h"

namespace hexcal::testing {

// Measured poses of kind poses, 20 um and 0.1 mrad, from a tracker that gives no single markers.
template <typename Rng>
Dataset PoseDataset(Rng& rng, int poses, bool has_hexapod) {
  Dataset dataset;
  dataset.path = "dataset.yaml";
  dataset.name = "planned";
  if (has_hexapod) {
    dataset.hexapod = LargeHexapod();
    dataset.hexapod->leg_limits = Eigen::Vector2d(0.4, 0.75);
  }
  for (int i = 0; i < poses; ++i) {
    Pose3d pose = SmallPose(rng, 0.04, 0.15);
    pose.translation.z() += kLargeHeight;
    dataset.robot_poses.rows.push_back({std::to_string(i + 1), pose, {}, i + 2});
  }
  Measurement& measurement = dataset.measurement.emplace();
  measurement.kind = Measurement::Kind::kPoses;
  measurement.pose_noise =
      PoseNoise{Eigen::Vector3d::Constant(2e-5), Eigen::Vector3d::Constant(1e-4)};
  return dataset;
}

inline void AddColumn(const std::string& name,
                      const std::vector<double>& values,
                      Dataset* dataset) {
  dataset->robot_poses.covariates.push_back({name, {}, {}});
  for (std::size_t i = 0; i < dataset->robot_poses.rows.size(); ++i)
    dataset->robot_poses.covariates.back().values.push_back(values[i % values.size()]);
}

inline Dataset Measured(const Dataset& dataset, const Machine& machine, std::uint64_t seed) {
  SimulateOptions options;
  options.seed = seed;
  return Simulate(dataset, machine, options);
}

// The dataset with further robot poses; its measurement is to be simulated again.
inline Dataset Extended(Dataset dataset, const RobotPoses& planned) {
  RobotPoses& poses = dataset.robot_poses;
  poses.rows.insert(poses.rows.end(), planned.rows.begin(), planned.rows.end());
  for (std::size_t c = 0; c < poses.covariates.size(); ++c)
    poses.covariates[c].values.insert(poses.covariates[c].values.end(),
                                      planned.covariates[c].values.begin(),
                                      planned.covariates[c].values.end());
  return dataset;
}

}  // namespace hexcal::testing
