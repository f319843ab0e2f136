// SPDX-License-Identifier: BSD-3-Clause
// Readers of other programs' files, on files written by hand from their descriptions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "measurement/importers/missing.h"
#include "measurement/importers/times.h"
#include "testing/import_files.h"
#include "testing/matchers.h"

namespace hexcal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::ImportError;
using testing::ImportPath;
using testing::ImportText;
using testing::MatrixNear;
using testing::ReadImportText;
using testing::RefusedOfDamagedFiles;
using testing::Replaced;
using ::testing::StartsWith;
using Vector = Eigen::Vector3d;

constexpr double kExact = 1e-15;

Recording Read(std::string_view format, std::string_view name, const ImportOptions& options = {}) {
  return ReadRecording(*FindImportFormat(format), ImportPath(name), options);
}

TEST(Missing, KnowsTheCodesOfAllMakers) {
  EXPECT_TRUE(IsMissing(-3.697314e28));
  EXPECT_TRUE(IsMissing(static_cast<double>(-3.697314e28f)));
  EXPECT_TRUE(IsMissing(std::nan("")));
  EXPECT_FALSE(IsMissing(-2655.2));
  EXPECT_FALSE(IsMissing(0.0));
  for (const char* word : {"", "nan", "NaN", "MISSING", "Disabled"}) EXPECT_TRUE(IsMissing(word));
  EXPECT_FALSE(IsMissing(std::string_view("0")));
}

TEST(Times, KeepsTimesToTheNanosecond) {
  EXPECT_EQ(ParseSeconds("1778067471.318767388"), 1778067471318767388);
  EXPECT_EQ(ParseSeconds("-0.25"), -250000000);
  EXPECT_EQ(ParseSeconds("1.5e3"), 1500000000000);
  EXPECT_EQ(ParseSeconds("12"), 12000000000);
  EXPECT_EQ(ParseSeconds(".5"), 500000000);
  EXPECT_EQ(ParseSeconds("nan"), std::nullopt);
  EXPECT_EQ(ParseSeconds("1e11"), std::nullopt);
  EXPECT_EQ(ParseSeconds("12:30"), std::nullopt);
}

TEST(NdiCsv, ReadsToolsMarkersAndTimes) {
  const Recording read = Read("ndi_csv", "ndi_wide.csv");
  ASSERT_EQ(read.rows, 3u);
  EXPECT_THAT(read.times,
              ElementsAre(1778067471318767388, 1778067471418767388, 1778067471518767388));
  EXPECT_THAT(read.lines, ElementsAre(2, 3, 4));
  ASSERT_EQ(read.bodies.size(), 2u);
  EXPECT_THAT(read.bodies[0].aliases, ElementsAre("0x01", "Probe", "3E4C880C"));
  EXPECT_THAT(read.bodies[1].aliases, ElementsAre("0x02", "Frame, base"));
  EXPECT_THAT(read.bodies[0].markers, ElementsAre(0, 1, 2));
  EXPECT_THAT(read.bodies[1].markers, ElementsAre(3, 4, 5, 6));

  EXPECT_THAT(read.frames, ElementsAre(650512279, 650512285, 650512291));

  const RecordedBody& frame = read.bodies[1];
  EXPECT_TRUE(MatrixNear(frame.poses[0]->translation, Vector(0.1, 0.2, -1.5), kExact));
  // Scalar first: half a turn about x, and a quarter about y.
  EXPECT_TRUE(MatrixNear(frame.poses[0]->rotation * Vector(0, 1, 0), Vector(0, -1, 0), kExact));
  EXPECT_TRUE(MatrixNear(frame.poses[1]->rotation * Vector(1, 0, 0), Vector(0, 0, -1), 1e-7));
  EXPECT_TRUE(
      MatrixNear(*read.markers[0].points[0], Vector(-0.054047, -0.355147, -1.630068), kExact));
}

TEST(NdiCsv, LeavesOutWhatWasNotSeen) {
  const Recording read = Read("ndi_csv", "ndi_wide.csv");
  EXPECT_FALSE(read.bodies[0].poses[1]);    // too few markers
  EXPECT_FALSE(read.markers[1].points[1]);  // OK itself, but its tool is not
  EXPECT_FALSE(read.bodies[0].poses[2]);    // not in the row at all
  EXPECT_FALSE(read.markers[5].points[0]);  // its own state
  EXPECT_TRUE(read.markers[6].points[0]);
  EXPECT_TRUE(read.bodies[1].poses[2]);
  ASSERT_EQ(read.warnings.size(), 1u);
  EXPECT_THAT(read.warnings[0], HasSubstr("1 tool not used, its state being 'Too Few Markers'"));
}

TEST(NdiCsv, TakesAMissingValueAndWarnsOfZeros) {
  const std::string zeros =
      Replaced(ImportText("ndi_wide.csv"), "OK,10.5,-200.0,-1650.25", "OK,0,0,0");
  EXPECT_THAT(ReadImportText("ndi_csv", zeros).warnings, ::testing::Contains(HasSubstr("0 0 0")));
  ImportOptions options;
  options.missing_value = 0.0;
  EXPECT_FALSE(ReadImportText("ndi_csv", zeros, options).markers[2].points[0]);
}

TEST(NdiCsv, RefusesWhatItIsNot) {
  const std::string good = ImportText("ndi_wide.csv");
  const auto error = [&](std::string_view from, std::string_view to) {
    return ImportError("ndi_csv", Replaced(good, from, to));
  };
  EXPECT_THAT(ImportError("ndi_csv", ""),
              StartsWith("in: found an empty file, expected the header"));
  EXPECT_THAT(error("Tools", "Tool"), StartsWith("in:1:1: found 'Tool', expected the header of"));
  EXPECT_THAT(error("Q0", "QW"), StartsWith("in:1:66: found the column 'QW'"));
  EXPECT_THAT(error(",Qz,", ",Qy,"),
              StartsWith("in:1:75: found the column 'Qy', expected each once"));
  EXPECT_THAT(error("State,Tx,Ty,Tz,State", "State,Tx,Tz,Ty,State"),
              StartsWith("in:1:110: found 'Tz', expected State, Tx, Ty, Tz"));
  EXPECT_THAT(error("-42.126", "-42,126"), HasSubstr("in:2:"));
  EXPECT_THAT(error("-42.126", "x"), StartsWith("in:2:110: found 'x', expected a finite number"));
  EXPECT_THAT(error("-42.126", ""), StartsWith("in:2:110: found 2 of 3 coordinates"));
  EXPECT_THAT(error("1.0000000,", "1.1000000,"), StartsWith("in:2:70: found the quaternion"));
  EXPECT_THAT(error("2,Port", "1,Port"), StartsWith("in:2:1: found Tools = 1, expected 2"));
  EXPECT_THAT(
      error("\n1,\"Port 0x02", "\n1,\"Port 0x03"),
      StartsWith("in:4:3: found 'Port 0x03: Frame, base', expected a tool that the header"));
  EXPECT_THAT(error("base\",", "base,"), HasSubstr("found a quote that does not end in its line"));
  EXPECT_THAT(ImportError("ndi_csv", good.substr(0, good.size() - 6)), StartsWith("in:4:"));
  EXPECT_THAT(ImportError("ndi_csv", good.substr(0, good.find('\n'))),
              StartsWith("in: found no row below the header"));
  EXPECT_THAT(ImportError("ndi_csv", ImportText("pi_gcs.dat")),
              HasSubstr("(the file begins like one of the format pi_gcs)"));
}

TEST(NdiCsv, SurvivesDamage) {
  EXPECT_GT(RefusedOfDamagedFiles("ndi_csv", ImportText("ndi_wide.csv"), 13), 200);
}

TEST(PiGcs, ReadsPosesByTheNamesOfTheAxes) {
  const Recording read = Read("pi_gcs", "pi_gcs.dat");
  ASSERT_EQ(read.rows, 3u);
  ASSERT_EQ(read.bodies.size(), 1u);
  const RecordedBody& robot = read.bodies[0];
  EXPECT_TRUE(MatrixNear(robot.poses[0]->translation, Vector(0.0015, -0.002, 0.00025), kExact));
  EXPECT_TRUE(MatrixNear(robot.poses[0]->rotation * Vector(1, 0, 0), Vector(0, 1, 0), kExact));
  EXPECT_TRUE(MatrixNear(robot.poses[1]->rotation * Vector(0, 1, 0), Vector(0, 0, 1), kExact));
  // Rx(90) Ry(90): z goes to x and stays there.
  EXPECT_TRUE(MatrixNear(robot.poses[2]->rotation * Vector(0, 0, 1), Vector(1, 0, 0), kExact));
  EXPECT_THAT(read.times, ElementsAre(0, 100000, 200000));
  EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("3 rows, where NDATA says 2")));
}

TEST(PiGcs, TakesOtherOrdersAndColumns) {
  ImportOptions options;
  options.rotation_order = "zyx";
  // Ry(90) Rx(90): z goes to -y and stays there.
  EXPECT_TRUE(MatrixNear(
      Read("pi_gcs", "pi_gcs.dat", options).bodies[0].poses[2]->rotation * Vector(0, 0, 1),
      Vector(0, -1, 0),
      kExact));
  options.columns = {"3", "Actual Position of Axis X", "4", "5", "6", "7"};
  EXPECT_TRUE(MatrixNear(Read("pi_gcs", "pi_gcs.dat", options).bodies[0].poses[0]->translation,
                         Vector(-0.002, 0.0015, 0.00025),
                         kExact));
}

TEST(PiGcs, RefusesWhatItIsNot) {
  const std::string good = ImportText("pi_gcs.dat");
  const auto error = [&](std::string_view from, std::string_view to) {
    return ImportError("pi_gcs", Replaced(good, from, to));
  };
  EXPECT_THAT(ImportError("pi_gcs", ""), StartsWith("in: found an empty file"));
  EXPECT_THAT(error("# END_HEADER\n", ""), StartsWith("in:14: found '1"));
  EXPECT_THAT(ImportError("pi_gcs", good.substr(0, 40)), HasSubstr("'# END_HEADER'"));
  EXPECT_THAT(error("# DIM = 7", "# DIM = seven"), StartsWith("in:3: found DIM = 'seven'"));
  EXPECT_THAT(error("# DIM = 7\n", ""), HasSubstr("found no line '# DIM = ...'"));
  EXPECT_THAT(error("# DIM = 7", "# DIM = 6"), StartsWith("in: found NAME6"));
  EXPECT_THAT(error("# DIM = 7", "# DIM = 1000000000"), HasSubstr("from 1 to 64"));
  EXPECT_THAT(error("SEPARATOR = 9", "SEPARATOR = 46"), HasSubstr("44 (comma)"));
  EXPECT_THAT(error("Axis U", "Axis Q"), HasSubstr("found 0 columns for the axis u among"));
  EXPECT_THAT(error("Axis U", "Axis V"), HasSubstr("--robot_columns"));
  EXPECT_THAT(error("\t-2\t", "\t-2,5\t"), StartsWith("in:15:7: found '-2,5'"));
  EXPECT_THAT(error("\t-2\t", "\tnan\t"), StartsWith("in:15:7: found 'nan'"));
  EXPECT_THAT(error("\t-2\t", "\t"), StartsWith("in:15: found 6 cells, expected 7"));
  EXPECT_THAT(error("SAMPLE_TIME = 9", "SAMPLE_TIME = -9"), StartsWith("in:4: found SAMPLE_TIME"));
  ImportOptions options;
  options.columns = {"1", "2", "3", "4", "5", "8"};
  EXPECT_THAT(ImportError("pi_gcs", good, options), HasSubstr("expected one named '8'"));
}

TEST(PiGcs, SurvivesDamage) {
  EXPECT_GT(RefusedOfDamagedFiles("pi_gcs", ImportText("pi_gcs.dat"), 7), 80);
}

}  // namespace
}  // namespace hexcal
