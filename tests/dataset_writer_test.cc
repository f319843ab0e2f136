// SPDX-License-Identifier: BSD-3-Clause
// Not covered: that the files arrive on the disk (config/atomic_file).
#include "measurement/dataset_writer.h"

#include <gtest/gtest.h>

#include "testing/bits.h"
#include "testing/hexapods.h"
#include "testing/random.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using testing::SameBits;
using testing::SeededByTest;
using testing::TemporaryFolder;
using testing::Uniform;
using testing::UniformVector;

constexpr int kNumPoses = 40;

Dataset WriteAndRead(const Dataset& dataset) {
  const TemporaryFolder folder;
  for (const auto& [name, content] : WriteDataset(dataset)) folder.Write(name, content);
  return ReadDataset(folder.Path("dataset.yaml"), dataset.measurement.has_value());
}

PoseNoise RandomNoise(std::mt19937_64& rng) {
  return {UniformVector(rng, 1e-3).cwiseAbs(), UniformVector(rng, 1e-3).cwiseAbs()};
}

// Everything that a dataset may hold beside its robot poses and its measurement.
Dataset RandomSettings(std::mt19937_64& rng) {
  Dataset dataset;
  dataset.name = "1e5";  // text, though it looks like a number
  dataset.description =
      "Quotes \" and ', a backslash \\, a # and a: colon\n\n\ta tab, \r\n a bell \a, "
      "\xC3\xA9\xE2\x82\xAC\xF0\x9F\x94\xA7 and \xE2\x80\xA8 \xC2\x85 \xEF\xBB\xBF; {[&*!|>%@` ";
  dataset.gravity_in_base = testing::Normal(rng, 3).normalized();
  dataset.hexapod = testing::LargeHexapod();
  dataset.hexapod->home = testing::RandomPose(rng, 0.5);
  dataset.reference_temperature = Uniform(rng, 15, 25);
  dataset.tracker = {true, testing::RandomPose(rng, 3.0), 7};
  dataset.initial = InitialGuess{testing::RandomPose(rng, 1.0), testing::RandomPose(rng, 1.0)};
  return dataset;
}

void AddRobotPoses(std::mt19937_64& rng, bool are_leg_lengths, Dataset& dataset) {
  RobotPoses& robot_poses = dataset.robot_poses;
  robot_poses.are_leg_lengths = are_leg_lengths;
  robot_poses.covariates = {{"time", *FindCovariateUnit("s"), {}},
                            {"temperature", *FindCovariateUnit("degC"), {}},
                            {"direction_2", *FindCovariateUnit("1"), {}},
                            {"true", *FindCovariateUnit("K"), {}}};
  for (int i = 0; i < kNumPoses; ++i) {
    RobotPose pose;
    pose.label = std::string(i / 10, '0') + std::to_string(i % 10) + "\xC3\xA9 a#b'c";
    pose.leg_lengths = {};
    if (are_leg_lengths)
      for (double& length : pose.leg_lengths) length = Uniform(rng, 0.4, 0.7);
    else
      pose.base_from_platform = testing::RandomPose(rng, 0.3);
    robot_poses.rows.push_back(pose);
    robot_poses.covariates[0].values.push_back(Uniform(rng, 0, 1e6));
    robot_poses.covariates[1].values.push_back(i == 3 ? -0.0 : Uniform(rng, -20, 40));
    robot_poses.covariates[2].values.push_back(i % 3 - 1);
    robot_poses.covariates[3].values.push_back(Uniform(rng, -1e-300, 1e-300));
  }
  if (are_leg_lengths)
    robot_poses.leg_noise = Uniform(rng, 1e-6, 1e-5);
  else
    robot_poses.noise = RandomNoise(rng);
}

void AddMeasuredPoses(std::mt19937_64& rng, Dataset& dataset) {
  Measurement& measurement = dataset.measurement.emplace();
  measurement.kind = Measurement::Kind::kPoses;
  measurement.pose_noise = RandomNoise(rng);
  for (int pose = kNumPoses - 1; pose >= 0; pose -= 2)
    measurement.poses.push_back({pose, testing::RandomPose(rng, 0.3)});
}

void AddMarkers(std::mt19937_64& rng, bool with_frames, Dataset& dataset) {
  Measurement& measurement = dataset.measurement.emplace();
  measurement.kind = Measurement::Kind::kMarkers;
  measurement.marker_sigma = UniformVector(rng, 1e-4).cwiseAbs();
  MarkerBody& base = measurement.bodies[0];
  base.markers = {"1", "null", "it's: [a] {b}", "\xCE\xB2 4"};
  base.p_in_body = Eigen::Matrix3Xd::Random(3, 4);
  MarkerBody& tool = measurement.bodies[1];
  tool.is_centroid = true;
  tool.markers = {"t1", "1", "~"};
  tool.p_in_body.resize(3, 0);
  tool.x_axis = {2, 0};
  if (with_frames) measurement.frame_labels = {"b", "a", "01"};
  for (int pose = 0; pose < kNumPoses; pose += 3)
    for (int frame = 0; frame < (with_frames ? 3 : 1); ++frame)
      for (int body = 1; body >= 0; --body)
        for (int marker = 0; marker < (body == 0 ? 4 : 3); ++marker)
          if ((pose + marker) % 5 != 1)  // the others were not seen
            measurement.readings.push_back(
                {pose, frame, static_cast<BodyId>(body), marker, UniformVector(rng, 2.0)});
}

void ExpectSameNoise(const std::optional<PoseNoise>& a, const std::optional<PoseNoise>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) return;
  EXPECT_TRUE(SameBits(a->position, b->position));
  EXPECT_TRUE(SameBits(a->orientation, b->orientation));
}

void ExpectSameRobotPoses(const RobotPoses& a, const RobotPoses& b) {
  EXPECT_EQ(a.are_leg_lengths, b.are_leg_lengths);
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i) {
    EXPECT_EQ(a.rows[i].label, b.rows[i].label);
    EXPECT_TRUE(SameBits(a.rows[i].base_from_platform, b.rows[i].base_from_platform));
    for (int leg = 0; leg < kNumLegs; ++leg)
      EXPECT_TRUE(SameBits(a.rows[i].leg_lengths[leg], b.rows[i].leg_lengths[leg]));
  }
  ASSERT_EQ(a.covariates.size(), b.covariates.size());
  for (std::size_t i = 0; i < a.covariates.size(); ++i) {
    EXPECT_EQ(a.covariates[i].name, b.covariates[i].name);
    EXPECT_EQ(a.covariates[i].unit.symbol, b.covariates[i].unit.si_symbol);
    ASSERT_EQ(a.covariates[i].values.size(), b.covariates[i].values.size());
    for (std::size_t row = 0; row < a.covariates[i].values.size(); ++row)
      EXPECT_TRUE(SameBits(a.covariates[i].values[row], b.covariates[i].values[row]));
  }
  ExpectSameNoise(a.noise, b.noise);
  ASSERT_EQ(a.leg_noise.has_value(), b.leg_noise.has_value());
  if (a.leg_noise) {
    EXPECT_TRUE(SameBits(*a.leg_noise, *b.leg_noise));
  }
}

void ExpectSameBody(const MarkerBody& a, const MarkerBody& b) {
  EXPECT_EQ(a.is_centroid, b.is_centroid);
  EXPECT_EQ(a.markers, b.markers);
  EXPECT_TRUE(SameBits(a.p_in_body, b.p_in_body));
  EXPECT_EQ(a.x_axis, b.x_axis);
}

void ExpectSameMeasurement(const Measurement& a, const Measurement& b) {
  EXPECT_EQ(a.kind, b.kind);
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    EXPECT_EQ(a.poses[i].pose, b.poses[i].pose);
    EXPECT_TRUE(SameBits(a.poses[i].world_from_tool, b.poses[i].world_from_tool));
  }
  ExpectSameNoise(a.pose_noise, b.pose_noise);
  for (int body = 0; body < 2; ++body) ExpectSameBody(a.bodies[body], b.bodies[body]);
  EXPECT_EQ(a.frame_labels, b.frame_labels);
  ASSERT_EQ(a.readings.size(), b.readings.size());
  for (std::size_t i = 0; i < a.readings.size(); ++i) {
    const MarkerReading &x = a.readings[i], &y = b.readings[i];
    EXPECT_TRUE(x.pose == y.pose && x.frame == y.frame && x.body == y.body && x.marker == y.marker)
        << "reading " << i;
    EXPECT_TRUE(SameBits(x.p_in_tracker, y.p_in_tracker));
  }
  ASSERT_EQ(a.marker_sigma.has_value(), b.marker_sigma.has_value());
  if (a.marker_sigma) {
    EXPECT_TRUE(SameBits(*a.marker_sigma, *b.marker_sigma));
  }
}

void ExpectSameSettings(const Dataset& a, const Dataset& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.description, b.description);
  ASSERT_EQ(a.gravity_in_base.has_value(), b.gravity_in_base.has_value());
  if (a.gravity_in_base) {
    EXPECT_TRUE(SameBits(*a.gravity_in_base, *b.gravity_in_base));
  }
  ASSERT_EQ(a.hexapod.has_value(), b.hexapod.has_value());
  if (a.hexapod) {
    EXPECT_EQ(WriteHexapodGeometry(*a.hexapod, ""), WriteHexapodGeometry(*b.hexapod, ""));
  }
  EXPECT_EQ(a.reference_temperature, b.reference_temperature);
  EXPECT_EQ(a.tracker.is_static, b.tracker.is_static);
  EXPECT_EQ(a.tracker.frames, b.tracker.frames);
  ASSERT_EQ(a.tracker.tracker_from_world.has_value(), b.tracker.tracker_from_world.has_value());
  if (a.tracker.tracker_from_world) {
    EXPECT_TRUE(SameBits(*a.tracker.tracker_from_world, *b.tracker.tracker_from_world));
  }
  ASSERT_EQ(a.initial.has_value(), b.initial.has_value());
  if (!a.initial) return;
  EXPECT_TRUE(SameBits(a.initial->world_from_base, b.initial->world_from_base));
  EXPECT_TRUE(SameBits(a.initial->platform_from_tool, b.initial->platform_from_tool));
}

void ExpectReadsBack(const Dataset& dataset) {
  const Dataset read = WriteAndRead(dataset);
  ExpectSameSettings(read, dataset);
  ExpectSameRobotPoses(read.robot_poses, dataset.robot_poses);
  ASSERT_EQ(read.measurement.has_value(), dataset.measurement.has_value());
  if (dataset.measurement) ExpectSameMeasurement(*read.measurement, *dataset.measurement);
}

TEST(DatasetWriter, PosesReadBackToTheLastBit) {
  std::mt19937_64 rng = SeededByTest();
  Dataset dataset = RandomSettings(rng);
  AddRobotPoses(rng, /*are_leg_lengths=*/false, dataset);
  AddMeasuredPoses(rng, dataset);
  ExpectReadsBack(dataset);
}

TEST(DatasetWriter, LegsAndMarkersReadBackToTheLastBit) {
  std::mt19937_64 rng = SeededByTest();
  Dataset dataset = RandomSettings(rng);
  AddRobotPoses(rng, /*are_leg_lengths=*/true, dataset);
  AddMarkers(rng, /*with_frames=*/true, dataset);
  ExpectReadsBack(dataset);
}

TEST(DatasetWriter, MarkersWithoutFramesReadBackToTheLastBit) {
  std::mt19937_64 rng = SeededByTest();
  Dataset dataset;
  dataset.name = "a";
  AddRobotPoses(rng, /*are_leg_lengths=*/false, dataset);
  AddMarkers(rng, /*with_frames=*/false, dataset);
  dataset.measurement->marker_sigma.reset();
  dataset.robot_poses.noise.reset();
  ExpectReadsBack(dataset);
}

TEST(DatasetWriter, ADatasetWithoutMeasurementReadsBack) {
  std::mt19937_64 rng = SeededByTest();
  Dataset dataset;
  dataset.name = "a";
  AddRobotPoses(rng, /*are_leg_lengths=*/true, dataset);
  dataset.hexapod = testing::SmallHexapod();
  dataset.robot_poses.covariates.clear();
  ExpectReadsBack(dataset);
  EXPECT_EQ(WriteDataset(dataset).size(), 2u);
}

TEST(DatasetWriter, WhatWasReadInOtherUnitsReadsBackToTheLastBit) {
  const TemporaryFolder folder;
  folder.Write("d.yaml",
               "format: hexcal/dataset/1\nname: d\nunits: {length: mm, angle: deg}\n"
               "covariates: {time: min, tilt: deg}\ngravity: [1, 2, -9]\n"
               "robot_poses:\n  rows:\n"
               "    - [pose, x, y, z, rx, ry, rz, time, tilt]\n"
               "    - [a, 1.1, 2.2, 3.3, 10.1, 20.2, 30.3, 0.1, 1]\n"
               "    - [b, 1.7, 2.9, 3.1, -10.1, 170.2, 30.3, 0.2, 2]\n"
               "    - [c, 1.3, 2.3, 3.7, 10.1, 90, 0.3, 0.7, 3]\n"
               "measurement:\n  kind: poses\n  noise: {position: 0.1, orientation: 0.01}\n"
               "  rows:\n"
               "    - [pose, x, y, z, r11, r12, r13, r21, r22, r23, r31, r32, r33]\n"
               "    - [c, 1, 2, 3, 1, 0, 0, 0, 1, 0, 0, 0, 1]\n"
               "    - [b, 1.5, 2, 3, 0.6, 0.8, 0, -0.8, 0.6, 0, 0, 0, 1]\n"
               "    - [a, 1.7, 2, 3, 1, 0, 0, 0, 0.96, 0.28, 0, -0.28, 0.96]\n");
  const Dataset dataset = ReadDataset(folder.Path("d.yaml"), true);
  ExpectReadsBack(dataset);
}

TEST(DatasetWriter, IsStableOnceWritten) {
  std::mt19937_64 rng = SeededByTest();
  Dataset dataset = RandomSettings(rng);
  AddRobotPoses(rng, /*are_leg_lengths=*/false, dataset);
  AddMarkers(rng, /*with_frames=*/true, dataset);
  EXPECT_EQ(WriteDataset(WriteAndRead(dataset)), WriteDataset(dataset));
}

}  // namespace
}  // namespace hexcal
