// SPDX-License-Identifier: BSD-3-Clause
// What a good dataset becomes. Not covered: what is refused and with which message
// (bad_datasets_test), the hexapod's mapping (hexapod_geometry_test), what looks odd
// (dataset_warnings_test).
#include "measurement/dataset.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "testing/bits.h"
#include "testing/decimal_comma.h"
#include "testing/input_error_text.h"
#include "testing/matchers.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using testing::InputErrorText;
using testing::MatrixNear;
using testing::PoseNear;
using testing::SameBits;
using testing::TemporaryFolder;

constexpr double kDegree = kPi / 180;
const std::string kMetres = "format: hexcal/dataset/1\nname: d\nunits: {length: m, angle: rad}\n";
const std::string kMillimetres =
    "format: hexcal/dataset/1\nname: d\nunits: {length: mm, angle: deg}\n";
const std::string kThreePoses =
    "robot_poses:\n  rows: [[pose, x, y, z, rx, ry, rz], [1, 0, 0, 1, 0, 0, 0], "
    "[01, 0, 1, 0, 0, 0, 0], [1.0, 1, 0, 0, 0, 0, 0]]\n";
const std::string kMarkers =
    "measurement:\n"
    "  kind: markers\n"
    "  file: markers.csv\n"
    "  bodies:\n"
    "    base: {frame: rigid, markers: {b1: [1, 0, 0], b2: [0, 2, 0], 3: [0, 0, 3]}}\n"
    "    tool: {frame: centroid, markers: [t1, t2, 3], x_axis: [3, t1]}\n";

Dataset ReadText(const std::string& yaml, const std::string& markers = "") {
  const TemporaryFolder folder;
  if (!markers.empty()) folder.Write("markers.csv", markers);
  return ReadDataset(folder.Write("dataset.yaml", yaml),
                     yaml.find("measurement") != std::string::npos);
}

// One reading of each body in each of the three poses.
std::string SeenInAllPoses() {
  std::string rows;
  for (const char* pose : {"1", "01", "1.0"})
    rows += std::string(pose) + ",base,b1,1,2,3\n" + pose + ",tool,t1,4,5,6\n";
  return rows;
}

Pose3d ReadOnePose(const std::string& columns,
                   const std::string& numbers,
                   const std::string& head = kMillimetres) {
  const Dataset dataset =
      ReadText(head + "robot_poses: {rows: [[" + columns + "], [" + numbers + "]]}\n");
  return dataset.robot_poses.rows.at(0).base_from_platform;
}

// Rx(90 deg) Rz(90 deg) by hand: columns (0, 0, 1), (-1, 0, 0), (0, -1, 0); quaternion
// (1 + i)(1 + k)/2 = (1 + i - j + k)/2.
const Pose3d kTurned = {{0.001, 0.002, 0.003}, Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5)};

TEST(Dataset, EveryColumnSetGivesTheSamePose) {
  EXPECT_TRUE(PoseNear(
      ReadOnePose("pose, x, y, z, rx, ry, rz", "p, 1, 2, 3, 90, 0, 90"), kTurned, 1e-15, 1e-15));
  EXPECT_TRUE(PoseNear(ReadOnePose("pose, x, y, z, qw, qx, qy, qz", "p, 1, 2, 3, .5, .5, -.5, .5"),
                       kTurned,
                       1e-15,
                       1e-15));
  EXPECT_TRUE(PoseNear(ReadOnePose("pose, x, y, z, r11, r12, r13, r21, r22, r23, r31, r32, r33",
                                   "p, 1, 2, 3, 0, -1, 0, 0, 0, -1, 1, 0, 0"),
                       kTurned,
                       1e-15,
                       1e-15));
}

TEST(Dataset, ColumnsComeInAnyOrder) {
  EXPECT_TRUE(PoseNear(
      ReadOnePose("rz, z, ry, pose, x, rx, y", "90, 3, 0, p, 1, 90, 2"), kTurned, 1e-15, 1e-15));
  EXPECT_TRUE(PoseNear(ReadOnePose("r33, r11, r12, z, r13, r31, r22, r23, y, r21, r32, pose, x",
                                   "0, 0, -1, 3, 0, 1, 0, -1, 2, 0, 0, p, 1"),
                       kTurned,
                       1e-15,
                       1e-15));
}

TEST(Dataset, TheMeasuredPosesTakeTheSameColumns) {
  const Dataset dataset = ReadText(
      kMillimetres + kThreePoses +
      "measurement:\n  kind: poses\n"
      "  noise: {position: [1, 2, 3], orientation: 0.1}\n"
      "  rows: [[pose, x, y, z, rx, ry, rz], [01, 1, 2, 3, 90, 0, 90], [1, 0, 0, 0, 0, 0, 0], "
      "[1.0, 0, 0, 0, 0, 0, 0]]\n");
  const Measurement& measurement = *dataset.measurement;
  EXPECT_EQ(measurement.kind, Measurement::Kind::kPoses);
  ASSERT_EQ(measurement.poses.size(), 3u);
  EXPECT_EQ(measurement.poses[0].pose, 1);  // "01" is not "1"
  EXPECT_EQ(measurement.poses[1].pose, 0);
  EXPECT_EQ(measurement.poses[2].pose, 2);
  EXPECT_TRUE(PoseNear(measurement.poses[0].world_from_tool, kTurned, 1e-15, 1e-15));
  EXPECT_TRUE(
      MatrixNear(measurement.pose_noise->position, Eigen::Vector3d(1e-3, 2e-3, 3e-3), 1e-18));
  EXPECT_TRUE(MatrixNear(
      measurement.pose_noise->orientation, Eigen::Vector3d::Constant(0.1 * kDegree), 1e-18));
}

TEST(Dataset, NearlyARotationIsMadeOneAndLessIsRefused) {
  const std::string columns = "pose, x, y, z, r11, r12, r13, r21, r22, r23, r31, r32, r33";
  const Pose3d pose = ReadOnePose(columns, "p, 0, 0, 0, 1, 0.0009, 0, 0, 1, 0, 0, 0, 1");
  const Eigen::Matrix3d r = pose.rotation.toRotationMatrix();
  EXPECT_TRUE(MatrixNear(r.transpose() * r, Eigen::Matrix3d::Identity(), 1e-15));
  EXPECT_NEAR(r(0, 1), 0.00045, 1e-8);  // the shear is shared between the axes
  EXPECT_NEAR(r(1, 0), -0.00045, 1e-8);
  EXPECT_NE(
      InputErrorText([&] { ReadOnePose(columns, "p, 0, 0, 0, 1, 0.0011, 0, 0, 1, 0, 0, 0, 1"); }),
      "(no exception)");
  const std::string quaternion = "pose, x, y, z, qw, qx, qy, qz";
  EXPECT_NEAR(ReadOnePose(quaternion, "p, 0, 0, 0, 0, 0, 1.0009, 0").rotation.norm(), 1, 1e-15);
  EXPECT_NE(InputErrorText([&] { ReadOnePose(quaternion, "p, 0, 0, 0, 0, 0, 1.0011, 0"); }),
            "(no exception)");
}

TEST(Dataset, AQuaternionThatIsUnitToRoundingIsKeptToTheLastBit) {
  const Eigen::Quaterniond kept =
      ReadOnePose("pose, x, y, z, qw, qx, qy, qz", "p, 0, 0, 0, 0.6, 0, 0.8000000000000006, 0")
          .rotation;
  EXPECT_TRUE(SameBits(kept.w(), 0.6));
  EXPECT_TRUE(SameBits(kept.y(), 0.8000000000000006));
  const Eigen::Quaterniond made_unit =
      ReadOnePose("pose, x, y, z, qw, qx, qy, qz", "p, 0, 0, 0, 0.6, 0, 0.80000000000001, 0")
          .rotation;
  EXPECT_FALSE(SameBits(made_unit.w(), 0.6));
  EXPECT_NEAR(made_unit.squaredNorm(), 1, 4e-16);
}

TEST(Dataset, KeepsLegLengthsAsRecorded) {
  const Dataset dataset = ReadText(
      kMillimetres +
      "hexapod:\n"
      "  base_joints: [[1, 0, 0], [1, 0, 0], [0, 1, 0], [0, 1, 0], [-1, -1, 0], [-1, -1, 0]]\n"
      "  platform_joints: [[1, 1, 0], [-1, 1, 0], [-1, 1, 0], [-1, -1, 0], [-1, -1, 0], [1, 1, "
      "0]]\n"
      "  leg_limits: [100, 106]\n"
      "robot_poses:\n  noise: {leg: 0.5}\n"
      "  rows: [[l6, l1, l2, l3, l4, l5, pose], [106, 101, 102, 103, 104, 105, p]]\n");
  const RobotPoses& robot_poses = dataset.robot_poses;
  EXPECT_TRUE(robot_poses.are_leg_lengths);
  for (int leg = 0; leg < kNumLegs; ++leg)
    EXPECT_NEAR(robot_poses.rows[0].leg_lengths[leg], 0.101 + 0.001 * leg, 1e-16);
  EXPECT_TRUE(SameBits(robot_poses.rows[0].base_from_platform, Pose3d()));
  EXPECT_NEAR(*robot_poses.leg_noise, 0.5e-3, 1e-18);
  EXPECT_FALSE(robot_poses.noise);
}

TEST(Dataset, CovariatesHaveUnitsOfTheirOwn) {
  const Dataset dataset =
      ReadText(kMillimetres +
               "covariates: {time: min, temperature: degC, payload_x: mm, humidity: 1, wx: deg/s, "
               "direction_6: 1, absolute: K}\n"
               "robot_poses: {rows: [[pose, x, humidity, y, z, rx, ry, rz, direction_6, time, "
               "temperature, payload_x, wx, absolute], [p, 0, 0.4, 0, 0, 0, 0, 0, -1, 2, 21.5, 30, "
               "90, 300]]}\n");
  const std::vector<Covariate>& covariates = dataset.robot_poses.covariates;
  ASSERT_EQ(covariates.size(), 7u);
  const std::vector<std::pair<std::string, double>> expected = {{"time", 120},
                                                                {"temperature", 21.5},
                                                                {"payload_x", 0.03},
                                                                {"humidity", 0.4},
                                                                {"wx", kPi / 2},
                                                                {"direction_6", -1},
                                                                {"absolute", 300}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(covariates[i].name, expected[i].first);
    ASSERT_EQ(covariates[i].values.size(), 1u);
    EXPECT_NEAR(covariates[i].values[0], expected[i].second, 1e-15);
  }
  EXPECT_EQ(covariates[0].unit.symbol, "min");
  EXPECT_EQ(covariates[0].unit.si_symbol, "s");
}

TEST(Dataset, LabelsAreText) {
  const Dataset dataset =
      ReadText(kMetres + kThreePoses + kMarkers,
               "pose,body,marker,x,y,z\n" + SeenInAllPoses() + "1,base,3,7,8,9\n");
  const Measurement& measurement = *dataset.measurement;
  ASSERT_EQ(measurement.readings.size(), 7u);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(measurement.readings[i].pose, i / 2);
    EXPECT_EQ(measurement.readings[i].body, i % 2 == 0 ? BodyId::kBase : BodyId::kTool);
    EXPECT_EQ(measurement.readings[i].marker, 0);
  }
  EXPECT_EQ(measurement.readings[6].marker, 2);
  EXPECT_TRUE(SameBits(measurement.readings[6].p_in_tracker, Eigen::Vector3d(7, 8, 9)));
}

TEST(Dataset, ReadsMarkerBodies) {
  const Dataset dataset =
      ReadText(kMillimetres + kThreePoses + kMarkers + "  noise: {sigma: 0.1}\n",
               "pose,body,marker,x,y,z\n" + SeenInAllPoses());
  const Measurement& measurement = *dataset.measurement;
  const MarkerBody &base = measurement.bodies[0], &tool = measurement.bodies[1];
  EXPECT_FALSE(base.is_centroid);
  EXPECT_EQ(base.markers, (std::vector<std::string>{"b1", "b2", "3"}));
  const Eigen::Matrix3d expected = Eigen::Vector3d(1e-3, 2e-3, 3e-3).asDiagonal();
  EXPECT_TRUE(MatrixNear(base.p_in_body, expected, 1e-18));
  EXPECT_TRUE(tool.is_centroid);
  EXPECT_EQ(tool.markers, (std::vector<std::string>{"t1", "t2", "3"}));
  EXPECT_EQ(tool.p_in_body.cols(), 0);
  EXPECT_EQ(tool.x_axis, (std::array<int, 2>{2, 0}));
  EXPECT_TRUE(MatrixNear(*measurement.marker_sigma, Eigen::Vector3d::Constant(1e-4), 1e-18));
  EXPECT_TRUE(
      MatrixNear(measurement.readings[1].p_in_tracker, Eigen::Vector3d(4e-3, 5e-3, 6e-3), 1e-17));
}

TEST(Dataset, AMarkerThatWasNotSeenHasNoReading) {
  const Dataset dataset =
      ReadText(kMetres + kThreePoses + kMarkers,
               "pose,body,marker,x,y,z\n" + SeenInAllPoses() + "1,base,b2,,,\n01,tool,t2, , ,\n");
  EXPECT_EQ(dataset.measurement->readings.size(), 6u);
  EXPECT_TRUE(dataset.measurement->frame_labels.empty());
}

TEST(Dataset, FramesCountInOrderOfFirstAppearance) {
  const std::string rows =
      "frame,pose,body,marker,x,y,z\n"
      "never,1,base,b1,,,\n"  // nothing was seen in it
      "b,1,base,b1,1,2,3\nb,1,tool,t1,1,2,3\na,1,base,b1,1,2,3\n"
      "a,01,base,b1,1,2,3\na,01,tool,t1,1,2,3\n"
      "10,1.0,base,b1,1,2,3\nb,1.0,tool,t1,1,2,3\n";
  const Dataset dataset = ReadText(kMetres + kThreePoses + kMarkers, rows);
  const Measurement& measurement = *dataset.measurement;
  EXPECT_EQ(measurement.frame_labels, (std::vector<std::string>{"b", "a", "10"}));
  std::vector<int> frames;
  for (const MarkerReading& reading : measurement.readings) frames.push_back(reading.frame);
  EXPECT_EQ(frames, (std::vector<int>{0, 0, 1, 1, 1, 2, 0}));
}

TEST(Dataset, OfSeveralRepeatedReadingsTheFirstInTheTableIsNamed) {
  const std::string rows = "pose,body,marker,x,y,z\n" + SeenInAllPoses() +
                           "1.0,base,b1,1,2,3\n1,tool,t1,1,2,3\n1,tool,t1,1,2,3\n";
  const std::string error =
      InputErrorText([&] { ReadText(kMetres + kThreePoses + kMarkers, rows); });
  EXPECT_NE(error.find("markers.csv:8: found marker b1 of the base body in pose '1.0'"),
            std::string::npos)
      << error;
  EXPECT_NE(error.find("(the first is in line 6)"), std::string::npos) << error;
}

TEST(Dataset, WithAStaticTrackerTheBaseNeedNotBeSeenInEveryPose) {
  const std::string rows =
      "pose,body,marker,x,y,z\n1,base,b1,1,2,3\n1,tool,t1,4,5,6\n01,tool,t1,4,5,6\n"
      "1.0,tool,t1,4,5,6\n";
  const std::string yaml = kMetres + kThreePoses + kMarkers;
  EXPECT_TRUE(ReadText(yaml + "tracker: {static: true}\n", rows).tracker.is_static);
  EXPECT_NE(InputErrorText([&] { ReadText(yaml, rows); }), "(no exception)");
  const std::string without_base =
      "pose,body,marker,x,y,z\n1,tool,t1,4,5,6\n01,tool,t1,4,5,6\n"
      "1.0,tool,t1,4,5,6\n";
  EXPECT_NE(InputErrorText([&] { ReadText(yaml + "tracker: {static: true}\n", without_base); }),
            "(no exception)");
}

TEST(Dataset, WhatIsOptionalIsAbsentUnlessStated) {
  const Dataset dataset = ReadText(kMetres + kThreePoses);
  EXPECT_EQ(dataset.name, "d");
  EXPECT_EQ(dataset.description, "");
  EXPECT_FALSE(dataset.gravity_in_base);
  EXPECT_FALSE(dataset.hexapod);
  EXPECT_FALSE(dataset.reference_temperature);
  EXPECT_FALSE(dataset.tracker.is_static);
  EXPECT_FALSE(dataset.tracker.tracker_from_world);
  EXPECT_EQ(dataset.tracker.frames, 1);
  EXPECT_FALSE(dataset.measurement);
  EXPECT_FALSE(dataset.initial);
  EXPECT_FALSE(dataset.robot_poses.noise);
  EXPECT_FALSE(dataset.robot_poses.leg_noise);
  EXPECT_TRUE(dataset.robot_poses.covariates.empty());
  EXPECT_TRUE(dataset.warnings.empty());
}

TEST(Dataset, ReadsEverySettingInTheUnitsOfTheFile) {
  const Dataset dataset = ReadText(kMillimetres + kThreePoses +
                                   "description: 'some: text'\n"
                                   "gravity: [0, 3, -4]\n"
                                   "reference_temperature: 21.5\n"
                                   "tracker:\n  static: true\n  frames: 4\n"
                                   "  pose: {xyz: [1, 2, 3], rpy: [90, 0, 90]}\n"
                                   "initial:\n"
                                   "  base: {xyz: [1, 2, 3], quaternion: [0.5, 0.5, -0.5, 0.5]}\n"
                                   "  tool: {xyz: [1, 2, 3], rpy: [90, 0, 90]}\n");
  EXPECT_EQ(dataset.description, "some: text");
  EXPECT_TRUE(MatrixNear(*dataset.gravity_in_base, Eigen::Vector3d(0, 0.6, -0.8), 1e-15));
  EXPECT_EQ(*dataset.reference_temperature, 21.5);
  EXPECT_TRUE(dataset.tracker.is_static);
  EXPECT_EQ(dataset.tracker.frames, 4);
  EXPECT_TRUE(PoseNear(*dataset.tracker.tracker_from_world, kTurned, 1e-15, 1e-15));
  EXPECT_TRUE(PoseNear(dataset.initial->world_from_base, kTurned, 1e-15, 1e-15));
  EXPECT_TRUE(PoseNear(dataset.initial->platform_from_tool, kTurned, 1e-15, 1e-15));
}

TEST(Dataset, NoiseOfTheReportedPose) {
  std::string yaml = kMillimetres + kThreePoses;
  yaml += "  noise: {position: 0.002, orientation: [0.1, 0.2, 0.3]}\n";
  const PoseNoise noise = *ReadText(yaml).robot_poses.noise;
  EXPECT_TRUE(MatrixNear(noise.position, Eigen::Vector3d::Constant(2e-6), 1e-20));
  EXPECT_TRUE(MatrixNear(noise.orientation, kDegree * Eigen::Vector3d(0.1, 0.2, 0.3), 1e-17));
  Vector6d sigmas;
  sigmas << noise.position, noise.orientation;
  EXPECT_TRUE(MatrixNear(noise.Covariance().diagonal(), sigmas.cwiseProduct(sigmas), 1e-20));
  EXPECT_EQ((noise.Covariance().array() != 0).count(), 6);
}

TEST(Dataset, ATableInAFileIsTheSameAsInline) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.Path("tables"));
  folder.Write("tables/p.csv",
               "\xEF\xBB\xBF# controller log\r\npose,x,y,z,rx,ry,rz\r\n1,0,0,1,0,0,0\r\n"
               "01,0,1,0,0,0,0\r\n\r\n1.0,1,0,0,0,0,0\r\n");
  const std::string path =
      folder.Write("d.yaml", kMillimetres + "robot_poses: {file: tables/../tables/p.csv}\n");
  const RobotPoses in_file = ReadDataset(path, false).robot_poses;
  const RobotPoses inline_rows = ReadText(kMillimetres + kThreePoses).robot_poses;
  ASSERT_EQ(in_file.rows.size(), inline_rows.rows.size());
  for (std::size_t i = 0; i < in_file.rows.size(); ++i) {
    EXPECT_EQ(in_file.rows[i].label, inline_rows.rows[i].label);
    EXPECT_TRUE(
        SameBits(in_file.rows[i].base_from_platform, inline_rows.rows[i].base_from_platform));
  }
  EXPECT_EQ(in_file.rows[2].line, 6);
}

TEST(Dataset, LinksWithinTheFolderAreFollowedOthersAreNot) {
  const TemporaryFolder outside, folder;
  const std::string table = "pose,x,y,z,rx,ry,rz\n1,0,0,1,0,0,0\n";
  outside.Write("p.csv", table);
  folder.Write("p.csv", table);
  std::filesystem::create_symlink(outside.Path("p.csv"), folder.Path("out.csv"));
  std::filesystem::create_directory_symlink(outside.Path(""), folder.Path("out"));
  std::filesystem::create_symlink("p.csv", folder.Path("in.csv"));
  const auto error = [&](const std::string& file) {
    const std::string path =
        folder.Write("d.yaml", kMetres + "robot_poses: {file: " + file + "}\n");
    return InputErrorText([&] { ReadDataset(path, false); });
  };
  EXPECT_EQ(error("in.csv"), "(no exception)");
  EXPECT_NE(error("out.csv").find("leaves the dataset's folder by a symbolic link"),
            std::string::npos);
  EXPECT_NE(error("out/p.csv").find("leaves the dataset's folder by a symbolic link"),
            std::string::npos);
  // A folder whose name only begins like the dataset's is outside too.
  const std::string sibling = folder.Path("").substr(0, folder.Path("").size() - 1) + "x";
  std::filesystem::create_directory(sibling);
  std::filesystem::copy_file(folder.Path("p.csv"), sibling + "/p.csv");
  std::filesystem::create_symlink(sibling + "/p.csv", folder.Path("sibling.csv"));
  EXPECT_NE(error("sibling.csv").find("leaves the dataset's folder"), std::string::npos);
  std::filesystem::remove_all(sibling);
}

TEST(Dataset, ReadsFromTheWorkingFolder) {
  const TemporaryFolder folder;
  folder.Write("p.csv", "pose,x,y,z,rx,ry,rz\n1,0,0,1,0,0,0\n2,0,0,oops,0,0,0\n");
  folder.Write("d.yaml", kMetres + "robot_poses: {file: p.csv}\n");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.Path(""));
  const std::string error = InputErrorText([] { ReadDataset("d.yaml", false); });
  std::filesystem::current_path(before);
  EXPECT_EQ(error, "p.csv:3:7: found 'oops' in column 'z', expected a number");
}

TEST(Dataset, TheLocaleDoesNotMatter) {
  const testing::DecimalComma locale;
  ASSERT_EQ(locale.Print(0.5), "0,5");
  const Pose3d pose = ReadOnePose("pose, x, y, z, rx, ry, rz", "p, 1.5, 1234.5, 0, 0, 0, 0");
  EXPECT_TRUE(MatrixNear(pose.translation, Eigen::Vector3d(0.0015, 1.2345, 0), 1e-15));
}

TEST(Dataset, AMeasurementMayBeAbsentForPredictions) {
  const TemporaryFolder folder;
  const std::string path = folder.Write("d.yaml", kMetres + kThreePoses);
  EXPECT_FALSE(ReadDataset(path, false).measurement);
  EXPECT_NE(InputErrorText([&] { ReadDataset(path, true); }).find("no key 'measurement'"),
            std::string::npos);
}

TEST(Dataset, APlanSaysWhatIsToBeMeasuredWithoutReadings) {
  const TemporaryFolder folder;
  const std::string markers = kMarkers + "  noise: {sigma: 0.1}\n";
  std::string plan = kMillimetres + kThreePoses + markers;
  plan.erase(plan.find("  file: markers.csv\n"), std::string("  file: markers.csv\n").size());
  const std::string path = folder.Write("d.yaml", plan);
  const Dataset dataset = ReadDataset(path, false);
  EXPECT_EQ(dataset.measurement->bodies[0].markers.size(), 3u);
  EXPECT_TRUE(dataset.measurement->marker_sigma);
  EXPECT_TRUE(dataset.measurement->readings.empty());
  EXPECT_TRUE(dataset.warnings.empty());
  EXPECT_NE(InputErrorText([&] { ReadDataset(path, true); }).find("neither file: nor rows:"),
            std::string::npos);
}

TEST(Dataset, AMissingFileIsRefused) {
  EXPECT_NE(InputErrorText([] { ReadDataset("no/such/dataset.yaml", true); }), "(no exception)");
}

}  // namespace
}  // namespace hexcal
