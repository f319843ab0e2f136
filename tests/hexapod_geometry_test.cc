// SPDX-License-Identifier: BSD-3-Clause
// Not covered: the messages for a mapping that is refused (tests/bad_datasets/).
#include "measurement/hexapod_geometry.h"

#include <gtest/gtest.h>

#include "geometry/rotation_angles.h"
#include "testing/bits.h"
#include "testing/hexapods.h"
#include "testing/input_error_text.h"
#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::InputErrorText;
using testing::MatrixNear;
using testing::PoseNear;
using testing::SameBits;
using testing::SeededByTest;

const Units kMillimetresAndDegrees = {1e-3, kPi / 180};
const std::string kJoints =
    "base_joints: [[100, 0, 0], [0, 100, 0], [0, 0, 100], [-100, 0, 0], [0, -100, 0], [1, 2, 3]]\n"
    "platform_joints: [[50, 0, 0], [0, 50, 0], [0, 0, 50], [-50, 0, 0], [0, -50, 0], [4, 5, 6]]\n";

HexapodGeometry Read(const std::string& text, const Units& units = {}) {
  return ReadHexapodGeometry(ParseYamlText(text, "h.yaml"), units);
}

Pose3d ReadPoseText(const std::string& text, const Units& units = {}) {
  return ReadPose(ParseYamlText(text, "p.yaml"), units, "pose");
}

// Written under a key and with an indent, as in a file.
HexapodGeometry WriteAndRead(const HexapodGeometry& hexapod) {
  const YamlNode root =
      ParseYamlText("hexapod:\n" + WriteHexapodGeometry(hexapod, "    "), "w.yaml");
  return ReadHexapodGeometry(root.entries.at(0).second, Units{});
}

Matrix36d RandomDirections(std::mt19937_64& rng) {
  Matrix36d axes;
  for (int i = 0; i < kNumLegs; ++i) axes.col(i) = testing::Normal(rng, 3).normalized();
  return axes;
}

TEST(HexapodGeometry, ReadsJointsByLegInTheGivenUnit) {
  const HexapodGeometry hexapod = Read(kJoints, kMillimetresAndDegrees);
  EXPECT_TRUE(
      MatrixNear(hexapod.base_joints_in_base.col(5), Eigen::Vector3d(0.001, 0.002, 0.003), 1e-18));
  EXPECT_TRUE(
      MatrixNear(hexapod.platform_joints_in_platform.col(0), Eigen::Vector3d(0.05, 0, 0), 1e-18));
  EXPECT_FALSE(hexapod.base_axes_in_base);
  EXPECT_FALSE(hexapod.platform_axes_in_platform);
  EXPECT_FALSE(hexapod.leg_limits);
  EXPECT_FALSE(hexapod.home);
}

TEST(HexapodGeometry, ReadsWhatIsOptional) {
  const HexapodGeometry hexapod =
      Read(kJoints +
               "base_axes: [[0, 3, 4], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 0], [-2, 0, 0]]\n"
               "platform_axes: [[0, 0, 1e-300], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 0], "
               "[1e300, 0, 1e300]]\n"
               "leg_limits: [100, 200]\n"
               "home: [1, 2, 3, 90, 0, 90]\n",
           kMillimetresAndDegrees);
  // Directions have no unit; their length does not matter.
  EXPECT_TRUE(MatrixNear(hexapod.base_axes_in_base->col(0), Eigen::Vector3d(0, 0.6, 0.8), 1e-15));
  EXPECT_TRUE(MatrixNear(hexapod.base_axes_in_base->col(5), Eigen::Vector3d(-1, 0, 0), 1e-15));
  const Matrix36d& platform_axes = *hexapod.platform_axes_in_platform;
  EXPECT_TRUE(MatrixNear(platform_axes.col(0), Eigen::Vector3d(0, 0, 1), 1e-15));
  const double half = std::sqrt(0.5);
  EXPECT_TRUE(MatrixNear(platform_axes.col(5), Eigen::Vector3d(half, 0, half), 1e-15));
  EXPECT_TRUE(MatrixNear(*hexapod.leg_limits, Eigen::Vector2d(0.1, 0.2), 1e-16));
  // Rx(90 deg) Rz(90 deg) by hand: (1 + i)(1 + k)/2 = (1 + i - j + k)/2.
  const Pose3d expected = {{0.001, 0.002, 0.003}, Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5)};
  EXPECT_TRUE(PoseNear(*hexapod.home, expected, 1e-15, 1e-15));
}

TEST(HexapodGeometry, ReadsBackWhatItWroteToTheLastBit) {
  std::mt19937_64 rng = SeededByTest();
  for (int repeat = 0; repeat < 200; ++repeat) {
    HexapodGeometry hexapod;
    hexapod.base_joints_in_base.setRandom();
    hexapod.platform_joints_in_platform = Matrix36d::Random() * 1e-4;
    hexapod.base_axes_in_base = RandomDirections(rng);
    hexapod.platform_axes_in_platform = RandomDirections(rng);
    hexapod.leg_limits = Eigen::Vector2d(0.1, 0.1 + testing::Uniform(rng, 0.01, 1.0));
    hexapod.home = testing::RandomPose(rng, 1.0);
    const HexapodGeometry read = WriteAndRead(hexapod);
    ASSERT_TRUE(SameBits(read.base_joints_in_base, hexapod.base_joints_in_base));
    ASSERT_TRUE(SameBits(read.platform_joints_in_platform, hexapod.platform_joints_in_platform));
    ASSERT_TRUE(SameBits(*read.base_axes_in_base, *hexapod.base_axes_in_base));
    ASSERT_TRUE(SameBits(*read.platform_axes_in_platform, *hexapod.platform_axes_in_platform));
    ASSERT_TRUE(SameBits(*read.leg_limits, *hexapod.leg_limits));
    ASSERT_TRUE(SameBits(*read.home, *hexapod.home));
  }
}

TEST(HexapodGeometry, WritesHomeAsSixNumbersWhereTheyAreExact) {
  HexapodGeometry hexapod = testing::SmallHexapod();
  hexapod.home = Pose3d{{0, 0, 0.21}, Eigen::Quaterniond::Identity()};
  EXPECT_NE(WriteHexapodGeometry(hexapod, "  ").find("  home: [0, 0, 0.21, 0, 0, 0]\n"),
            std::string::npos);
  EXPECT_TRUE(SameBits(*WriteAndRead(hexapod).home, *hexapod.home));
}

TEST(HexapodGeometry, WritesTheSixNumbersOfHomeAsTheyWereRead) {
  std::mt19937_64 rng = SeededByTest();
  HexapodGeometry hexapod = Read(kJoints + "home: [0.01, -0.02, 0.5, 0.1, -0.2, 0.3]\n");
  const std::string line = "home: [0.01, -0.02, 0.5, 0.1, -0.2, 0.3]\n";
  EXPECT_NE(WriteHexapodGeometry(hexapod, "").find(line), std::string::npos);
  EXPECT_TRUE(SameBits(*WriteAndRead(hexapod).home, *hexapod.home));
  // They are of no use once home is another.
  hexapod.home = testing::RandomPose(rng, 1.0);
  EXPECT_EQ(WriteHexapodGeometry(hexapod, "").find(line), std::string::npos);
  EXPECT_TRUE(SameBits(*WriteAndRead(hexapod).home, *hexapod.home));
}

TEST(HexapodGeometry, WritesOnlyWhatIsThereAndIndentsEveryLine) {
  const std::string text = WriteHexapodGeometry(testing::SmallHexapod(), "     ");
  EXPECT_EQ(text.find("axes"), std::string::npos);
  EXPECT_EQ(text.find("leg_limits"), std::string::npos);
  EXPECT_EQ(text.find("home"), std::string::npos);
  EXPECT_EQ(text.back(), '\n');
  for (std::size_t line = 0; line < text.size(); line = text.find('\n', line) + 1)
    EXPECT_EQ(text.substr(line, 5), "     ");
}

TEST(HexapodGeometry, TakesJointsOfOnePlateThatCoincideInPairs) {
  // An octahedral hexapod: three joints a plate, two legs each, no two legs alike.
  const std::string text =
      "base_joints: [[1, 0, 0], [1, 0, 0], [0, 1, 0], [0, 1, 0], [-1, -1, 0], [-1, -1, 0]]\n"
      "platform_joints: [[1, 1, 0], [-1, 1, 0], [-1, 1, 0], [-1, -1, 0], [-1, -1, 0], [1, 1, 0]]\n";
  EXPECT_NO_THROW(Read(text));
}

TEST(ReadPose, TakesAQuaternionOrAngles) {
  const Pose3d expected = {{0.001, 0.002, 0.003}, Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5)};
  EXPECT_TRUE(PoseNear(ReadPoseText("{xyz: [1, 2, 3], rpy: [90, 0, 90]}", kMillimetresAndDegrees),
                       expected,
                       1e-15,
                       1e-15));
  EXPECT_TRUE(SameBits(ReadPoseText("{xyz: [0.001, 0.002, 0.003], quaternion: [0.5, 0.5, -0.5, "
                                    "0.5]}"),
                       expected));
}

TEST(ReadPose, NormalisesAQuaternionThatIsNearlyUnitAndRefusesOthers) {
  const Pose3d pose = ReadPoseText("{xyz: [0, 0, 0], quaternion: [1.0009, 0, 0, 0]}");
  EXPECT_TRUE(SameBits(pose.rotation.w(), 1.0));
  EXPECT_NE(InputErrorText([] { ReadPoseText("{xyz: [0, 0, 0], quaternion: [1.0011, 0, 0, 0]}"); }),
            "(no exception)");
  EXPECT_NE(InputErrorText([] { ReadPoseText("{xyz: [0, 0, 0], quaternion: [0.9989, 0, 0, 0]}"); }),
            "(no exception)");
}

TEST(WritePose, IsReadBackToTheLastBit) {
  std::mt19937_64 rng = SeededByTest();
  for (int repeat = 0; repeat < 1000; ++repeat) {
    const Pose3d pose = testing::RandomPose(rng, 10.0);
    ASSERT_TRUE(SameBits(ReadPoseText(WritePose(pose)), pose));
  }
}

}  // namespace
}  // namespace hexcal
