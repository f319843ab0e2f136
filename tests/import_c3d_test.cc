// SPDX-License-Identifier: BSD-3-Clause
// C3D files, made here byte by byte from their description: two points, two frames.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "testing/import_files.h"
#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::ImportError;
using testing::MatrixNear;
using testing::ReadImportText;
using testing::RefusedOfDamagedFiles;
using ::testing::StartsWith;
using Vector = Eigen::Vector3d;

constexpr std::size_t kBlock = 512;

template <typename Value>
void Put(std::string& bytes, std::size_t at, Value value) {
  std::memcpy(&bytes[at], &value, sizeof value);
}

// name, then what follows the offset to the next record.
std::string Record(char id, const std::string& name, const std::string& rest) {
  std::string record{static_cast<char>(name.size()), id};
  record += name;
  record += static_cast<char>(2 + rest.size());
  record += '\0';
  return record + rest;
}

std::string TextParameter(const std::string& name, char length, const std::string& texts) {
  const char count = static_cast<char>(texts.size() / static_cast<std::size_t>(length));
  return Record(1, name, std::string{-1, 2, length, count} + texts + '\0');
}

std::string CountParameter(const std::string& name, std::uint16_t count) {
  std::string value(2, '\0');
  Put(value, 0, count);
  return Record(1, name, std::string{2, 0} + value + '\0');
}

struct C3dFile {
  float scale = -1.0f;  // below 0: floats
  std::string units = "mm";
  char processor = 84;
  std::uint16_t analog = 1;  // values a frame
  std::string labels = "top  left ";
  std::string more = {};  // parameters of POINT
};

std::string C3dBytes(const C3dFile& file) {
  std::string bytes(2 * kBlock, '\0');
  bytes[0] = 2;
  bytes[1] = 0x50;
  const std::uint16_t words[] = {2, file.analog, 10, 11};
  std::memcpy(&bytes[2], words, sizeof words);
  Put(bytes, 12, file.scale);
  Put(bytes, 16, std::uint16_t{3});
  Put(bytes, 20, 100.0f);
  std::string parameters{1, 0x50, 1, file.processor};
  parameters += Record(-1, "POINT", std::string(1, '\0'));
  parameters += TextParameter("UNITS", 4, file.units + std::string(4 - file.units.size(), ' '));
  parameters += TextParameter("labels", 5, file.labels) + file.more;
  bytes.replace(kBlock, parameters.size(), parameters);
  // x y z residual of each point, then the analog value.
  const double frames[2][9] = {{100, 200, 300, 0, -1, -2, -3, 2, 7},
                               {101, 202, 303, 0, 0, 0, 0, -1, 7}};
  for (const auto& frame : frames) {
    for (const double value : frame) {
      const std::size_t at = bytes.size();
      bytes.resize(at + (file.scale < 0 ? 4 : 2));
      if (file.scale < 0)
        Put(bytes, at, static_cast<float>(value));
      else
        Put(bytes, at, static_cast<std::int16_t>(value));
    }
  }
  return bytes;
}

TEST(C3d, ReadsFloatsAndWholeNumbers) {
  for (const float scale : {-1.0f, 0.5f}) {
    C3dFile file;
    file.scale = scale;
    const double unit = scale < 0 ? 1e-3 : 0.5e-3;
    const Recording read = ReadImportText("c3d", C3dBytes(file));
    ASSERT_EQ(read.rows, 2u);
    ASSERT_EQ(read.markers.size(), 2u);
    EXPECT_EQ(read.markers[0].name, "top");
    EXPECT_EQ(read.markers[1].name, "left");
    EXPECT_TRUE(MatrixNear(*read.markers[0].points[1], unit * Vector(101, 202, 303), 1e-15));
    EXPECT_TRUE(MatrixNear(*read.markers[1].points[0], unit * Vector(-1, -2, -3), 1e-15));
    EXPECT_FALSE(read.markers[1].points[1]);
    EXPECT_THAT(read.times, ElementsAre(100000000, 110000000));
  }
  C3dFile metres;
  metres.units = "m";
  EXPECT_TRUE(MatrixNear(
      *ReadImportText("c3d", C3dBytes(metres)).markers[0].points[0], Vector(100, 200, 300), 1e-12));
}

// Header and parameters both say how many points and frames there are.
TEST(C3d, HoldsTheParametersAgainstTheHeader) {
  C3dFile file;
  file.more = CountParameter("USED", 2) + CountParameter("FRAMES", 2);
  EXPECT_THAT(ReadImportText("c3d", C3dBytes(file)).warnings, ::testing::IsEmpty());
  file.more = CountParameter("USED", 3);
  EXPECT_THAT(ImportError("c3d", C3dBytes(file)),
              StartsWith("in: found at byte 2: 2 points in the header, 3 in POINT:USED"));
  file.more = CountParameter("FRAMES", 65535);  // more than it can say
  EXPECT_THAT(ReadImportText("c3d", C3dBytes(file)).warnings, ::testing::IsEmpty());
  file.more = CountParameter("FRAMES", 5);
  const Recording frames = ReadImportText("c3d", C3dBytes(file));
  EXPECT_EQ(frames.rows, 2u);
  EXPECT_THAT(frames.warnings,
              ElementsAre(HasSubstr("2 frames by its header, where POINT:FRAMES says 5")));
  std::string value(4, '\0');
  Put(value, 0, 4.0f);  // as some programs write it
  file.more = Record(1, "FRAMES", std::string{4, 0} + value + '\0');
  EXPECT_THAT(ReadImportText("c3d", C3dBytes(file)).warnings,
              ElementsAre(HasSubstr("POINT:FRAMES says 4")));
  file = {};
  file.labels = "top  ";
  const Recording labels = ReadImportText("c3d", C3dBytes(file));
  EXPECT_EQ(labels.markers[1].name, "point 2");
  EXPECT_THAT(labels.warnings, ElementsAre(HasSubstr("of which POINT:LABELS names 1; the others")));
}

TEST(C3d, RefusesWhatItIsNot) {
  C3dFile file;
  file.processor = 85;
  EXPECT_THAT(ImportError("c3d", C3dBytes(file)),
              StartsWith("in: found at byte 515: numbers of a DEC"));
  file.processor = 86;
  EXPECT_THAT(ImportError("c3d", C3dBytes(file)), HasSubstr("SGI"));
  file = {};
  file.units = "in";
  EXPECT_THAT(ImportError("c3d", C3dBytes(file)),
              HasSubstr("found POINT:UNITS 'in', expected mm, cm"));
  const std::string good = C3dBytes({});
  EXPECT_THAT(ImportError("c3d", good.substr(0, good.size() - 1)),
              HasSubstr("the end of the file after 1 frames, expected 2"));
  EXPECT_THAT(ImportError("c3d", good.substr(0, 700)), HasSubstr("blocks of parameters"));
  EXPECT_THAT(ImportError("c3d", good.substr(0, 100)), HasSubstr("no C3D header"));
  EXPECT_THAT(ImportError("c3d", ""), HasSubstr("no C3D header"));
  const auto with = [&good](std::size_t at, auto value) {
    std::string bytes = good;
    Put(bytes, at, value);
    return ImportError("c3d", bytes);
  };
  EXPECT_THAT(with(2, std::uint16_t{0}), HasSubstr("no points"));
  EXPECT_THAT(with(2, std::uint16_t{65535}), HasSubstr("the end of the file after 0 frames"));
  EXPECT_THAT(with(6, std::uint16_t{9}), HasSubstr("found"));
  EXPECT_THAT(with(8, std::uint16_t{9}), HasSubstr("frames 10 to 9"));
  EXPECT_THAT(with(12, 0.0f), HasSubstr("the scale 0"));
  EXPECT_THAT(with(16, std::uint16_t{60000}), HasSubstr("expected data in the file"));
  EXPECT_THAT(with(20, std::nanf("")), HasSubstr("the frame rate nan"));
  EXPECT_THAT(with(0, static_cast<unsigned char>(200)), HasSubstr("parameters in block 200"));
  EXPECT_THAT(with(2 * kBlock, HUGE_VALF), HasSubstr("an infinite coordinate"));
}

// Any bytes in header and parameters: read or refused, never more.
TEST(C3d, SurvivesDamage) {
  const std::string good = C3dBytes({});
  EXPECT_GT(RefusedOfDamagedFiles("c3d", good.substr(0, 24), 1), 20);
  EXPECT_GT(RefusedOfDamagedFiles("c3d", good, 37), 10);
  const testing::TemporaryFolder folder;
  std::mt19937_64 random = testing::SeededByTest();
  for (int repeat = 0; repeat < 300; ++repeat) {
    std::string bad = good;
    for (int i = 0; i < 4; ++i) bad[random() % (kBlock + 80)] = static_cast<char>(random());
    for (int i = 0; i < 4; ++i) bad[kBlock + random() % 80] = static_cast<char>(random());
    EXPECT_EQ(testing::ImportErrorIn(folder, "c3d", bad).find("(another exception"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace hexcal
