// SPDX-License-Identifier: BSD-3-Clause
#include "testing/marker_scenes.h"

#include <algorithm>

#include "model/simulate.h"
#include "testing/datasets.h"
#include "testing/scenes.h"

namespace hexcal::testing {
namespace {

MarkerBody Body(bool centroid, const std::string& prefix) {
  MarkerBody body;
  if (centroid) {  // its centroid frame is the frame in which it is given
    body.p_in_body.resize(3, 3);
    body.p_in_body << -0.05, 0.07, -0.02, -0.03, -0.03, 0.06, 0, 0, 0;
  } else {
    body.p_in_body.resize(3, 4);
    body.p_in_body << 0.1, -0.05, -0.06, 0.0, 0.0, 0.08, -0.07, 0.02, 0.0, 0.01, 0.0, 0.06;
  }
  for (int m = 1; m <= body.p_in_body.cols(); ++m)
    body.markers.push_back(prefix + std::to_string(m));
  return body;
}

bool IsSeen(const MarkerScene& scene, const MarkerReading& r) {
  if (scene.tracker_is_static && r.body == BodyId::kBase && r.pose > 1) return false;
  return scene.centroid[static_cast<int>(r.body)] || (r.pose + r.frame) % 5 != r.marker;
}

}  // namespace

MarkerTruth MakeMarkerTruth(std::mt19937_64& rng, const MarkerScene& scene) {
  MarkerTruth truth{scene, AnyMounts(rng), {}};
  std::vector<Pose3d> poses;
  for (int i = 0; i < scene.poses; ++i) poses.push_back(SmallPose(rng, 0.1, 0.5));
  truth.dataset = DatasetOfPoses(poses);
  Dataset& dataset = truth.dataset;
  dataset.tracker.is_static = scene.tracker_is_static;
  dataset.tracker.frames = scene.frames;
  dataset.tracker.tracker_from_world = RandomPose(rng, 1.5);
  dataset.measurement.emplace();
  Measurement& m = *dataset.measurement;
  m.kind = Measurement::Kind::kMarkers;
  m.where = FileLocation("markers.csv");
  m.marker_sigma = scene.sigma;
  m.bodies = {Body(scene.centroid[0], "b"), Body(scene.centroid[1], "t")};
  if (scene.robot_noise > 0)
    dataset.robot_poses.noise = PoseNoise{scene.robot_noise * Eigen::Vector3d(1.0, 0.5, 2.0),
                                          scene.robot_noise * Eigen::Vector3d(10.0, 5.0, 20.0)};
  return truth;
}

Dataset DrawMarkers(const MarkerTruth& truth, std::uint64_t seed, double noise) {
  const Machine machine{
      "test", truth.mounts.world_from_base, truth.mounts.platform_from_tool, {}, {}};
  SimulateOptions options;
  options.seed = seed;
  options.noise = noise;
  Dataset drawn = Simulate(truth.dataset, machine, options);
  auto& readings = drawn.measurement->readings;
  readings.erase(std::remove_if(readings.begin(),
                                readings.end(),
                                [&](const MarkerReading& r) { return !IsSeen(truth.scene, r); }),
                 readings.end());
  for (int b = 0; b < 2; ++b) {
    if (!truth.scene.centroid[b]) continue;
    drawn.measurement->bodies[b].is_centroid = true;
    drawn.measurement->bodies[b].p_in_body.resize(3, 0);
  }
  return drawn;
}

Eigen::VectorXd BlockDifference(const ParameterBlocks& a, const ParameterBlocks& b) {
  Eigen::VectorXd all;
  for (std::size_t i = 0; i < a.size(); ++i) {
    Eigen::VectorXd d = a[i] - b[i];
    if (a[i].size() == Pose3d::kNumParameters)
      d = Minus(Pose3d::FromParameters(a[i].data()), Pose3d::FromParameters(b[i].data()));
    all.conservativeResize(all.size() + d.size());
    all.tail(d.size()) = d;
  }
  return all;
}

}  // namespace hexcal::testing
