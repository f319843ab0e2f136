// SPDX-License-Identifier: BSD-3-Clause
// hexcal import from outside: from other programs' files to a calibration.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "config/number.h"
#include "measurement/importers/formats.h"
#include "model/machine.h"
#include "testing/cli_test.h"
#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using ::hexcal::testing::ProgramResult;
using ::hexcal::testing::RunHexcal;
using ::testing::HasSubstr;
using Json = nlohmann::json;

const std::string kExamples = HEXCAL_EXAMPLES;
const std::string kTracker = kExamples + "/ndi-and-pi/tracker.csv";
const std::string kRobot = "--robot=" + kExamples + "/ndi-and-pi/hexapod.dat";

class CliImport : public testing::CliTest {
 protected:
  ProgramResult Import(const std::vector<std::string>& more) const {
    return Call({"import"}, more);
  }
  ProgramResult ImportExample(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {
        "ndi_csv", kTracker, kRobot, "--base=0x0A", "--tool=0x0B", "--out=mine"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Import(arguments);
  }
};

Pose3d PoseOf(const Json& json) {
  const std::vector<double> t = json["xyz"], q = json["quaternion"];
  return {{t[0], t[1], t[2]}, Eigen::Quaterniond(q[0], q[1], q[2], q[3])};
}

TEST_F(CliImport, GoesFromNdiAndPiFilesToACalibration) {
  const ProgramResult imported = ImportExample({"--pair=rows"});
  ASSERT_EQ(imported.status, 0) << imported.err;
  EXPECT_THAT(imported.out, HasSubstr("mine: 60 robot poses, 354 readings of 3 + 3 markers"));
  EXPECT_THAT(imported.err, HasSubstr("2 tools not used, their state being 'Too Few Markers'"));

  const ProgramResult calibrated = Call({"calibrate", "mine/dataset.yaml", "--out=out"});
  ASSERT_EQ(calibrated.status, 0) << calibrated.err;
  const Json result = Json::parse(folder.Read("out/mine/result.json"));
  EXPECT_EQ(result["residual"], "marker");
  const Machine truth = ReadMachine(kExamples + "/neurobot/truth.yaml");
  const std::vector<double> sigma = result["standard_deviation"];
  Vector6d base = Minus(PoseOf(result["world_from_base"]), truth.world_from_base);
  Vector6d tool = Minus(PoseOf(result["platform_from_tool"]), truth.platform_from_tool);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    EXPECT_LT(std::abs(base[k]), 4 * sigma[i]) << result["parameters"][i];
    EXPECT_LT(std::abs(tool[k]), 4 * sigma[i + 6]) << result["parameters"][i + 6];
  }
}

TEST_F(CliImport, GivesTheSameByPosesWithinTheirNoise) {
  ASSERT_EQ(ImportExample({"--pair=rows", "--kind=poses"}).status, 0);
  EXPECT_THAT(folder.Read("mine/dataset.yaml"), HasSubstr("kind: poses"));
  const ProgramResult calibrated = Call({"calibrate", "mine/dataset.yaml", "--out=out"});
  ASSERT_EQ(calibrated.status, 0) << calibrated.err;
  const Json result = Json::parse(folder.Read("out/mine/result.json"));
  const Machine truth = ReadMachine(kExamples + "/neurobot/truth.yaml");
  EXPECT_TRUE(
      testing::PoseNear(PoseOf(result["world_from_base"]), truth.world_from_base, 5e-4, 2e-3));
  EXPECT_EQ(result["poses"].size(), 58u);
}

// As much as a calibration leaves, not one of the least squares.
TEST_F(CliImport, SaysWhatTheConventionsAsStatedLeave) {
  const std::string out = ImportExample({"--pair=rows", "--kind=poses"}).out;
  std::smatch left;
  ASSERT_TRUE(std::regex_search(
      out,
      left,
      std::regex("others fits much better; base and tool leave (\\S+) mm and (\\S+) mrad")))
      << out;
  ASSERT_EQ(Call({"calibrate", "mine/dataset.yaml", "--out=out"}).status, 0);
  const Json result = Json::parse(folder.Read("out/mine/result.json"));
  EXPECT_NEAR(ParseDouble(left.str(1)).value() / (1e3 * result["rmspe"].get<double>()), 1.0, 0.2);
  EXPECT_NEAR(ParseDouble(left.str(2)).value() / (1e3 * result["rmsoe"].get<double>()), 1.0, 0.2);
}

TEST_F(CliImport, SaysWhereAnotherConventionFits) {
  EXPECT_THAT(ImportExample({"--pair=rows"}).out, HasSubstr("conventions as stated"));
  const ProgramResult order = ImportExample({"--pair=rows", "--robot_rotation=zyx"});
  EXPECT_EQ(order.status, 0);
  EXPECT_THAT(order.err, HasSubstr("the robot's angles in the order xyz (--robot_rotation=xyz)"));
  EXPECT_THAT(order.out, ::testing::Not(HasSubstr("conventions as stated")));
  const ProgramResult inverse = ImportExample({"--pair=rows", "--robot_inverse"});
  EXPECT_THAT(inverse.err, HasSubstr("the robot's poses as they are (no --robot_inverse)"));
  // Poses of the tracker, its own frame being W.
  const ProgramResult tracker =
      ImportExample({"--pair=rows", "--kind=poses", "--measured_inverse", "--name=turned"});
  EXPECT_THAT(tracker.err, HasSubstr("the tracker's poses as they are (no --measured_inverse)"));
}

// The same poses as two trajectories, the tracker's clock ahead, with another program's calibration
// of the base as a first guess.
TEST_F(CliImport, TakesTrajectoriesPairedByTimeAndAFirstGuess) {
  const Pose3d world_from_base{{0.4, -0.2, 1.1}, Exp(Eigen::Vector3d(0.3, -0.2, 0.5))};
  const Pose3d platform_from_tool{{0.02, 0.01, 0.09}, Exp(Eigen::Vector3d(-0.1, 0.4, 0.2))};
  std::mt19937_64 random = testing::SeededByTest();
  std::string robot, tracker = "# seconds x y z qx qy qz qw\n";
  const auto row = [](double time, const Pose3d& pose) {
    const Eigen::Vector3d& t = pose.translation;
    const Eigen::Vector4d& q = pose.rotation.coeffs();
    return fmt::format(
        "{} {} {} {} {} {} {} {}\n", time, t.x(), t.y(), t.z(), q[0], q[1], q[2], q[3]);
  };
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d translation = testing::UniformVector(random, 0.05);
    const Pose3d reported{translation, Exp(testing::UniformVector(random, 0.3))};
    robot += row(10.0 * i, reported);
    tracker += row(1000.25 + 10.0 * i, world_from_base * reported * platform_from_tool);
  }
  const Pose3d guess = world_from_base.Inverse();
  const Eigen::Vector4d& q = guess.rotation.coeffs();
  folder.Write("robot.tum", robot);
  folder.Write("tracker.tum", tracker);
  folder.Write("base.yaml",
               fmt::format("parameters: {{eye_on_hand: false}}\ntransformation: {{x: {}, y: {}, z: "
                           "{}, qx: {}, qy: {}, qz: {}, qw: {}}}\n",
                           guess.translation.x(),
                           guess.translation.y(),
                           guess.translation.z(),
                           q[0],
                           q[1],
                           q[2],
                           q[3]));
  const ProgramResult imported = Import({"tum",
                                         "tracker.tum",
                                         "--robot=robot.tum",
                                         "--pair=time",
                                         "--time_offset=1000.25",
                                         "--initial=base.yaml",
                                         "--out=mine"});
  ASSERT_EQ(imported.status, 0) << imported.err;
  EXPECT_THAT(imported.out, HasSubstr("mine: 20 robot poses, 20 poses of the tool"));
  const Dataset dataset = ReadDataset(folder.Path("mine/dataset.yaml"), true);
  EXPECT_TRUE(testing::PoseNear(dataset.initial->world_from_base, world_from_base, 1e-9, 1e-9));
  EXPECT_TRUE(
      testing::PoseNear(dataset.initial->platform_from_tool, platform_from_tool, 1e-9, 1e-9));
  EXPECT_EQ(dataset.robot_poses.covariates.at(0).values.back(), 190.0);
}

// Markers by name, their places from a file, a body of each kind.
TEST_F(CliImport, TakesFirstPrinciplesMarkersWithTheirBodies) {
  const std::string data = std::string(HEXCAL_SOURCE) + "/tests/data/importers/";
  const Dataset example = ReadDataset(kExamples + "/neurobot/dataset.yaml", true);
  std::string text = "Number of frames: 60\nFrequency: 10\nUnits: mm\n\nFrame";
  for (const char* name : {"B1", "B2", "B3", "T1", "T2", "T3"})
    text += fmt::format("\t{0} x\t{0} y\t{0} z", name);
  int last = -1;
  for (const MarkerReading& reading : example.measurement->readings) {
    if (reading.pose != last) text += fmt::format("\n{}", reading.pose + 1);
    last = reading.pose;
    for (const double x : reading.p_in_tracker) text += fmt::format("\t{}", 1e3 * x);
  }
  folder.Write("markers.tsv", text + "\n");
  folder.Write("tool.rig",
               "Marker Description File\nReal 3D\n3 ;Number of markers\n1 ;views\nFront\n"
               "Marker X Y Z Views\n1 -69 -40 0 1\n2 69 -40 0 1\n3 0 80 0 1\n");
  const ProgramResult imported = Import({"first_principles",
                                         "markers.tsv",
                                         kRobot,
                                         "--base=B1,B2,B3",
                                         "--tool=T1,T2,T3",
                                         "--tool_body=tool.rig",
                                         "--pair=rows",
                                         "--out=mine"});
  ASSERT_EQ(imported.status, 0) << imported.err;
  EXPECT_THAT(imported.out, HasSubstr("conventions as stated"));
  const ProgramResult calibrated = Call({"calibrate", "mine/dataset.yaml", "--out=out"});
  ASSERT_EQ(calibrated.status, 0) << calibrated.err;
  const Json result = Json::parse(folder.Read("out/mine/result.json"));
  const Machine truth = ReadMachine(kExamples + "/neurobot/truth.yaml");
  EXPECT_TRUE(testing::PoseNear(
      PoseOf(result["platform_from_tool"]), truth.platform_from_tool, 3e-4, 1e-3));
  // Without the file the tool's three markers make their own frame; four would need one.
  EXPECT_EQ(Import({"first_principles",
                    "markers.tsv",
                    kRobot,
                    "--base=B1,B2,B3",
                    "--tool=T1,T2",
                    "--pair=rows",
                    "--out=other"})
                .status,
            3);
  EXPECT_EQ(Import({"first_principles",
                    data + "first_principles.tsv",
                    kRobot,
                    "--base=Beam1",
                    "--tool=Beam2",
                    "--pair=rows",
                    "--out=other"})
                .status,
            3);
}

TEST_F(CliImport, CommentsTheDatasetThatItWrites) {
  ASSERT_EQ(ImportExample(
                {"--pair=rows", "--name=bench-3", "--hexapod=" + kExamples + "/neurobot/plan.yaml"})
                .status,
            0);
  const std::string yaml = folder.Read("mine/dataset.yaml");
  EXPECT_EQ(yaml.rfind("# Written by hexcal import ndi_csv ", 0), 0u);
  EXPECT_THAT(yaml, HasSubstr("name: \"bench-3\""));
  EXPECT_THAT(yaml, HasSubstr("\n# What the robot reported. "));
  EXPECT_THAT(yaml, HasSubstr("\n# What the tracker saw. "));
  EXPECT_THAT(yaml, HasSubstr("Platform frame"));
  EXPECT_THAT(yaml, HasSubstr("hexapod:"));
  EXPECT_THAT(folder.Read("mine/poses.csv"), HasSubstr(",time\n1,"));
  // Its own results give way, others do not.
  EXPECT_EQ(ImportExample({"--pair=rows"}).status, 0);
  folder.Write("mine/dataset.yaml", "format: hexcal/dataset/1\n");
  EXPECT_EQ(ImportExample({"--pair=rows"}).status, 5);
  EXPECT_EQ(ImportExample({"--pair=rows", "--force"}).status, 0);
}

TEST_F(CliImport, AsksForWhatTheFilesDoNotSay) {
  const ProgramResult no_robot = Import({"ndi_csv", kTracker, "--out=mine"});
  EXPECT_EQ(no_robot.status, 2);
  EXPECT_THAT(no_robot.err, HasSubstr("--robot=FILE is missing"));

  const ProgramResult no_pair = ImportExample({});
  EXPECT_EQ(no_pair.status, 3);
  EXPECT_THAT(no_pair.err,
              HasSubstr("60 rows in one file of the tracker and 60 rows of the robot"));
  EXPECT_THAT(no_pair.err, HasSubstr("--pair=rows"));

  const ProgramResult no_bodies =
      Import({"ndi_csv", kTracker, kRobot, "--pair=rows", "--out=mine"});
  EXPECT_EQ(no_bodies.status, 3);
  EXPECT_THAT(no_bodies.err, HasSubstr("'Port 0x0A: Base frame  s/n:3E4C8801'"));
  EXPECT_THAT(no_bodies.err, HasSubstr("--base=NAME"));

  const ProgramResult unlike = ImportExample({"--pair=rows", "--frames=2"});
  EXPECT_EQ(unlike.status, 3);
  EXPECT_THAT(unlike.err, HasSubstr("2 of the tracker for each of the robot"));

  const std::string nameless = folder.Write("robot.txt", "1 2 3\n");
  const ProgramResult unknown = Import({"ndi_csv", kTracker, "--robot=" + nameless, "--out=mine"});
  EXPECT_EQ(unknown.status, 3);
  EXPECT_THAT(unknown.err, HasSubstr("--robot_format=FORMAT"));
  EXPECT_THAT(folder.Names(), ::testing::ElementsAre("robot.txt"));
}

TEST_F(CliImport, RefusesWrongUsage) {
  const ProgramResult format = Import({"ndi_cvs", kTracker, "--out=mine"});
  EXPECT_EQ(format.status, 2);
  EXPECT_THAT(format.err, HasSubstr("(did you mean 'ndi_csv'?)"));
  EXPECT_EQ(Import({"ndi_csv", "--out=mine"}).status, 2);
  EXPECT_EQ(ImportExample({"--pair=files", "--window=1"}).status, 2);
  EXPECT_EQ(ImportExample({"--pair=rows", "--robot_columns=1,2,3"}).status, 2);
  EXPECT_EQ(Import({"ndi_csv", "absent.csv", kRobot, "--out=mine"}).status, 3);
}

// Too little data: nothing is left in the folder, nor elsewhere.
TEST_F(CliImport, LeavesNothingOfARefusedDataset) {
  std::ifstream whole(kTracker);
  std::string few, line;
  for (int i = 0; i < 3 && std::getline(whole, line); ++i) few += line + "\n";
  folder.Write("few.csv", few);
  std::string robot;
  std::ifstream all(kExamples + "/ndi-and-pi/hexapod.dat");
  for (int rows = 0; rows < 2 && std::getline(all, line);) {
    robot += line + "\n";
    if (!line.empty() && line[0] != '#') ++rows;
  }
  folder.Write("robot.dat", robot);
  const std::vector<std::string> arguments = {"import",
                                              "ndi_csv",
                                              "few.csv",
                                              "--robot=robot.dat",
                                              "--base=0x0A",
                                              "--tool=0x0B",
                                              "--pair=rows",
                                              "--out=mine"};
  const ProgramResult refused =
      RunHexcal({arguments, folder.Path(""), {{"TMPDIR", folder.Path("")}}});
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.err, HasSubstr("the dataset for mine is refused, and not written: "));
  EXPECT_THAT(refused.err, ::testing::Not(HasSubstr(folder.Path(""))));
  EXPECT_THAT(folder.Names(), ::testing::UnorderedElementsAre("few.csv", "robot.dat"));
}

TEST_F(CliImport, MakesAPlanOfARobotsPosesAlone) {
  const ProgramResult plan =
      Import({"pi_gcs", kExamples + "/ndi-and-pi/hexapod.dat", "--out=plan"});
  ASSERT_EQ(plan.status, 0) << plan.err;
  const ProgramResult predicted = Call({"predict",
                                        "plan/dataset.yaml",
                                        "--model=" + kExamples + "/neurobot/truth.yaml",
                                        "--out=where.csv"});
  EXPECT_EQ(predicted.status, 0) << predicted.err;
}

TEST_F(CliImport, HelpNamesEveryFormat) {
  const std::string help = Call({"help", "import"}).out;
  for (const ImportFormat& format : ImportFormats())
    EXPECT_THAT(help, HasSubstr(std::string(format.name) + ": "));
}

// docs/formats.md has a section for each, which begins with what the table says of it.
TEST_F(CliImport, DocsDescribeEveryFormat) {
  std::ostringstream text;
  text << std::ifstream(std::string(HEXCAL_SOURCE) + "/docs/formats.md").rdbuf();
  std::string docs = text.str();
  std::replace(docs.begin(), docs.end(), '\n', ' ');
  for (const ImportFormat& format : ImportFormats())
    EXPECT_THAT(docs, HasSubstr(fmt::format("### {} {}. ", format.name, format.summary)));
}

}  // namespace
}  // namespace hexcal
