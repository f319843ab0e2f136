// SPDX-License-Identifier: BSD-3-Clause
// From simulated markers to the covariance of the 12: what is reported is the spread of repeats,
// with a tracker that stood still (whose common error the base inherits) and with one that moved.
#include <gtest/gtest.h>

#include <algorithm>

#include "estimator/calibrate.h"
#include "model/simulate.h"
#include "testing/datasets.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::Difference;
using testing::SeededByTest;

constexpr int kPoses = 9;
constexpr int kDraws = 1500;

MarkerBody RigidBody(const std::string& prefix) {
  MarkerBody body;
  body.p_in_body.resize(3, 4);
  body.p_in_body << 0.1, -0.05, -0.06, 0.0, 0.0, 0.08, -0.07, 0.02, 0.0, 0.01, 0.0, 0.06;
  for (int m = 1; m <= 4; ++m) body.markers.push_back(prefix + std::to_string(m));
  return body;
}

// Three markers whose centroid frame is the frame in which they are given.
MarkerBody FlatBody(const std::string& prefix) {
  MarkerBody body;
  body.p_in_body.resize(3, 3);
  body.p_in_body << -0.05, 0.07, -0.02, -0.03, -0.03, 0.06, 0, 0, 0;
  for (int m = 1; m <= 3; ++m) body.markers.push_back(prefix + std::to_string(m));
  return body;
}

struct Scene {
  bool tracker_is_static;
  bool centroid;
  double robot_noise;
};

// The base is hidden in most poses of a static tracker; of a rigid body one marker or another is
// hidden in some frames.
bool IsSeen(const Scene& scene, const MarkerReading& r) {
  if (scene.tracker_is_static && r.body == BodyId::kBase && r.pose > 1) return false;
  return scene.centroid || (r.pose + r.frame) % 5 != r.marker;
}

Dataset MakeDataset(const Scene& scene, const std::vector<Pose3d>& poses, const Pose3d& tracker) {
  Dataset dataset = testing::DatasetOfPoses(poses);
  dataset.tracker.is_static = scene.tracker_is_static;
  dataset.tracker.frames = 3;
  dataset.tracker.tracker_from_world = tracker;
  dataset.measurement.emplace();
  Measurement& m = *dataset.measurement;
  m.kind = Measurement::Kind::kMarkers;
  m.where = FileLocation("markers.csv");
  m.marker_sigma = Eigen::Vector3d(1e-4, 0.7e-4, 3e-4);
  for (int b = 0; b < 2; ++b)
    m.bodies[b] = scene.centroid ? FlatBody(b == 0 ? "b" : "t") : RigidBody(b == 0 ? "b" : "t");
  if (scene.robot_noise > 0)
    dataset.robot_poses.noise = PoseNoise{Eigen::Vector3d::Constant(scene.robot_noise),
                                          Eigen::Vector3d::Constant(10 * scene.robot_noise)};
  return dataset;
}

Dataset Draw(const Scene& scene, const Dataset& dataset, const Machine& machine, int seed) {
  SimulateOptions options;
  options.seed = static_cast<std::uint64_t>(seed);
  Dataset drawn = Simulate(dataset, machine, options);
  auto& readings = drawn.measurement->readings;
  readings.erase(std::remove_if(readings.begin(),
                                readings.end(),
                                [&](const MarkerReading& r) { return !IsSeen(scene, r); }),
                 readings.end());
  if (scene.centroid)
    for (MarkerBody& body : drawn.measurement->bodies) {
      body.is_centroid = true;
      body.p_in_body.resize(3, 0);
    }
  return drawn;
}

void ExpectReportedSpread(const Scene& scene) {
  auto rng = SeededByTest();
  const BaseAndTool truth = testing::AnyMounts(rng);
  const Machine machine{"test", truth.world_from_base, truth.platform_from_tool, {}, {}};
  std::vector<Pose3d> poses;
  for (int i = 0; i < kPoses; ++i) poses.push_back(testing::SmallPose(rng, 0.1, 0.5));
  const Dataset dataset = MakeDataset(scene, poses, testing::RandomPose(rng, 1.5));
  Vector12d squared = Vector12d::Zero(), variance = Vector12d::Zero();
  double of_all = 0.0, of_base = 0.0, chi_square = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const Estimate e = Calibrate(MakeObservations(Draw(scene, dataset, machine, i)), {}, {});
    ASSERT_TRUE(e.IsTrustworthy());
    const Vector12d d = Difference(e.mounts, truth);
    squared += d.cwiseAbs2() / kDraws;
    variance += e.covariance.diagonal() / kDraws;
    of_all += d.dot(e.covariance.ldlt().solve(d)) / kDraws;
    const Matrix6d base = e.covariance.topLeftCorner<6, 6>();
    of_base += d.head<6>().dot(base.ldlt().solve(d.head<6>())) / kDraws;
    chi_square += e.chi_square / e.degrees_of_freedom / kDraws;
  }
  // Five standard deviations of each mean; three of the single sigmas.
  EXPECT_NEAR(of_all, 12.0, 0.6);
  EXPECT_NEAR(of_base, 6.0, 0.45);
  EXPECT_NEAR(chi_square, 1.0, 0.03);
  for (int i = 0; i < 12; ++i)
    EXPECT_NEAR(std::sqrt(squared[i] / variance[i]), 1.0, 0.06) << kParameters[i].name;
}

TEST(MarkerCovariance, StaticTrackerRigidBodies) { ExpectReportedSpread({true, false, 0.0}); }
TEST(MarkerCovariance, StaticTrackerCentroidBodies) { ExpectReportedSpread({true, true, 0.0}); }
TEST(MarkerCovariance, MovingTrackerRigidBodies) { ExpectReportedSpread({false, false, 0.0}); }
TEST(MarkerCovariance, MovingTrackerCentroidBodies) { ExpectReportedSpread({false, true, 0.0}); }
TEST(MarkerCovariance, MovingTrackerAndANoisyRobot) { ExpectReportedSpread({false, false, 1e-4}); }

}  // namespace
}  // namespace hexcal
