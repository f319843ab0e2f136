// SPDX-License-Identifier: BSD-3-Clause
#include "model/machine.h"

#include <cmath>

#include "config/atomic_file.h"
#include "config/input_error.h"
#include "testing/hexapods.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::RandomPose;
using testing::SeededByTest;

std::string Path() {
  const std::string test = ::testing::UnitTest::GetInstance()->current_test_info()->name();
  return ::testing::TempDir() + "machine_test_" + test + ".yaml";
}

Machine Read(const std::string& text) {
  WriteFileAtomically(Path(), text);
  return ReadMachine(Path());
}

// The message behind the file's name.
std::string MessageOf(const std::string& text) {
  try {
    Read(text);
  } catch (const InputError& error) {
    return std::string(error.what()).substr(Path().size());
  }
  return "no InputError";
}

constexpr const char* kPlain =
    "format: hexcal/model/1\n"
    "dataset: paper\n"
    "world_from_base:    {xyz: [1, 2, 3], quaternion: [1, 0, 0, 0]}\n"
    "platform_from_tool: {xyz: [4, 5, 6], quaternion: [0, 1, 0, 0]}\n";

bool SameBits(const Pose3d& a, const Pose3d& b) {
  return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
}

template <typename T>
bool SameBits(const std::optional<T>& a, const std::optional<T>& b) {
  return a.has_value() == b.has_value() && (!a || *a == *b);
}

bool SameBits(const HexapodGeometry& a, const HexapodGeometry& b) {
  return a.base_joints_in_base == b.base_joints_in_base &&
         a.platform_joints_in_platform == b.platform_joints_in_platform &&
         SameBits(a.base_axes_in_base, b.base_axes_in_base) &&
         SameBits(a.platform_axes_in_platform, b.platform_axes_in_platform) &&
         SameBits(a.leg_limits, b.leg_limits) && a.home.has_value() == b.home.has_value() &&
         (!a.home || SameBits(*a.home, *b.home));
}

// A quaternion as arithmetic leaves it: unit to an ulp or two of its squared norm.
template <typename Rng>
Eigen::Quaterniond Jittered(Rng& rng, Eigen::Quaterniond q) {
  for (double& coefficient : q.coeffs())
    coefficient = std::nextafter(coefficient, testing::Uniform(rng, -2.0, 2.0));
  return q;
}

template <typename Rng>
Pose3d JitteredPose(Rng& rng) {
  // Magnitudes from nanometres to kilometres.
  Pose3d pose = RandomPose(rng, std::pow(10.0, testing::Uniform(rng, -9.0, 3.0)));
  pose.rotation = Jittered(rng, pose.rotation);
  return pose;
}

template <typename Rng>
Matrix36d RandomAxes(Rng& rng) {
  Matrix36d axes;
  for (int i = 0; i < kNumLegs; ++i) axes.col(i) = testing::Normal(rng, 3).normalized();
  return axes;
}

template <typename Rng>
HexapodGeometry RandomHexapod(Rng& rng) {
  HexapodGeometry hexapod = testing::LargeHexapod();
  for (int i = 0; i < kNumLegs; ++i) {
    hexapod.base_joints_in_base.col(i) += testing::UniformVector(rng, 0.05);
    hexapod.platform_joints_in_platform.col(i) += testing::UniformVector(rng, 0.05);
  }
  if (testing::Uniform(rng, 0, 1) < 0.5) hexapod.base_axes_in_base = RandomAxes(rng);
  if (testing::Uniform(rng, 0, 1) < 0.5) hexapod.platform_axes_in_platform = RandomAxes(rng);
  if (testing::Uniform(rng, 0, 1) < 0.5)
    hexapod.leg_limits = Eigen::Vector2d(0.1, 0.2) * testing::Uniform(rng, 1, 5);
  if (testing::Uniform(rng, 0, 1) < 0.5) hexapod.home = JitteredPose(rng);
  return hexapod;
}

TEST(Machine, ReadsBackWhatWasWrittenToTheLastBit) {
  std::mt19937_64 rng = SeededByTest();
  for (int i = 0; i < 500; ++i) {
    Machine machine;
    machine.dataset = "neurobot-60";
    machine.world_from_base = JitteredPose(rng);
    machine.platform_from_tool = JitteredPose(rng);
    if (i % 2 == 0) machine.world_from_tracker = JitteredPose(rng);
    if (i % 3 != 0) machine.hexapod = RandomHexapod(rng);
    const std::string text = WriteMachine(machine);
    const Machine back = Read(text);
    EXPECT_EQ(back.dataset, machine.dataset);
    EXPECT_TRUE(SameBits(back.world_from_base, machine.world_from_base)) << text;
    EXPECT_TRUE(SameBits(back.platform_from_tool, machine.platform_from_tool)) << text;
    ASSERT_EQ(back.world_from_tracker.has_value(), machine.world_from_tracker.has_value());
    if (machine.world_from_tracker) {
      EXPECT_TRUE(SameBits(*back.world_from_tracker, *machine.world_from_tracker)) << text;
    }
    ASSERT_EQ(back.hexapod.has_value(), machine.hexapod.has_value());
    if (machine.hexapod) {
      EXPECT_TRUE(SameBits(*back.hexapod, *machine.hexapod)) << text;
    }
    EXPECT_EQ(WriteMachine(back), text);
  }
}

TEST(Machine, ReadsTheDocumentedForm) {
  const Machine machine = Read(kPlain);
  EXPECT_EQ(machine.dataset, "paper");
  EXPECT_EQ(machine.world_from_base.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(machine.platform_from_tool.translation, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(machine.platform_from_tool.rotation.x(), 1.0);
  EXPECT_FALSE(machine.world_from_tracker);
  EXPECT_FALSE(machine.hexapod);
}

TEST(Machine, IsWrittenInTheDocumentedForm) {
  Machine machine;
  machine.dataset = "paper";
  machine.world_from_base.translation << 1, 2.5, -3e-7;
  EXPECT_EQ(WriteMachine(machine),
            "format: hexcal/model/1\n"
            "dataset: \"paper\"\n"
            "world_from_base: {xyz: [1, 2.5, -3.0e-07], quaternion: [1, 0, 0, 0]}\n"
            "platform_from_tool: {xyz: [0, 0, 0], quaternion: [1, 0, 0, 0]}\n"
            "effects: []\n");
}

TEST(Machine, OfADatasetWithANameLikeANumberOrNothingReadsBack) {
  for (const char* name : {"1", "null", "true", "1e5", "-"}) {
    Machine machine;
    machine.dataset = name;
    EXPECT_EQ(Read(WriteMachine(machine)).dataset, name);
  }
}

TEST(Machine, MayHaveAnEmptyListOfEffects) {
  EXPECT_EQ(Read(std::string(kPlain) + "effects: []\n").dataset, "paper");
}

TEST(Machine, ReadsBackItsEffectsAndItsPoseMap) {
  std::mt19937_64 rng = SeededByTest();
  Machine machine;
  machine.dataset = "grown";
  Effect effect;
  effect.name = "tracker_scale";
  effect.parameters = 1e-4 * testing::Normal(rng, 1);
  effect.standard_deviation = 1e-5 * testing::Normal(rng, 1).cwiseAbs();
  machine.effects = {effect};
  PoseMap map;
  map.degree = 2;
  map.reference = JitteredPose(rng);
  map.centre = testing::Normal(rng, 6);
  map.half_width = testing::Normal(rng, 6).cwiseAbs();
  map.coefficients =
      Eigen::Map<const Eigen::MatrixXd>(testing::Normal(rng, 168).eval().data(), 6, 28);
  machine.pose_map = map;
  const std::string text = WriteMachine(machine);
  const Machine back = Read(text);
  ASSERT_EQ(back.effects.size(), 1u);
  EXPECT_EQ(back.effects[0].parameters, effect.parameters);
  ASSERT_TRUE(back.pose_map);
  EXPECT_EQ(back.pose_map->degree, 2);
  EXPECT_TRUE(SameBits(back.pose_map->reference, map.reference));
  EXPECT_EQ(back.pose_map->centre, map.centre);
  EXPECT_EQ(back.pose_map->half_width, map.half_width);
  EXPECT_EQ(back.pose_map->coefficients, map.coefficients);
  EXPECT_EQ(WriteMachine(back), text);
}

TEST(Machine, WithAnEffectThatIsNoneIsRefused) {
  EXPECT_EQ(
      MessageOf(std::string(kPlain) + "effects:\n  - {name: leg_ofset}\n"),
      ":6:12: found the effect 'leg_ofset', expected an effect that docs/effects.md lists (did "
      "you mean 'leg_offset'?)");
}

TEST(Machine, WithAPoseMapThatIsNoneIsRefused) {
  const std::string box =
      "box: {centre: [0, 0, 0, 0, 0, 0], half_width: [1, 1, 1, 1, 1, 1]}, reference: {xyz: [0, 0, "
      "0], quaternion: [1, 0, 0, 0]}";
  EXPECT_NE(MessageOf(std::string(kPlain) + "pose_map: {box: 1}\n").find(":5:"), std::string::npos);
  EXPECT_EQ(
      MessageOf(std::string(kPlain) + "pose_map: {degree: 3, coefficients: [], " + box + "}\n"),
      ":5:20: found the degree 3, expected 1 or 2");
  EXPECT_EQ(MessageOf(std::string(kPlain) + "pose_map: {degree: 1, coefficients: [[1, 2]], " + box +
                      "}\n"),
            ":5:37: found a list of 1, expected six lists of coefficients");
}

TEST(Machine, OfAnotherFormatIsRefusedBeforeItsKeys) {
  EXPECT_EQ(MessageOf("format: hexcal/model/2\nnovelty: 1\n"),
            ":1:9: found the format 'hexcal/model/2', expected hexcal/model/1");
}

TEST(Machine, WithAnUnknownKeyIsRefusedWithTheNearestKnownOne) {
  const std::string message = MessageOf(std::string(kPlain) + "world_from_traker: 1\n");
  EXPECT_EQ(message.find(":5:1: "), 0u) << message;
  EXPECT_NE(message.find("world_from_tracker"), std::string::npos) << message;
}

TEST(Machine, WithoutARequiredKeyIsRefused) {
  for (const char* key : {"format", "dataset", "world_from_base", "platform_from_tool"}) {
    std::string text = kPlain;
    const std::size_t line = text.find(key);
    text.erase(line, text.find('\n', line) + 1 - line);
    EXPECT_NE(MessageOf(text).find(key), std::string::npos) << MessageOf(text);
  }
}

TEST(Machine, WithARotationThatIsNoneIsRefused) {
  std::string text = kPlain;
  text.replace(text.find("[1, 0, 0, 0]"), 12, "[1, 0.1, 0, 0]");
  EXPECT_EQ(MessageOf(text).find(":3:"), 0u) << MessageOf(text);
}

TEST(Machine, NeedsADatasetNameThatCanBeOne) {
  std::string text = kPlain;
  text.replace(text.find("paper"), 5, "'a \" b'");
  EXPECT_EQ(MessageOf(text),
            ":2:10: found the text 'a \" b', expected the name of a dataset: letters, digits, '.', "
            "'_' and '-' only");
}

TEST(Machine, ThatIsNotThereIsRefused) {
  EXPECT_THROW(ReadMachine(::testing::TempDir() + "no_such_model.yaml"), InputError);
}

}  // namespace
}  // namespace hexcal
