// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "measurement/dataset.h"
#include "model/machine.h"
#include "testing/hexapods.h"
#include "testing/random.h"

namespace hexcal::testing {

inline constexpr int kGrownPoses = 60;

template <typename Rng>
Covariate RandomColumn(Rng& rng, const std::string& name, double low, double high) {
  Covariate column{name, {}, {}};
  for (int i = 0; i < kGrownPoses; ++i) column.values.push_back(Uniform(rng, low, high));
  return column;
}

// Every driver that an effect may need, four markers a body, a tracker 2 m away.
template <typename Rng>
Dataset Plan(Rng& rng, bool is_static) {
  Dataset dataset;
  dataset.path = "dataset.yaml";
  dataset.name = "grown";
  dataset.hexapod = LargeHexapod();
  dataset.gravity_in_base = Eigen::Vector3d(0, 0, -1);
  for (int i = 0; i < kGrownPoses; ++i) {
    Pose3d pose = SmallPose(rng, 0.06, 0.25);
    pose.translation.z() += kLargeHeight;
    dataset.robot_poses.rows.push_back({std::to_string(i + 1), pose, {}, i + 2});
  }
  std::vector<Covariate>& columns = dataset.robot_poses.covariates;
  columns.push_back(RandomColumn(rng, "temperature", 18.0, 26.0));
  columns.push_back(RandomColumn(rng, "payload", 0.0, 10.0));
  columns.push_back(RandomColumn(rng, "payload_z", 0.05, 0.1));
  for (const char* name : {"vx", "vy", "vz"})
    columns.push_back(RandomColumn(rng, name, -0.02, 0.02));
  for (const char* name : {"wx", "wy", "wz"}) columns.push_back(RandomColumn(rng, name, -0.1, 0.1));
  columns.push_back({"time", {}, {}});
  for (int i = 0; i < kGrownPoses; ++i) columns.back().values.push_back(60.0 * i);
  dataset.tracker.is_static = is_static;
  dataset.tracker.tracker_from_world = {{0.2, 0.1, 2.0}, Exp(Eigen::Vector3d(2.8, 0.3, 0.2))};
  Measurement& measurement = dataset.measurement.emplace();
  measurement.kind = Measurement::Kind::kMarkers;
  measurement.marker_sigma = Eigen::Vector3d(3e-5, 3e-5, 6e-5);
  measurement.bodies[0].markers = {"b1", "b2", "b3", "b4"};
  measurement.bodies[0].p_in_body.resize(3, 4);
  measurement.bodies[0].p_in_body << 0.4, -0.4, -0.4, 0.4, 0.3, 0.3, -0.3, -0.3, 0, 0.05, 0, 0.08;
  measurement.bodies[1].markers = {"t1", "t2", "t3", "t4"};
  measurement.bodies[1].p_in_body.resize(3, 4);
  measurement.bodies[1].p_in_body << 0.1, -0.1, -0.1, 0.1, 0.1, 0.1, -0.1, -0.1, 0, 0.03, 0, 0.05;
  return dataset;
}

template <typename Rng>
Machine TrueMachine(Rng& rng) {
  Machine machine;
  machine.world_from_base = SmallPose(rng, 0.3, 1.0);
  machine.platform_from_tool = SmallPose(rng, 0.05, 0.5);
  return machine;
}

}  // namespace hexcal::testing
