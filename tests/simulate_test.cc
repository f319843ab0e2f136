// SPDX-License-Identifier: BSD-3-Clause
#include "model/simulate.h"

#include <algorithm>
#include <array>

#include "geometry/align_points.h"
#include "model/hexapod.h"
#include "model/predict.h"
#include "testing/datasets.h"
#include "testing/hexapods.h"
#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::MatrixNear;
using testing::PoseNear;
using testing::SeededByTest;

constexpr int kBaseMarkers = 3, kToolMarkers = 4;

Machine TestMachine() {
  Machine machine;
  machine.world_from_base = {Eigen::Vector3d(0.3, -0.2, 0.1), Exp(Eigen::Vector3d(0.4, 1.1, -2))};
  machine.platform_from_tool = {Eigen::Vector3d(0.02, 0.05, 0.1),
                                Exp(Eigen::Vector3d(-1.3, 0.2, 0.7))};
  return machine;
}

Pose3d TestTracker() {
  return {Eigen::Vector3d(0.5, 0.1, 2.0), Exp(Eigen::Vector3d(1.0, -0.7, 0.3))};
}

std::vector<Pose3d> WorkspacePoses(int count) {
  std::mt19937_64 rng = SeededByTest();
  std::vector<Pose3d> poses;
  for (int i = 0; i < count; ++i)
    poses.push_back(testing::RandomWorkspacePose(rng, testing::kLargeHeight, 0.3));
  return poses;
}

Measurement Markers() {
  Measurement measurement;
  measurement.kind = Measurement::Kind::kMarkers;
  MarkerBody& base = measurement.bodies[0];
  base.markers = {"b1", "b2", "b3"};
  base.p_in_body.resize(3, kBaseMarkers);
  base.p_in_body << 0.2, 0.0, -0.1, 0.0, 0.3, 0.1, 0.0, 0.0, 0.1;
  MarkerBody& tool = measurement.bodies[1];
  tool.markers = {"t1", "t2", "t3", "t4"};
  tool.p_in_body.resize(3, kToolMarkers);
  tool.p_in_body << 0.1, 0.0, -0.1, 0.0, 0.0, 0.1, 0.0, -0.1, 0.0, 0.02, 0.0, 0.05;
  return measurement;
}

Dataset MarkerDataset(int poses) {
  Dataset dataset = testing::DatasetOfPoses(WorkspacePoses(poses));
  dataset.measurement = Markers();
  dataset.tracker.tracker_from_world = TestTracker();
  return dataset;
}

Dataset PoseDataset(int poses) {
  Dataset dataset = testing::DatasetOfPoses(WorkspacePoses(poses));
  dataset.measurement.emplace();
  return dataset;
}

// Each reading where Eq. (1) puts it.
void ExpectReadingsAt(const Dataset& simulated,
                      const Pose3d& tracker_from_world,
                      const std::vector<Pose3d>& world_from_tool) {
  const Measurement& measurement = *simulated.measurement;
  for (const MarkerReading& reading : measurement.readings) {
    const int body = static_cast<int>(reading.body);
    const Eigen::Vector3d p_in_body = measurement.bodies[body].p_in_body.col(reading.marker);
    const Eigen::Vector3d p_in_world =
        reading.body == BodyId::kBase ? p_in_body : world_from_tool[reading.pose] * p_in_body;
    EXPECT_TRUE(MatrixNear(reading.p_in_tracker, tracker_from_world * p_in_world, 1e-14));
  }
}

std::vector<Pose3d> PredictedToolPoses(const Dataset& dataset) {
  return PredictToolPoses(TestMachine(), ReportedPoses(dataset));
}

// d d' averaged over the columns of d, in units of sigma: the identity, where d has these sigmas
// and no correlation. With 4000 columns an entry strays by 0.022.
void ExpectCovariance(const Eigen::MatrixXd& d, const Eigen::VectorXd& sigma) {
  ASSERT_GE(d.cols(), 4000);
  const Eigen::MatrixXd w = sigma.cwiseInverse().asDiagonal() * d;
  const Eigen::MatrixXd covariance = w * w.transpose() / d.cols();
  EXPECT_TRUE(MatrixNear(covariance, Eigen::MatrixXd::Identity(d.rows(), d.rows()), 0.09));
  const Eigen::VectorXd mean = w.rowwise().mean();
  EXPECT_TRUE(MatrixNear(mean, Eigen::VectorXd::Zero(d.rows()), 0.07));
}

TEST(Simulate, PutsEveryMarkerWhereEquation1Says) {
  const Dataset dataset = MarkerDataset(7);
  const Dataset simulated = Simulate(dataset, TestMachine(), {});
  ASSERT_EQ(simulated.measurement->readings.size(), 7u * (kBaseMarkers + kToolMarkers));
  EXPECT_TRUE(simulated.measurement->frame_labels.empty());
  ExpectReadingsAt(simulated, TestTracker(), PredictedToolPoses(dataset));
}

TEST(Simulate, PutsAMarkerWhereHandWorkDoes) {
  Dataset dataset = MarkerDataset(0);
  dataset.robot_poses =
      testing::DatasetOfPoses({{{0, 0.2, 0.5}, Eigen::Quaterniond::Identity()}}).robot_poses;
  dataset.tracker.tracker_from_world = {{0, 0, 2}, Exp(Eigen::Vector3d(M_PI, 0, 0))};
  Machine machine;
  machine.world_from_base = {{1, 0, 0}, Exp(Eigen::Vector3d(0, 0, M_PI / 2))};
  machine.platform_from_tool.translation << 0.1, 0, 0;
  const Dataset simulated = Simulate(dataset, machine, {});
  // Tool origin in W: (0.8, 0.1, 0.5); t1 = (0.1, 0, 0) of the tool lies along W's y.
  const MarkerReading& t1 = simulated.measurement->readings[kBaseMarkers];
  EXPECT_EQ(t1.body, BodyId::kTool);
  EXPECT_TRUE(MatrixNear(t1.p_in_tracker, Eigen::Vector3d(0.8, -0.2, 1.5), 1e-15));
}

TEST(Simulate, KeepsTheDatasetAndReplacesItsMeasurement) {
  Dataset dataset = MarkerDataset(4);
  dataset.measurement->readings.push_back({0, 0, BodyId::kBase, 0, {9, 9, 9}});
  dataset.measurement->marker_sigma = Eigen::Vector3d(1, 2, 3);
  dataset.description = "kept";
  const Dataset simulated = Simulate(dataset, TestMachine(), {1, 0.0});
  EXPECT_EQ(simulated.name, dataset.name);
  EXPECT_EQ(simulated.description, "kept");
  EXPECT_EQ(simulated.robot_poses.rows.size(), 4u);
  EXPECT_EQ(*simulated.measurement->marker_sigma, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(simulated.measurement->readings.size(), 4u * (kBaseMarkers + kToolMarkers));
}

TEST(Simulate, StandsTheTrackerWhereTheDatasetElseTheMachineElseNobodySays) {
  Dataset dataset = MarkerDataset(3);
  const std::vector<Pose3d> world_from_tool = PredictedToolPoses(dataset);
  Machine machine = TestMachine();
  const Pose3d other = {Eigen::Vector3d(1, 2, 3), Exp(Eigen::Vector3d(0.1, 0.2, 0.3))};
  machine.world_from_tracker = other.Inverse();
  ExpectReadingsAt(Simulate(dataset, machine, {}), TestTracker(), world_from_tool);
  dataset.tracker.tracker_from_world.reset();
  ExpectReadingsAt(Simulate(dataset, machine, {}), other, world_from_tool);
  machine.world_from_tracker.reset();
  ExpectReadingsAt(Simulate(dataset, machine, {}), Pose3d(), world_from_tool);
}

TEST(Simulate, ReadsEachPoseAsOftenAsFramesSays) {
  Dataset dataset = MarkerDataset(2);
  dataset.tracker.frames = 2;
  dataset.measurement->marker_sigma = Eigen::Vector3d::Constant(1e-4);
  const Measurement measurement = *Simulate(dataset, TestMachine(), {}).measurement;
  EXPECT_EQ(measurement.frame_labels, (std::vector<std::string>{"1", "2"}));
  ASSERT_EQ(measurement.readings.size(), 2u * 2u * (kBaseMarkers + kToolMarkers));
  const std::size_t frame = kBaseMarkers + kToolMarkers;
  EXPECT_EQ(measurement.readings[frame].frame, 1);
  EXPECT_NE(measurement.readings[frame].p_in_tracker, measurement.readings[0].p_in_tracker);
}

TEST(Simulate, MarkersAgreeWithToolPosesAlignedToThem) {
  const Dataset dataset = MarkerDataset(10);
  const Measurement measurement = *Simulate(dataset, TestMachine(), {}).measurement;
  const std::vector<Pose3d> predicted = PredictedToolPoses(dataset);
  std::array<Eigen::Matrix3Xd, 2> seen = {Eigen::Matrix3Xd(3, kBaseMarkers),
                                          Eigen::Matrix3Xd(3, kToolMarkers)};
  for (const MarkerReading& reading : measurement.readings) {
    seen[static_cast<int>(reading.body)].col(reading.marker) = reading.p_in_tracker;
    if (reading.body == BodyId::kBase || reading.marker + 1 < kToolMarkers) continue;
    const Pose3d tracker_from_world = AlignPoints(seen[0], measurement.bodies[0].p_in_body);
    const Pose3d tracker_from_tool = AlignPoints(seen[1], measurement.bodies[1].p_in_body);
    const Pose3d world_from_tool = tracker_from_world.Inverse() * tracker_from_tool;
    EXPECT_TRUE(PoseNear(world_from_tool, predicted[reading.pose], 1e-12, 1e-12));
  }
}

TEST(Simulate, MarkerNoiseHasItsSigmasAlongTheTrackersAxes) {
  Dataset dataset = MarkerDataset(4000);
  const Eigen::Vector3d sigma(1e-4, 2e-4, 5e-4);
  dataset.measurement->marker_sigma = sigma;
  const Dataset noisy = Simulate(dataset, TestMachine(), {});
  const Dataset exact = Simulate(dataset, TestMachine(), {1, 0.0});
  constexpr int kRows = 3 * (kBaseMarkers + kToolMarkers);
  Eigen::MatrixXd d(kRows, 4000);  // all coordinates of a pose: none may depend on another
  for (int i = 0; i < 4000 * kRows / 3; ++i)
    d.block<3, 1>(3 * i % kRows, 3 * i / kRows) =
        noisy.measurement->readings[i].p_in_tracker - exact.measurement->readings[i].p_in_tracker;
  ExpectCovariance(d, sigma.replicate(kRows / 3, 1));
}

TEST(Simulate, PoseNoiseHasItsSigmasAlongTheToolsAxes) {
  Dataset dataset = PoseDataset(4000);
  dataset.measurement->pose_noise = PoseNoise{{1e-4, 2e-4, 5e-4}, {3e-4, 1e-3, 2e-3}};
  const std::vector<MeasuredPose> noisy = Simulate(dataset, TestMachine(), {}).measurement->poses;
  const std::vector<Pose3d> exact = PredictedToolPoses(dataset);
  Eigen::MatrixXd d(6, 4000);
  for (int i = 0; i < 4000; ++i) {
    EXPECT_EQ(noisy[i].pose, i);
    d.col(i) = Minus(noisy[i].world_from_tool, exact[i]);
  }
  Vector6d sigma;
  sigma << 1e-4, 2e-4, 5e-4, 3e-4, 1e-3, 2e-3;
  ExpectCovariance(d, sigma);
}

// The platform behind a measured pose that has no noise of its own.
Pose3d PlatformBehind(const MeasuredPose& measured) {
  const Machine machine = TestMachine();
  return machine.world_from_base.Inverse() * measured.world_from_tool *
         machine.platform_from_tool.Inverse();
}

TEST(Simulate, RobotNoiseMovesThePlatformAlongItsOwnAxes) {
  Dataset dataset = PoseDataset(4000);
  dataset.robot_poses.noise = PoseNoise{{1e-4, 2e-4, 5e-4}, {3e-4, 1e-3, 2e-3}};
  const std::vector<MeasuredPose> measured =
      Simulate(dataset, TestMachine(), {}).measurement->poses;
  Eigen::MatrixXd d(6, 4000);
  for (int i = 0; i < 4000; ++i)
    d.col(i) = Minus(PlatformBehind(measured[i]), dataset.robot_poses.rows[i].base_from_platform);
  Vector6d sigma;
  sigma << 1e-4, 2e-4, 5e-4, 3e-4, 1e-3, 2e-3;
  ExpectCovariance(d, sigma);
}

TEST(Simulate, LegNoiseMovesEachLegByItself) {
  const HexapodGeometry hexapod = testing::LargeHexapod();
  Dataset dataset = testing::DatasetOfLegs(hexapod, WorkspacePoses(4000));
  dataset.measurement.emplace();
  dataset.robot_poses.leg_noise = 1e-5;
  const std::vector<MeasuredPose> measured =
      Simulate(dataset, TestMachine(), {}).measurement->poses;
  Eigen::MatrixXd d(6, 4000);
  for (int i = 0; i < 4000; ++i)
    d.col(i) = InverseKinematics(hexapod, PlatformBehind(measured[i])) -
               Eigen::Map<const LegLengths>(dataset.robot_poses.rows[i].leg_lengths.data());
  ExpectCovariance(d, Vector6d::Constant(1e-5));
}

TEST(Simulate, UsesTheMachinesHexapodWhereLegsBecomePoses) {
  Dataset dataset = testing::DatasetOfLegs(testing::LargeHexapod(), WorkspacePoses(5));
  dataset.measurement.emplace();
  Machine machine = TestMachine();
  machine.hexapod = testing::LargeHexapod();
  machine.hexapod->base_joints_in_base.row(0).array() += 0.25;
  const Dataset simulated = Simulate(dataset, machine, {});
  const std::vector<Pose3d> own = ReportedPoses(dataset);
  for (int i = 0; i < 5; ++i) {
    Pose3d moved = own[i];
    moved.translation.x() += 0.25;
    EXPECT_TRUE(PoseNear(PlatformBehind(simulated.measurement->poses[i]), moved, 1e-9, 1e-9));
  }
  EXPECT_EQ(simulated.hexapod->base_joints_in_base, dataset.hexapod->base_joints_in_base);
}

std::vector<Eigen::Vector3d> Readings(const Dataset& simulated) {
  std::vector<Eigen::Vector3d> readings;
  for (const MarkerReading& reading : simulated.measurement->readings)
    readings.push_back(reading.p_in_tracker);
  return readings;
}

TEST(Simulate, DrawsTheSameForTheSameSeedOnly) {
  Dataset dataset = MarkerDataset(5);
  dataset.measurement->marker_sigma = Eigen::Vector3d::Constant(1e-4);
  const auto simulate = [&](std::uint64_t seed) {
    return Readings(Simulate(dataset, TestMachine(), {seed, 1.0}));
  };
  EXPECT_EQ(simulate(7), simulate(7));
  EXPECT_NE(simulate(7)[0], simulate(8)[0]);
  EXPECT_NE(simulate(7)[0], simulate(7 + (std::uint64_t{1} << 32))[0]);
}

TEST(Simulate, GivesAPoseItsNoiseInAnySubsetAndOrder) {
  Dataset dataset = MarkerDataset(12);
  dataset.measurement->marker_sigma = Eigen::Vector3d::Constant(1e-4);
  dataset.robot_poses.noise = PoseNoise{{1e-4, 2e-4, 5e-4}, {3e-4, 1e-3, 2e-3}};
  const std::vector<Eigen::Vector3d> all = Readings(Simulate(dataset, TestMachine(), {}));
  Dataset subset = dataset;
  subset.robot_poses.rows = {dataset.robot_poses.rows[11], dataset.robot_poses.rows[3]};
  const std::vector<Eigen::Vector3d> some = Readings(Simulate(subset, TestMachine(), {}));
  const std::ptrdiff_t pose = kBaseMarkers + kToolMarkers;
  EXPECT_TRUE(std::equal(some.begin(), some.begin() + pose, all.begin() + 11 * pose));
  EXPECT_TRUE(std::equal(some.begin() + pose, some.end(), all.begin() + 3 * pose));
}

TEST(Simulate, ScalesTheNoiseByItsFactor) {
  Dataset dataset = MarkerDataset(5);
  dataset.measurement->marker_sigma = Eigen::Vector3d::Constant(1e-4);
  const auto simulate = [&](double noise) {
    return Readings(Simulate(dataset, TestMachine(), {1, noise}));
  };
  const auto none = simulate(0), one = simulate(1), three = simulate(3);
  for (std::size_t i = 0; i < none.size(); ++i)
    EXPECT_TRUE(MatrixNear(three[i] - none[i], 3 * (one[i] - none[i]), 1e-14));
}

TEST(Simulate, DrawsTheSameForTheMarkersWhetherOrNotTheRobotIsNoisy) {
  Dataset dataset = MarkerDataset(5);
  dataset.measurement->marker_sigma = Eigen::Vector3d::Constant(1e-4);
  const std::vector<Eigen::Vector3d> exact = Readings(Simulate(dataset, TestMachine(), {}));
  dataset.robot_poses.noise = PoseNoise();
  const std::vector<Eigen::Vector3d> noisy = Readings(Simulate(dataset, TestMachine(), {}));
  for (std::size_t i = 0; i < exact.size(); ++i) EXPECT_TRUE(MatrixNear(noisy[i], exact[i], 1e-14));
}

std::string MessageOf(const Dataset& dataset) {
  try {
    Simulate(dataset, TestMachine(), {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

TEST(Simulate, SaysThatItNeedsAMeasurementToImitate) {
  const std::string message = MessageOf(testing::DatasetOfPoses(WorkspacePoses(3)));
  EXPECT_EQ(message.find("dataset.yaml: found no measurement, expected measurement: "), 0u)
      << message;
}

TEST(Simulate, SaysThatMarkersNeedTheirCoordinates) {
  Dataset dataset = MarkerDataset(3);
  dataset.measurement->where = FileLocation("markers.csv");
  dataset.measurement->bodies[1].is_centroid = true;
  EXPECT_EQ(MessageOf(dataset),
            "markers.csv: found the tool body with frame: centroid, expected frame: rigid with "
            "the markers' coordinates, to know where they are");
}

TEST(Simulate, NamesThePoseThatLegNoisePushesOutOfTheWorkspace) {
  Dataset dataset = testing::DatasetOfLegs(testing::LargeHexapod(), WorkspacePoses(200));
  dataset.measurement.emplace();
  dataset.robot_poses.leg_noise = 0.5;
  const std::string message = MessageOf(dataset);
  EXPECT_EQ(message.find("poses.csv:"), 0u) << message;
  EXPECT_NE(message.find("moved by drawn noise"), std::string::npos) << message;
}

}  // namespace
}  // namespace hexcal
