// SPDX-License-Identifier: BSD-3-Clause
// hexcal import from outside: what users do wrong with files that are right.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <string>
#include <vector>

#include "geometry/pose.h"
#include "testing/cli_test.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using ::hexcal::testing::ProgramResult;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kTracker = HEXCAL_EXAMPLES "/ndi-and-pi/tracker.csv";
const std::string kRobot = "--robot=" HEXCAL_EXAMPLES "/ndi-and-pi/hexapod.dat";

class CliImportSlips : public testing::CliTest {
 protected:
  ProgramResult Import(const std::vector<std::string>& more) const {
    return Call({"import", "ndi_csv", kTracker, kRobot, "--pair=rows", "--out=mine"}, more);
  }
  ProgramResult ImportRightly(std::vector<std::string> more) const {
    more.insert(more.end(), {"--base=0x0A", "--tool=0x0B"});
    return Import(more);
  }
};

// A second run replaces the first, but no key that was added by hand since.
TEST_F(CliImportSlips, KeepsADatasetThatWasWorkedOn) {
  ASSERT_EQ(ImportRightly({}).status, 0);
  ASSERT_EQ(ImportRightly({"--kind=poses"}).status, 0);
  const std::string text = folder.Read("mine/dataset.yaml") + "gravity: [0, 0, -1]\n";
  folder.Write("mine/dataset.yaml", text);
  const ProgramResult refused = ImportRightly({});
  EXPECT_EQ(refused.status, 5);
  EXPECT_THAT(refused.err, HasSubstr("mine/dataset.yaml: this file or a table of it was changed"));
  EXPECT_EQ(folder.Read("mine/dataset.yaml"), text);
  EXPECT_EQ(ImportRightly({"--force"}).status, 0);
}

TEST_F(CliImportSlips, RefusesOneBodyForBaseAndTool) {
  const ProgramResult same = Import({"--base=0x0B", "--tool=Platform frame"});
  EXPECT_EQ(same.status, 3);
  EXPECT_THAT(same.err, HasSubstr("which are the same or share a marker"));
}

TEST_F(CliImportSlips, SaysThatARobotsFileIsUtf16) {
  folder.Write("robot.dat", std::string("\xFF\xFE#\0 \0T\0Y\0P\0E\0", 14));
  const ProgramResult refused =
      Call({"import", "ndi_csv", kTracker, "--robot=robot.dat", "--pair=rows", "--out=mine"});
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.err, HasSubstr("robot.dat:1:1: found UTF-16 text, expected UTF-8 text"));
}

// The data cannot tell these from each other; who takes the first for true gets a wrong base.
TEST_F(CliImportSlips, NamesAllInversionsThatFitAlike) {
  const ProgramResult interchanged = Import({"--base=0x0B", "--tool=0x0A"});
  EXPECT_EQ(interchanged.status, 0);
  EXPECT_THAT(interchanged.err,
              HasSubstr("the robot's poses inverted (--robot_inverse); as well with base and tool "
                        "interchanged (--base, --tool): which it is no data can tell"));
  const ProgramResult poses = Import({"--base=0x0B", "--tool=0x0A", "--kind=poses"});
  EXPECT_THAT(poses.err, HasSubstr("interchanged (--base, --tool): which it is no data can tell"));
  EXPECT_THAT(poses.err, HasSubstr("(--robot_inverse)"));
  EXPECT_THAT(poses.err, HasSubstr("(--measured_inverse)"));
  // No word of it where the angles are at fault.
  const ProgramResult order = ImportRightly({"--robot_rotation=zyx"});
  EXPECT_THAT(order.err, HasSubstr("(--robot_rotation=xyz)"));
  EXPECT_THAT(order.err, Not(HasSubstr("no data can tell")));
}

// A flag that the map makes useless is not taken in silence, nor advised.
TEST_F(CliImportSlips, LeavesTheOrderOfAnglesToTheColumnMap) {
  folder.Write("map.yaml",
               "format: hexcal/columns/1\ndelimiter: tab\nheader: false\ncomment: \"#\"\n"
               "units: {length: mm, angle: deg}\n"
               "bodies: {robot: {position: [1, 2, 3], angles: [4, 5, 6], order: zyx}}\n");
  const ProgramResult wrong = ImportRightly({"--robot_map=map.yaml"});
  EXPECT_EQ(wrong.status, 0) << wrong.err;
  EXPECT_THAT(wrong.err, HasSubstr("in the order xyz (in the column map, order: xyz)"));
  const ProgramResult refused = ImportRightly({"--robot_map=map.yaml", "--robot_rotation=zyx"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("found --robot_rotation beside --robot_map"));
}

// The same poses with the scalar of the tracker's quaternions at the end that the file's reader
// does not expect, as a trajectory and by a column map.
TEST_F(CliImportSlips, SaysThatTheScalarOfTheTrackersQuaternionsIsAtTheOtherEnd) {
  const Pose3d world_from_base{{0.4, -0.2, 1.1}, Exp(Eigen::Vector3d(0.3, -0.2, 0.5))};
  const Pose3d platform_from_tool{{0.02, 0.01, 0.09}, Exp(Eigen::Vector3d(-0.1, 0.4, 0.2))};
  std::mt19937_64 random = testing::SeededByTest();
  const auto row = [](int i, const Pose3d& pose, bool scalar_first) {
    const Eigen::Vector3d& t = pose.translation;
    const Eigen::Quaterniond& q = pose.rotation;
    std::vector<double> numbers = {t.x(), t.y(), t.z(), q.x(), q.y(), q.z()};
    numbers.insert(scalar_first ? numbers.begin() + 3 : numbers.end(), q.w());
    return fmt::format("{} {}\n", i, fmt::join(numbers, " "));
  };
  std::string robot, first, last;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d translation = testing::UniformVector(random, 0.05);
    const Pose3d reported{translation, Exp(testing::UniformVector(random, 0.3))};
    const Pose3d measured = world_from_base * reported * platform_from_tool;
    robot += row(i, reported, false);
    first += row(i, measured, true);
    last += row(i, measured, false);
  }
  folder.Write("robot.tum", robot);
  folder.Write("first.tum", first);
  folder.Write("last.tum", last);
  folder.Write("map.yaml",
               "format: hexcal/columns/1\ndelimiter: blanks\nheader: false\n"
               "units: {length: m, angle: rad}\n"
               "bodies: {tool: {position: [2, 3, 4], quaternion: [5, 6, 7, 8]}}\n");
  const auto import = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "import");
    arguments.insert(arguments.end(), {"--robot=robot.tum", "--pair=rows", "--out=mine"});
    const ProgramResult imported = Call(arguments);
    EXPECT_EQ(imported.status, 0) << imported.err;
    return imported.out + imported.err;
  };
  const std::string stated = "conventions as stated, none of 143 others fits";
  EXPECT_THAT(import({"tum", "last.tum"}), HasSubstr(stated));
  EXPECT_THAT(import({"tum", "first.tum"}),
              HasSubstr("with the scalar of the tracker's quaternions first\n"));
  EXPECT_THAT(import({"columns", "first.tum", "--map=map.yaml"}), HasSubstr(stated));
  EXPECT_THAT(import({"columns", "last.tum", "--map=map.yaml"}),
              HasSubstr("with the scalar of the tracker's quaternions last (in the column map, "
                        "quaternion: w x y z)\n"));
  // Backwards as well.
  EXPECT_THAT(import({"tum", "first.tum", "--measured_inverse"}),
              AllOf(HasSubstr("the scalar of the tracker's quaternions first"),
                    HasSubstr("which it is no data can tell")));
}

}  // namespace
}  // namespace hexcal
