// SPDX-License-Identifier: BSD-3-Clause
// Readers of the further formats, on files written by hand from their descriptions.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "measurement/importers/column_map.h"
#include "measurement/importers/initial_guess.h"
#include "measurement/importers/ndi_bodies.h"
#include "measurement/importers/yaml_poses.h"
#include "testing/import_files.h"
#include "testing/matchers.h"

namespace hexcal {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::ImportError;
using testing::ImportPath;
using testing::ImportText;
using testing::InputErrorText;
using testing::MatrixNear;
using testing::PoseNear;
using testing::Replaced;
using ::testing::StartsWith;
using testing::TemporaryFolder;
using Vector = Eigen::Vector3d;

constexpr double kExact = 1e-15;
constexpr double kDigits = 1e-8;  // of quaternions as written

// The pose in all files of poses: a quarter turn about z.
Pose3d Quarter() {
  return {Vector(1.5, -2.0, 0.25), Eigen::Quaterniond(std::sqrt(0.5), 0, 0, std::sqrt(0.5))};
}

Recording Read(std::string_view format, std::string_view name, const ImportOptions& options = {}) {
  return ReadRecording(*FindImportFormat(format), ImportPath(name), options);
}

// Errors of a good file with something replaced.
struct Spoilt {
  std::string_view format;
  std::string good;
  std::string operator()(std::string_view from, std::string_view to) const {
    return ImportError(format, Replaced(good, from, to));
  }
};

TEST(FirstPrinciples, ReadsMarkersAndEmptyCells) {
  const Recording read = Read("first_principles", "first_principles.tsv");
  ASSERT_EQ(read.rows, 3u);
  ASSERT_EQ(read.markers.size(), 2u);
  EXPECT_EQ(read.markers[1].name, "Beam2");
  EXPECT_TRUE(MatrixNear(
      *read.markers[0].points[0], Vector(0.48661895752, -0.560735656738, -2.618344970703), kExact));
  EXPECT_THAT(read.frames, ElementsAre(1, 2, 3));
  EXPECT_FALSE(read.markers[1].points[1]);
  EXPECT_TRUE(read.markers[1].points[2]);
  EXPECT_THAT(read.times, ElementsAre(20000000, 40000000, 60000000));
  std::string commas = ImportText("first_principles.tsv");
  std::replace(commas.begin(), commas.end(), '\t', ',');
  EXPECT_EQ(testing::ReadImportText("first_principles", commas).markers[0].points,
            read.markers[0].points);
}

TEST(FirstPrinciples, RefusesWhatItIsNot) {
  const Spoilt error{"first_principles", ImportText("first_principles.tsv")};
  EXPECT_THAT(error("frames: 3", "frames: 4"), StartsWith("in: found 3 rows, expected 4"));
  EXPECT_THAT(error("Units: mm", "Units: inch"),
              StartsWith("in:3: found 'inch', expected the units"));
  EXPECT_THAT(error("Frequency: 50", "Frequency: 0"), StartsWith("in:2: found '0'"));
  EXPECT_THAT(error("Frequency: 50\n", ""), HasSubstr("found no 'Frequency'"));
  EXPECT_THAT(error("Beam1 y", "Beam1 q0"), StartsWith("in:5:15: found the column 'Beam1 q0'"));
  EXPECT_THAT(error("Beam1 y\t", ""), HasSubstr("5 columns beside 'Frame'"));
  EXPECT_THAT(error("Beam1 y\t", ""), HasSubstr("column map"));
  EXPECT_THAT(error("\t349.1\t1.25", "\t349.1"), StartsWith("in:8:24: found 2 of 3"));
  EXPECT_THAT(error("\t349.1\t", "\t\t"), StartsWith("in:8:24: found 2 of 3 coordinates"));
  EXPECT_THAT(error("\t349.1\t", "\t1e999\t"), HasSubstr("found '1e999'"));
  EXPECT_THAT(error("Number of", "Some"), StartsWith("in:5: found no 'Number of frames'"));
}

TEST(Rig, ReadsMarkersInMetres) {
  const StatedShape shape = ReadStatedShape(ImportPath("body.rig"));
  EXPECT_THAT(shape.names, ElementsAre("1", "2", "3", "4"));
  Eigen::Matrix3Xd expected(3, 4);
  expected << 0, 0, 0, 0, 0, 0.02859, 0, -0.04432, 0, 0.04102, 0.088, 0.04045;
  EXPECT_TRUE(MatrixNear(shape.points, expected, kExact));
}

TEST(Rig, RefusesWhatItIsNot) {
  const std::string good = ImportText("body.rig");
  const TemporaryFolder folder;
  const auto error = [&](std::string_view from, std::string_view to) {
    const std::string path = folder.Write("in", Replaced(good, from, to));
    return Replaced(InputErrorText([&] { ReadRig(path); }), folder.Path(""), "");
  };
  EXPECT_THAT(error("Marker Description", "Markers"), StartsWith("in:1: found 'Markers File'"));
  EXPECT_THAT(error("Real 3D", "Real 2D"), StartsWith("in:3: found 'Real 2D'"));
  EXPECT_THAT(error("4     ;", "2     ;"), HasSubstr("a number of markers, 3 to 256"));
  EXPECT_THAT(error("4     ;", "1000000000 ;"), HasSubstr("a number of markers, 3 to 256"));
  EXPECT_THAT(error("4     ;", "7     ;"), StartsWith("in:13: found"));
  EXPECT_THAT(error("28.590000", "x"), StartsWith("in:9:34: found 'x'"));
  EXPECT_THAT(error("3                   0", "2                   0"), HasSubstr("a second time"));
  const std::string cut = folder.Write("cut", good.substr(0, 300));
  EXPECT_THAT(InputErrorText([&] { ReadRig(cut); }), HasSubstr("cut"));
}

// A tool definition as docs/formats.md describes it, with the markers of body.rig.
std::string RomBytes() {
  std::string bytes(752, '\0');
  const auto put = [&bytes](std::size_t at, auto value) {
    std::memcpy(&bytes[at], &value, sizeof value);
  };
  std::memcpy(&bytes[0], "NDI", 3);
  put(0x18, std::uint32_t{90});
  put(0x1C, std::uint32_t{4});
  put(0x20, std::uint32_t{3});
  put(0x24, 0.75f);
  const float markers[] = {0, 0, 0, 0, 28.59f, 41.02f, 0, 0, 88, 0, -44.32f, 40.45f};
  std::memcpy(&bytes[0x48], markers, sizeof markers);
  return bytes;
}

std::string WithChecksum(std::string bytes) {
  std::uint32_t sum = 0;
  for (std::size_t i = 6; i < bytes.size(); ++i) sum += static_cast<unsigned char>(bytes[i]);
  bytes[4] = static_cast<char>(sum & 0xFF);
  bytes[5] = static_cast<char>(sum >> 8 & 0xFF);
  return bytes;
}

TEST(Rom, ReadsMarkersInMetres) {
  const TemporaryFolder folder;
  const StatedShape shape = ReadStatedShape(folder.Write("t.rom", WithChecksum(RomBytes())));
  EXPECT_TRUE(MatrixNear(shape.points, ReadStatedShape(ImportPath("body.rig")).points, 1e-8));
}

TEST(Rom, RefusesDamage) {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& bytes) {
    const std::string path = folder.Write("in", bytes);
    return Replaced(InputErrorText([&] { ReadRom(path); }), folder.Path(""), "");
  };
  const std::string good = WithChecksum(RomBytes());
  for (std::size_t at = 6; at < good.size(); at += 31) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] + 1);
    EXPECT_THAT(error(bad), HasSubstr("found a checksum")) << at;
  }
  EXPECT_THAT(error(good.substr(0, 700)), StartsWith("in: found 700 bytes, expected 752"));
  EXPECT_THAT(error("NDX" + good.substr(3)), StartsWith("in: found no 'NDI'"));
  std::string many = RomBytes();
  many[0x1D] = 1;
  EXPECT_THAT(error(WithChecksum(many)), StartsWith("in: found 260 markers, expected 3 to 20"));
  std::string far = RomBytes();
  const float nan = std::nanf("");
  std::memcpy(&far[0x48], &nan, sizeof nan);
  EXPECT_THAT(error(WithChecksum(far)), HasSubstr("as a coordinate of marker 1"));
}

TEST(Motive, ReadsBodiesAndTheirMarkers) {
  const Recording read = Read("motive", "motive.csv");
  ASSERT_EQ(read.rows, 2u);
  ASSERT_EQ(read.bodies.size(), 1u);
  EXPECT_EQ(read.bodies[0].name, "A");
  // The measured marker, not the one that is expected.
  EXPECT_THAT(read.bodies[0].markers, ElementsAre(0));
  ASSERT_EQ(read.markers.size(), 2u);
  EXPECT_TRUE(MatrixNear(*read.markers[0].points[0], Vector(0.496063, 0.516091, 2.854694), kExact));
  EXPECT_FALSE(read.markers[1].points[1]);
  // Scalar last.
  EXPECT_TRUE(PoseNear(
      *read.bodies[0].poses[0], {Vector(0.01, 0.02, 0.03), Quarter().rotation}, kExact, kDigits));
  EXPECT_FALSE(read.bodies[0].poses[1]);
  EXPECT_THAT(read.times, ElementsAre(0, 8333000));
  EXPECT_THAT(read.frames, ElementsAre(0, 1));
  EXPECT_THAT(read.warnings, Contains(HasSubstr("1 rigid body markers are not used")));
}

TEST(Motive, RefusesWhatItIsNot) {
  const Spoilt error{"motive", ImportText("motive.csv")};
  EXPECT_THAT(error("Millimeters", "Inches"), HasSubstr("found length units 'inches'"));
  EXPECT_THAT(error("Quaternion", "XYZ"), HasSubstr("export rotations so"));
  EXPECT_THAT(error("Global", "Local"), HasSubstr("export coordinates so"));
  EXPECT_THAT(error("Length Units", "Units"), HasSubstr("no 'Length Units'"));
  EXPECT_THAT(error(",Type,", ",Kind,"), HasSubstr("no a line ',Type,...'"));
  EXPECT_THAT(error("Frame,Time", "Row,Time"), HasSubstr("no a line 'Frame,Time...'"));
  EXPECT_THAT(error("X,Y,Z,W", "W,X,Y,Z"),
              HasSubstr("found the axes 'wxyz' of the rotation of 'A'"));
  EXPECT_THAT(error("0.70710678,0.70710678", "0.70710678,0.8"),
              HasSubstr("in:8:12: found the quaternion"));
  EXPECT_THAT(error(",1,2,3\n", ",1,2\n"), StartsWith("in:8: found 19 cells, expected 20"));
  EXPECT_THAT(error("0.008333", "later"), StartsWith("in:9:3: found 'later', expected a time"));
}

TEST(Trajectories, ReadTumAndEuroc) {
  for (const auto& [format, name, first, last] :
       {std::tuple("tum", "trajectory.tum", 1305031102175304000, 1305031102211214000),
        std::tuple("euroc", "trajectory.euroc.csv", 1403636580838555648, 1403636580843555328)}) {
    const Recording read = Read(format, name);
    ASSERT_EQ(read.rows, 2u) << name;
    EXPECT_TRUE(PoseNear(*read.bodies[0].poses[0], Quarter(), kExact, kDigits)) << name;
    EXPECT_THAT(read.times, ElementsAre(first, last));
  }
}

TEST(Trajectories, ATumFileIsKnownByItsFirstRow) {
  const TemporaryFolder folder;
  const auto recognised = [&](const std::string& text) {
    const ImportFormat* format = RecogniseFormat(folder.Write("in", text));
    return format == nullptr ? "" : std::string(format->name);
  };
  EXPECT_EQ(recognised(ImportText("trajectory.tum")), "tum");
  EXPECT_EQ(recognised("# seconds\r\n\r\n 0\t1 2 3  0 0 0 1 \r\n"), "tum");
  EXPECT_EQ(recognised("\xEF\xBB\xBF"
                       "0 1 2 3 0 0.6 0.8 0"),
            "tum");
  for (const char* other : {"",
                            "# nothing\n",
                            "0 1 2 3 0 0 0 1 0\n",
                            "0 1 2 3 0 0 1\n",
                            "0 1 2 3 0 0 0.9 0\n",
                            "0,1,2,3,0,0,0,1\n",
                            "a 1 2 3 0 0 0 1\n"})
    EXPECT_EQ(recognised(other), "") << other;
}

TEST(Trajectories, RefuseWhatTheyAreNot) {
  const Spoilt tum{"tum", ImportText("trajectory.tum")};
  EXPECT_THAT(tum(" 0.25 ", " "), StartsWith("in:2: found 7 cells, expected 8"));
  EXPECT_THAT(tum("0.25", "0,25"), StartsWith("in:2:26: found '0,25'"));
  EXPECT_THAT(tum("0.70710678\n", "0.9\n"), StartsWith("in:2:31: found the quaternion"));
  EXPECT_THAT(tum("1305031102.175304", "yesterday"), HasSubstr("expected a time in seconds"));
  EXPECT_THAT(ImportError("tum", "# nothing\n"), HasSubstr("found no rows"));
  const Spoilt euroc{"euroc", ImportText("trajectory.euroc.csv")};
  EXPECT_THAT(euroc("#timestamp", "timestamp"), StartsWith("in:1: found 'timestamp"));
  EXPECT_THAT(euroc("838555648,", "838555648.5,"), HasSubstr("whole nanoseconds"));
  EXPECT_THAT(euroc("1403636580843555328", "9223372036854775807"), HasSubstr("whole nanoseconds"));
  EXPECT_THAT(euroc(",0.2\n", "\n"), StartsWith("in:3: found 8 cells, expected 9"));
  EXPECT_THAT(ImportError("euroc", tum.good), StartsWith("in:2: found"));
}

TEST(IndustrialCalibration, ReadsTheFilesOfAList) {
  const Recording read = Read("industrial_calibration", "industrial/list.yaml");
  ASSERT_EQ(read.rows, 2u);
  EXPECT_THAT(read.labels, ElementsAre("poses/0.yaml", "poses/1.yaml"));
  EXPECT_TRUE(PoseNear(*read.bodies[0].poses[0], Quarter(), kExact, kDigits));
}

TEST(IndustrialCalibration, RefusesPathsThatLeadOut) {
  const TemporaryFolder folder;
  folder.Write("outside.yaml", ImportText("industrial/poses/0.yaml"));
  std::filesystem::create_directory(folder.Path("in"));
  std::filesystem::create_symlink(folder.Path("outside.yaml"), folder.Path("in/link.yaml"));
  for (const std::string& path :
       {std::string("../outside.yaml"), folder.Path("outside.yaml"), std::string("link.yaml")}) {
    const std::string list = folder.Write("in/list.yaml", "data:\n  - pose: " + path + "\n");
    EXPECT_THAT(InputErrorText([&] { ReadIndustrialCalibration(list, {}); }),
                HasSubstr("expected a file in the folder of the list"))
        << path;
  }
  EXPECT_THAT(ImportError("industrial_calibration", "data: []\n"), HasSubstr("an empty list"));
  EXPECT_THAT(ImportError("industrial_calibration", "data:\n- {pose: absent.yaml}\n"),
              StartsWith("in:2:10: found no file 'absent.yaml'"));
}

TEST(EasyHandeye, ReadsTheTransformAndItsFrames) {
  const StoredTransform stored = ReadEasyHandeye(ImportPath("easy_handeye.yaml"));
  EXPECT_FALSE(stored.is_tool);
  EXPECT_EQ(stored.parent, "base_link");
  EXPECT_EQ(stored.child, "optical_origin");
  EXPECT_TRUE(PoseNear(stored.parent_from_child, Quarter(), kExact, kDigits));
  const TemporaryFolder folder;
  const std::string on_hand = folder.Write(
      "h.yaml",
      Replaced(ImportText("easy_handeye.yaml"), "eye_on_hand: false", "eye_on_hand: true"));
  EXPECT_EQ(ReadEasyHandeye(on_hand).parent, "tool0");
  const std::string bad =
      folder.Write("b.yaml", Replaced(ImportText("easy_handeye.yaml"), "  x: 1.5\n", ""));
  EXPECT_THAT(InputErrorText([&] { ReadEasyHandeye(bad); }), HasSubstr("found no key 'x'"));
}

// world_from_tool = world_from_base base_from_platform platform_from_tool holds in the first pose,
// with the stored transform in it.
TEST(EasyHandeye, GuessesTheOtherFromTheFirstPose) {
  Dataset dataset;
  const Pose3d base_from_platform{Vector(0.1, 0.2, 0.3), Exp(Vector(0.2, -0.1, 0.4))};
  const Pose3d world_from_tool{Vector(-1, 0.5, 2), Exp(Vector(-0.3, 0.6, 0.1))};
  dataset.robot_poses.rows.push_back({"1", base_from_platform, {}, 0});
  StoredTransform stored{"f.yaml", false, Quarter(), "", ""};
  EXPECT_THAT(InputErrorText([&] { GuessFrom(stored, dataset); }), HasSubstr("--kind=poses"));
  dataset.measurement = Measurement{};
  dataset.measurement->poses.push_back({0, world_from_tool});
  for (const bool is_tool : {false, true}) {
    stored.is_tool = is_tool;
    const InitialGuess guess = GuessFrom(stored, dataset);
    EXPECT_TRUE(PoseNear(guess.world_from_base * base_from_platform * guess.platform_from_tool,
                         world_from_tool,
                         1e-12,
                         1e-12));
    EXPECT_TRUE(PoseNear(is_tool ? guess.platform_from_tool : guess.world_from_base.Inverse(),
                         Quarter(),
                         1e-12,
                         1e-12));
  }
}

ImportOptions LabMap() {
  ImportOptions options;
  options.map = ImportPath("lab.yaml");
  return options;
}

TEST(Columns, ReadAnyTableByAMap) {
  const Recording read = Read("columns", "lab.csv", LabMap());
  ASSERT_EQ(read.rows, 2u);
  EXPECT_THAT(read.labels, ElementsAre("p1", "p2"));
  EXPECT_THAT(read.times, ElementsAre(250000000, 500000000));
  EXPECT_TRUE(PoseNear(*read.bodies[0].poses[0], Quarter(), kExact, kDigits));
  EXPECT_TRUE(PoseNear(*read.bodies[1].poses[0], Quarter(), kExact, kDigits));
  // Ry(90) Rx(90).
  EXPECT_TRUE(
      MatrixNear(read.bodies[1].poses[1]->rotation * Vector(0, 0, 1), Vector(0, -1, 0), kExact));
  EXPECT_TRUE(MatrixNear(*read.markers[0].points[0], Vector(0.0015, 0.0025, 0.0035), kExact));
  EXPECT_FALSE(read.markers[0].points[1]);
  EXPECT_THAT(read.bodies[0].markers, ElementsAre(0));
}

TEST(Columns, ReadMatricesAndNumberedColumns) {
  const TemporaryFolder folder;
  ImportOptions options;
  options.map = folder.Write("m.yaml",
                             "format: hexcal/columns/1\nunits: {length: m, angle: rad}\n"
                             "delimiter: blanks\nheader: false\ncomment: '%'\n"
                             "time: {column: 1, unit: ns}\n"
                             "bodies:\n  a: {position: [11, 12, 13], matrix: [2, 3, 4, 5, 6, 7, 8, "
                             "9, 10]}\n");
  const Recording read = testing::ReadImportText(
      "columns",
      "% of a program\n1403636580838555648 0 -1 0  1 0 0  0 0 1  1.5 -2 0.25\n",
      options);
  EXPECT_TRUE(PoseNear(*read.bodies[0].poses[0], Quarter(), kExact, kExact));
  EXPECT_THAT(read.times, ElementsAre(1403636580838555648));
}

TEST(Columns, RefuseMapsAndTablesThatDoNotFit) {
  EXPECT_THAT(ImportError("columns", ImportText("lab.csv")), HasSubstr("--map=FILE.yaml"));
  const TemporaryFolder folder;
  const std::string good = ImportText("lab.yaml");
  const auto error = [&](std::string_view from, std::string_view to) {
    ImportOptions options;
    options.map = folder.Write("map", Replaced(good, from, to));
    std::string text = ImportError("columns", ImportText("lab.csv"), options);
    const std::string prefix = folder.Path("");
    if (text.rfind(prefix, 0) == 0) text.erase(0, prefix.size());
    return text;
  };
  EXPECT_THAT(error("hexcal/columns/1", "hexcal/columns/2"), StartsWith("map:1:9: found"));
  EXPECT_THAT(error("semicolon", "dot"), HasSubstr("one of comma, semicolon, tab, blanks, bar"));
  EXPECT_THAT(error("semicolon", "comma"), HasSubstr("a decimal comma between commas"));
  EXPECT_THAT(error("skip: 2", "skip: 9"), HasSubstr("9 to skip"));
  EXPECT_THAT(error("[Xa,", "[X,"), StartsWith("map:10:22: found the column 'X', 0 of that name"));
  EXPECT_THAT(error("[3, 4, 5]", "[3, 4, 99]"), HasSubstr("found the column '99'"));
  EXPECT_THAT(error("order: zyx", "order: zyy"), HasSubstr("'zyy'"));
  EXPECT_THAT(error("order: zyx", "matrix: [1]"), HasSubstr("a second rotation"));
  EXPECT_THAT(error("markers: [M1]", "markers: [M2]"), HasSubstr("the marker 'M2' of 'probe'"));
  EXPECT_THAT(error("quaternion", "quaternions"), HasSubstr("quaternion"));
  EXPECT_THAT(error("unit: s", "unit: h"), HasSubstr("one of s, ms, us, ns"));
}

// A file given as one of another format is refused, and where its beginning tells what it is the
// message says so.
TEST(Formats, NoneTakesTheFileOfAnother) {
  const std::vector<std::pair<std::string_view, const char*>> files = {
      {"ndi_csv", "ndi_wide.csv"},
      {"first_principles", "first_principles.tsv"},
      {"motive", "motive.csv"},
      {"tum", "trajectory.tum"},
      {"euroc", "trajectory.euroc.csv"},
      {"pi_gcs", "pi_gcs.dat"},
      {"industrial_calibration", "industrial/list.yaml"},
      {"columns", "lab.csv"},
      {"rig", "body.rig"},
      {"easy_handeye", "easy_handeye.yaml"}};
  for (const auto& [own, file] : files) {
    const ImportFormat* recognised = RecogniseFormat(ImportPath(file));
    if (FindImportFormat(own)->recognise != nullptr) {
      ASSERT_NE(recognised, nullptr) << file;
      EXPECT_EQ(recognised->name, own);
    } else {
      EXPECT_EQ(recognised, nullptr) << file;
    }
    for (const ImportFormat& format : ImportFormats()) {
      if (format.name == own || format.read_recording == nullptr) continue;
      const std::string message =
          InputErrorText([&, path = ImportPath(file)] { ReadRecording(format, path, LabMap()); });
      EXPECT_EQ(message.find("(no exception)"), std::string::npos) << format.name << " " << file;
      EXPECT_EQ(message.find("(another exception"), std::string::npos) << message;
      if (recognised != nullptr && format.recognise != nullptr) {
        EXPECT_THAT(message, HasSubstr(fmt::format("like one of the format {}", own)));
      }
    }
  }
  EXPECT_THAT(InputErrorText([] { ReadStatedShape(ImportPath("lab.csv")); }),
              HasSubstr("found a file of no known kind, expected a marker body: rig, rom"));
  EXPECT_THAT(InputErrorText([] { ReadStatedShape(ImportPath("motive.csv")); }),
              HasSubstr("found a file of the format motive"));
}

// More points than hexcal takes are refused before they fill the memory.
TEST(Formats, HaveALimit) {
  EXPECT_THAT(InputErrorText([] { CheckReadings(1'000'000, 21, FileLocation("f")); }),
              HasSubstr("expected at most 20000000 points and poses"));
  CheckReadings(1'000'000, 20, FileLocation("f"));
}

}  // namespace
}  // namespace hexcal
