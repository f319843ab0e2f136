// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "model/machine_rows.h"
#include "model/predict.h"
#include "model/simulate.h"
#include "testing/datasets.h"
#include "testing/hexapods.h"
#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::MatrixNear;
using testing::PoseNear;
using testing::SeededByTest;

constexpr int kPoses = 12;

Covariate Column(const std::string& name, double first, double step) {
  Covariate column{name, {}, {}};
  for (int i = 0; i < kPoses; ++i) column.values.push_back(first + step * i);
  return column;
}

Dataset TestDataset() {
  std::mt19937_64 rng = SeededByTest();
  std::vector<Pose3d> poses;
  for (int i = 0; i < kPoses; ++i)
    poses.push_back(testing::RandomWorkspacePose(rng, testing::kLargeHeight, 0.3));
  Dataset dataset = testing::DatasetOfPoses(poses);
  dataset.hexapod = testing::LargeHexapod();
  dataset.robot_poses.covariates = {Column("time", 5.0, 10.0)};
  Measurement& measurement = dataset.measurement.emplace();
  measurement.kind = Measurement::Kind::kMarkers;
  measurement.bodies[0].markers = {"b1", "b2", "b3"};
  measurement.bodies[0].p_in_body = 0.1 * Eigen::Matrix3d::Identity();
  measurement.bodies[1].markers = {"t1", "t2", "t3", "t4"};
  measurement.bodies[1].p_in_body = 0.05 * Eigen::MatrixXd::Identity(3, 4);
  dataset.tracker.tracker_from_world = {{0.5, 0.1, 2.0}, Exp(Eigen::Vector3d(1.0, -0.7, 0.3))};
  return dataset;
}

Machine TestMachine() {
  Machine machine;
  machine.world_from_base = {Eigen::Vector3d(0.3, -0.2, 0.1), Exp(Eigen::Vector3d(0.4, 1.1, -2))};
  machine.platform_from_tool = {Eigen::Vector3d(0.02, 0.05, 0.1),
                                Exp(Eigen::Vector3d(-1.3, 0.2, 0.7))};
  return machine;
}

Effect Of(const std::string& name, std::vector<double> parameters) {
  Effect effect;
  effect.name = name;
  effect.parameters = Eigen::Map<Eigen::VectorXd>(parameters.data(), parameters.size());
  return effect;
}

Effect Drift() {
  Effect drift = Of("base_drift", {1e-3, 0, 0, 0, 0, 2e-3, 0});
  drift.reference = {{"time_origin", {5}}, {"time_span", {110}}, {"time_is_row", {0}}};
  return drift;
}

Effect Marker(int marker, std::vector<double> offset) {
  Effect effect = Of("marker_offset", std::move(offset));
  effect.index = {marker};
  effect.reference = {{"markers", {3, 4}}};
  return effect;
}

PoseMap ConstantMap(const Vector6d& twist) {
  PoseMap map;
  map.coefficients = Eigen::MatrixXd::Zero(6, 7);
  map.coefficients.col(0) = twist;
  return map;
}

std::string MessageOf(const Machine& machine, const Dataset& dataset) {
  try {
    Predict(machine, dataset);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

void ExpectSameBits(const std::vector<Pose3d>& a, const std::vector<Pose3d>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].translation, b[i].translation);
    EXPECT_EQ(a[i].rotation.coeffs(), b[i].rotation.coeffs());
  }
}

TEST(Predict, WithoutEffectsOrWithZeroOnesIsEquation1ToTheLastBit) {
  const Dataset dataset = TestDataset();
  Machine machine = TestMachine();
  const std::vector<Pose3d> plain = PredictToolPoses(machine, ReportedPoses(dataset));
  ExpectSameBits(Predict(machine, dataset), plain);
  machine.effects = {Of("leg_offset", {0, 0, 0, 0, 0, 0})};
  machine.pose_map = ConstantMap(Vector6d::Zero());
  ExpectSameBits(Predict(machine, dataset), plain);
}

TEST(Predict, PutsEffectsOfRobotAndMountsInAndThoseOfTheTrackerNot) {
  const Dataset dataset = TestDataset();
  Machine machine = TestMachine();
  machine.effects = {Of("leg_offset", {1e-3, -2e-3, 0, 5e-4, 0, 1e-3}), Drift()};
  const std::vector<Pose3d> predicted = Predict(machine, dataset);
  machine.effects.push_back(Of("tracker_scale", {1e-3}));
  machine.effects.push_back(Marker(5, {1e-3, 0, 0}));
  ExpectSameBits(Predict(machine, dataset), predicted);
  for (int i = 0; i < kPoses; ++i) {
    const Pose3d& reported = dataset.robot_poses.rows[i].base_from_platform;
    LegLengths lengths = InverseKinematics(*dataset.hexapod, reported);
    lengths += machine.effects[0].parameters;
    const Pose3d real = ForwardKinematics(*dataset.hexapod, lengths, reported).base_from_platform;
    const Vector6d drift = machine.effects[1].parameters.head<6>() * (i / 11.0);
    EXPECT_TRUE(PoseNear(predicted[i],
                         Plus(machine.world_from_base, drift) * real * machine.platform_from_tool,
                         1e-12,
                         1e-12));
  }
}

TEST(Predict, OfSomeRowsIsThatOfAll) {
  Dataset dataset = TestDataset();
  Machine machine = TestMachine();
  machine.effects = {Drift()};
  const std::vector<Pose3d> all = Predict(machine, dataset);
  dataset.robot_poses.rows.erase(dataset.robot_poses.rows.begin(),
                                 dataset.robot_poses.rows.begin() + 7);
  std::vector<double>& times = dataset.robot_poses.covariates[0].values;
  times.erase(times.begin(), times.begin() + 7);
  ExpectSameBits(Predict(machine, dataset), {all.begin() + 7, all.end()});
}

TEST(Predict, AddsThePoseMapRightOfThePlatform) {
  const Dataset dataset = TestDataset();
  Machine machine = TestMachine();
  Vector6d twist;
  twist << 1e-3, 2e-3, -1e-3, 1e-3, 0, 2e-3;
  machine.pose_map = ConstantMap(twist);
  const std::vector<Pose3d> predicted = Predict(machine, dataset);
  for (int i = 0; i < kPoses; ++i)
    EXPECT_TRUE(PoseNear(predicted[i],
                         machine.world_from_base *
                             Plus(dataset.robot_poses.rows[i].base_from_platform, twist) *
                             machine.platform_from_tool,
                         1e-14,
                         1e-14));
}

TEST(Predict, MendsFaultsOfTheDataFirst) {
  const Dataset right = TestDataset();
  Dataset wrong = right;
  for (RobotPose& row : wrong.robot_poses.rows) row.base_from_platform.translation *= 1e-3;
  Machine machine = TestMachine();
  machine.effects = {Of("leg_offset", {1e-3, 0, 0, 0, 0, 0})};
  const std::vector<Pose3d> expected = Predict(machine, right);
  Effect fault = Of("wrong_unit", {});
  fault.reference["factor"] = {1e3};
  fault.found["of"] = "lengths";
  machine.effects.push_back(fault);
  const std::vector<Pose3d> predicted = Predict(machine, wrong);
  for (int i = 0; i < kPoses; ++i) EXPECT_TRUE(PoseNear(predicted[i], expected[i], 1e-12, 1e-12));
}

TEST(Predict, NamesWhatAnEffectNeedsAndTheDatasetLacks) {
  Dataset dataset = TestDataset();
  Machine machine = TestMachine();
  machine.effects = {Of("leg_thermal", {1e-5})};
  machine.effects[0].reference["reference_temperature"] = {20};
  EXPECT_EQ(MessageOf(machine, dataset),
            "dataset.yaml: found a dataset without a temperature column, expected what the "
            "model's effect 'leg_thermal' needs");
  machine.effects = {Drift()};
  dataset.robot_poses.covariates.clear();
  EXPECT_EQ(MessageOf(machine, dataset),
            "dataset.yaml: found a dataset without a time column, expected what the model's "
            "effect 'base_drift' needs");
}

TEST(Predict, NamesTheRowWhoseLegsReachNoPose) {
  Machine machine = TestMachine();
  machine.effects = {Of("leg_offset", {3, 0, 0, 0, 0, 0})};
  EXPECT_EQ(MessageOf(machine, TestDataset()).find("poses.csv:2: found pose 'p1', whose legs"), 0u);
}

TEST(Simulate, PutsAllEffectsIntoTheReadings) {
  const Dataset dataset = TestDataset();
  Machine machine = TestMachine();
  machine.effects = {Of("leg_offset", {1e-3, -2e-3, 0, 5e-4, 0, 1e-3}),
                     Of("tracker_scale", {2e-3}),
                     Of("tracker_distortion", {1e-2}),
                     Marker(2, {1e-3, 2e-3, 3e-3}),
                     Marker(7, {-1e-3, 0, 0})};
  const std::vector<Pose3d> world_from_tool = Predict(machine, dataset);
  const Measurement measurement = *Simulate(dataset, machine, {}).measurement;
  ASSERT_EQ(measurement.readings.size(), 7u * kPoses);
  for (const MarkerReading& reading : measurement.readings) {
    const int body = static_cast<int>(reading.body);
    Eigen::Vector3d p = measurement.bodies[body].p_in_body.col(reading.marker);
    if (body == 0 && reading.marker == 1) p += Eigen::Vector3d(1e-3, 2e-3, 3e-3);
    if (body == 1 && reading.marker == 3) p.x() -= 1e-3;
    if (body == 1) p = world_from_tool[reading.pose] * p;
    p = *dataset.tracker.tracker_from_world * p;
    const double off_axis = 1e-2 * (p.x() * p.x() + p.y() * p.y());
    const Eigen::Vector3d expected = 1.002 * p + off_axis * Eigen::Vector3d(p.x(), p.y(), 0.0);
    EXPECT_TRUE(MatrixNear(reading.p_in_tracker, expected, 1e-14));
  }
}

TEST(Simulate, GivesSwappedMarkersEachOthersName) {
  const Dataset dataset = TestDataset();
  Machine machine = TestMachine();
  const Measurement right = *Simulate(dataset, machine, {}).measurement;
  Effect swapped = Of("swapped_markers", {});
  swapped.index = {4, 6};
  machine.effects = {swapped};
  const Measurement wrong = *Simulate(dataset, machine, {}).measurement;
  const std::vector<int> other = {2, 1, 0, 3};
  for (const MarkerReading& reading : wrong.readings) {
    const auto same = [&](const MarkerReading& r) {
      const int marker = r.body == BodyId::kTool ? other[r.marker] : r.marker;
      return r.pose == reading.pose && r.body == reading.body && marker == reading.marker;
    };
    const auto found = std::find_if(right.readings.begin(), right.readings.end(), same);
    EXPECT_EQ(reading.p_in_tracker, found->p_in_tracker);
  }
}

TEST(Simulate, ScalesMeasuredPosesAsTheTrackerDoes) {
  Dataset dataset = TestDataset();
  dataset.measurement.emplace();
  Machine machine = TestMachine();
  machine.effects = {Of("tracker_scale", {1e-2})};
  const std::vector<Pose3d> real = Predict(machine, dataset);
  const std::vector<MeasuredPose> read = Simulate(dataset, machine, {}).measurement->poses;
  for (int i = 0; i < kPoses; ++i)
    EXPECT_TRUE(PoseNear(
        read[i].world_from_tool, {1.01 * real[i].translation, real[i].rotation}, 1e-14, 1e-14));
}

}  // namespace
}  // namespace hexcal
