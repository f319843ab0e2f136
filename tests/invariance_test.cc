// SPDX-License-Identifier: BSD-3-Clause
// The result depends on what was measured, not on how it is written down: order of rows, units,
// where the tracker stands.
#include <fmt/format.h>

#include <algorithm>

#include "config/units.h"
#include "estimator/calibrate.h"
#include "geometry/rotation_angles.h"
#include "model/predict.h"
#include "model/simulate.h"
#include "testing/datasets.h"
#include "testing/matchers.h"
#include "testing/scenes.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using testing::Difference;
using testing::MatrixNear;
using testing::SeededByTest;

constexpr double kSame = 1e-9;

MarkerBody Body(const std::string& prefix, double size) {
  MarkerBody body;
  body.p_in_body.resize(3, 4);
  body.p_in_body << 1, -0.5, -0.6, 0, 0, 0.8, -0.7, 0.2, 0, 0.1, 0, 0.6;
  body.p_in_body *= size;
  for (int m = 1; m <= 4; ++m) body.markers.push_back(prefix + std::to_string(m));
  return body;
}

// 20 poses, both bodies' markers with noise, a tracker somewhere.
template <typename Rng>
Dataset MarkerDataset(Rng& rng, const Eigen::Vector3d& sigma) {
  std::vector<Pose3d> poses;
  const Pose3d height{Eigen::Vector3d(0, 0, 0.2), Eigen::Quaterniond::Identity()};
  for (int i = 0; i < 20; ++i) poses.push_back(height * testing::SmallPose(rng, 0.04, 0.3));
  Dataset dataset = testing::DatasetOfPoses(poses);
  dataset.measurement.emplace();
  dataset.measurement->kind = Measurement::Kind::kMarkers;
  dataset.measurement->bodies = {Body("b", 0.15), Body("t", 0.08)};
  dataset.measurement->marker_sigma = sigma;
  dataset.measurement->where = FileLocation("markers.csv");
  dataset.tracker.tracker_from_world = testing::RandomPose(rng, 1.5);
  const BaseAndTool truth = testing::AnyMounts(rng);
  const Machine machine{"test", truth.world_from_base, truth.platform_from_tool, {}, {}};
  return Simulate(dataset, machine, {});
}

Estimate Fit(const Dataset& dataset) { return Calibrate(MakeObservations(dataset), {}, {}); }

void ExpectSame(const Estimate& a, const Estimate& b) {
  ASSERT_TRUE(a.IsTrustworthy() && b.IsTrustworthy());
  EXPECT_LT(Difference(a.mounts, b.mounts).cwiseAbs().maxCoeff(), kSame);
  const Vector12d s = b.covariance.diagonal().cwiseSqrt().cwiseInverse();
  EXPECT_TRUE(MatrixNear(s.asDiagonal() * a.covariance * s.asDiagonal(),
                         s.asDiagonal() * b.covariance * s.asDiagonal(),
                         kSame));
  EXPECT_NEAR(a.chi_square / b.chi_square, 1.0, kSame);
}

const Eigen::Vector3d kEqual(1e-4, 1e-4, 1e-4), kUnequal(1e-4, 1e-4, 2e-4);

TEST(Invariance, OrderOfRobotPosesAndOfReadings) {
  auto rng = SeededByTest();
  const Dataset dataset = MarkerDataset(rng, kUnequal);
  Dataset shuffled = dataset;
  std::vector<int> new_from_old(dataset.robot_poses.rows.size());
  for (std::size_t i = 0; i < new_from_old.size(); ++i) new_from_old[i] = static_cast<int>(i);
  std::shuffle(new_from_old.begin(), new_from_old.end(), rng);
  for (std::size_t i = 0; i < new_from_old.size(); ++i)
    shuffled.robot_poses.rows[new_from_old[i]] = dataset.robot_poses.rows[i];
  for (MarkerReading& r : shuffled.measurement->readings) r.pose = new_from_old[r.pose];
  std::shuffle(shuffled.measurement->readings.begin(), shuffled.measurement->readings.end(), rng);
  ExpectSame(Fit(shuffled), Fit(dataset));
}

TEST(Invariance, AnyMotionOfTheTrackerForEqualSigmas) {
  auto rng = SeededByTest();
  const Dataset dataset = MarkerDataset(rng, kEqual);
  Dataset moved = dataset;  // another motion for every pose
  std::vector<Pose3d> motions;
  for (std::size_t i = 0; i < dataset.robot_poses.rows.size(); ++i)
    motions.push_back(testing::RandomPose(rng, 3.0));
  for (MarkerReading& r : moved.measurement->readings)
    r.p_in_tracker = motions[r.pose] * r.p_in_tracker;
  ExpectSame(Fit(moved), Fit(dataset));
}

TEST(Invariance, AnyTranslationOfTheTrackerForUnequalSigmas) {
  auto rng = SeededByTest();
  const Dataset dataset = MarkerDataset(rng, kUnequal);
  Dataset moved = dataset;
  std::vector<Eigen::Vector3d> shifts;
  for (std::size_t i = 0; i < dataset.robot_poses.rows.size(); ++i)
    shifts.push_back(testing::UniformVector(rng, 3.0));
  for (MarkerReading& r : moved.measurement->readings) r.p_in_tracker += shifts[r.pose];
  ExpectSame(Fit(moved), Fit(dataset));
}

// The control: with unequal sigmas a turned tracker sees with other weights, and the test above
// would notice a turn.
TEST(Invariance, ATurnOfTheTrackerMattersForUnequalSigmas) {
  auto rng = SeededByTest();
  const Dataset dataset = MarkerDataset(rng, kUnequal);
  Dataset moved = dataset;
  const Pose3d turn = testing::RandomPose(rng, 1.0);
  for (MarkerReading& r : moved.measurement->readings) r.p_in_tracker = turn * r.p_in_tracker;
  EXPECT_GT(Difference(Fit(moved).mounts, Fit(dataset).mounts).cwiseAbs().maxCoeff(), 1e-7);
}

// The same poses as text in either unit of length and of angle.
std::string DatasetText(const Dataset& dataset,
                        const std::vector<Pose3d>& measured,
                        const Units& units,
                        bool with_noise) {
  const auto row = [&](const std::string& label, const Pose3d& pose) {
    const Vector6d v = VectorFromPose(pose);
    return fmt::format("    - ['{}', {}, {}, {}, {}, {}, {}]\n",
                       label,
                       v[0] / units.length,
                       v[1] / units.length,
                       v[2] / units.length,
                       v[3] / units.angle,
                       v[4] / units.angle,
                       v[5] / units.angle);
  };
  std::string text =
      fmt::format("format: hexcal/dataset/1\nname: units\nunits: {{length: {}, angle: {}}}\n",
                  units.length == 1 ? "m" : "mm",
                  units.angle == 1 ? "rad" : "deg");
  const std::string header = "    - [pose, x, y, z, rx, ry, rz]\n";
  text += "robot_poses:\n  rows:\n" + header;
  for (const RobotPose& r : dataset.robot_poses.rows) text += row(r.label, r.base_from_platform);
  text += "measurement:\n  kind: poses\n";
  if (with_noise)
    text += fmt::format("  noise: {{position: [{}, {}, {}], orientation: {}}}\n",
                        1e-4 / units.length,
                        2e-4 / units.length,
                        3e-4 / units.length,
                        1e-3 / units.angle);
  text += "  rows:\n" + header;
  for (std::size_t i = 0; i < measured.size(); ++i)
    text += row(dataset.robot_poses.rows[i].label, measured[i]);
  return text;
}

TEST(Invariance, UnitsOfLengthAndAngle) {
  auto rng = SeededByTest();
  const BaseAndTool truth = testing::AnyMounts(rng);
  auto rows = testing::HexapodObservations(rng, truth, 20);
  testing::AddNoise(rng, testing::TrackerLikeCovariance(), &rows);
  std::vector<Pose3d> robot, measured;
  for (const Observation& o : rows)
    robot.push_back(o.base_from_platform), measured.push_back(o.world_from_tool);
  const Dataset dataset = testing::DatasetOfPoses(robot);
  testing::TemporaryFolder folder;
  for (const bool with_noise : {true, false}) {
    const auto run = [&](const Units& units) {
      return Fit(ReadDataset(
          folder.Write("d.yaml", DatasetText(dataset, measured, units, with_noise)), true));
    };
    const Estimate in_si = run({1.0, 1.0});
    ExpectSame(run({1e-3, 1.0}), in_si);
    ExpectSame(run({1.0, kPi / 180}), in_si);
    ExpectSame(run({1e-3, kPi / 180}), in_si);
  }
}

// Another tool frame, T' = T X: the tool mount takes X on its right, its covariance goes with
// InverseAdjoint(X), the base stays.
TEST(Invariance, AnotherToolFrameTransformsTheToolsCovariance) {
  auto rng = SeededByTest();
  auto rows = testing::HexapodObservations(rng, testing::AnyMounts(rng), 20);
  testing::AddNoise(rng, testing::TrackerLikeCovariance(), &rows);
  const Pose3d tool_from_other = testing::RandomPose(rng, 0.2);
  const Matrix6d carry = InverseAdjoint(tool_from_other);
  auto other = rows;
  for (Observation& o : other) o.world_from_tool = o.world_from_tool * tool_from_other;
  const Estimate before =
      Calibrate(testing::KnownNoise(rows, testing::TrackerLikeCovariance()), {}, {});
  const Estimate after = Calibrate(
      testing::KnownNoise(other, carry * testing::TrackerLikeCovariance() * carry.transpose()),
      {},
      {});
  // The error's rotation and translation parts are not coupled, so the two costs differ in second
  // order of the residuals.
  const Vector12d sigma = before.covariance.diagonal().cwiseSqrt();
  EXPECT_LT(Minus(after.mounts.world_from_base, before.mounts.world_from_base)
                .cwiseQuotient(sigma.head<6>())
                .norm(),
            1e-2);
  Matrix12d all = Matrix12d::Identity();
  all.bottomRightCorner<6, 6>() = carry;
  const Matrix12d expected = all * before.covariance * all.transpose();
  const Vector12d s = expected.diagonal().cwiseSqrt().cwiseInverse();
  EXPECT_TRUE(MatrixNear(s.asDiagonal() * after.covariance * s.asDiagonal(),
                         s.asDiagonal() * expected * s.asDiagonal(),
                         1e-2));
}

}  // namespace
}  // namespace hexcal
