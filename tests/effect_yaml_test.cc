// SPDX-License-Identifier: BSD-3-Clause
#include "model/effect_yaml.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "config/input_error.h"
#include "model/data_fault.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::SeededByTest;

std::vector<Effect> Read(const std::string& text) {
  const YamlNode root = ParseYamlText(text, "model.yaml");
  return ReadEffects(root.entries.at(0).second);
}

std::string MessageOf(const std::string& entry) {
  try {
    Read("effects:\n  - " + entry + "\n");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

bool SameBits(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  if (a.size() != b.size()) return false;
  for (int i = 0; i < a.size(); ++i)
    if (!(a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i])))) return false;
  return true;
}

// Any effect of a kind, its numbers of any size.
Effect AnyEffect(std::mt19937_64& rng, const EffectKind& kind) {
  Effect effect;
  effect.name = std::string(kind.name);
  effect.index = kind.name == "swapped_markers" || kind.site == "marker" ? std::vector<int>{3, 2}
                                                                         : std::vector<int>{1, 6};
  const int size = kind.SizeFor(effect.index);
  effect.parameters = testing::Normal(rng, size) * std::pow(10, testing::Uniform(rng, -9, 3));
  effect.standard_deviation = testing::Normal(rng, size).cwiseAbs();
  if (size > 0) effect.standard_deviation[0] = std::numeric_limits<double>::quiet_NaN();
  for (const ReferenceKind& reference : kind.references) {
    const Eigen::VectorXd numbers = testing::Normal(rng, reference.size);
    effect.reference[std::string(reference.name)] = {numbers.begin(), numbers.end()};
  }
  if (effect.reference.count("markers") > 0) effect.reference["markers"] = {3, 4};
  if (kind.name == "swapped_legs") effect.reference["permutation"] = {1, 3, 2, 4, 5, 6};
  if (kind.name == "shifted_rows") effect.reference["rows"] = {-2};
  if (kind.name == "wrong_unit") effect.reference["factor"] = {M_PI / 180};
  if (kind.name == "wrong_unit") effect.found["of"] = "angles";
  if (kind.name == "wrong_rotation_order") effect.found["order"] = "zyx";
  return effect;
}

TEST(EffectYaml, ReadsBackEveryKindToTheLastBit) {
  std::mt19937_64 rng = SeededByTest();
  for (int draw = 0; draw < 20; ++draw) {
    std::vector<Effect> effects;
    for (const EffectKind& kind : EffectKinds()) effects.push_back(AnyEffect(rng, kind));
    const std::string text = WriteEffects(effects);
    const std::vector<Effect> back = Read(text);
    ASSERT_EQ(back.size(), effects.size());
    for (std::size_t i = 0; i < back.size(); ++i) {
      EXPECT_EQ(back[i].name, effects[i].name);
      EXPECT_EQ(back[i].index, effects[i].index);
      EXPECT_TRUE(SameBits(back[i].parameters, effects[i].parameters)) << back[i].name;
      EXPECT_TRUE(SameBits(back[i].standard_deviation, effects[i].standard_deviation));
      EXPECT_EQ(back[i].reference, effects[i].reference);
      EXPECT_EQ(back[i].found, effects[i].found);
    }
    EXPECT_EQ(WriteEffects(back), text);
  }
}

TEST(EffectYaml, IsWrittenInTheDocumentedForm) {
  Effect gain;
  gain.name = "leg_gain";
  gain.index = {2};
  gain.parameters = Eigen::VectorXd::Zero(6);
  gain.parameters[1] = 1e-4;
  gain.standard_deviation = Eigen::VectorXd::Constant(6, std::nan(""));
  gain.standard_deviation[1] = 2.5e-6;
  gain.reference["home_lengths"] = {0.25, 0.25, 0.25, 0.25, 0.25, 0.25};
  Effect scale;
  scale.name = "tracker_scale";
  scale.parameters = Eigen::VectorXd::Constant(1, -3e-5);
  EXPECT_EQ(WriteEffects({gain, scale}),
            "effects:\n"
            "  - {name: leg_gain, index: [2], parameters: {gain: [0, 0.0001, 0, 0, 0, 0]}, "
            "standard_deviation: {gain: [null, 2.5e-06, null, null, null, null]}, reference: "
            "{home_lengths: [0.25, 0.25, 0.25, 0.25, 0.25, 0.25]}}\n"
            "  - {name: tracker_scale, index: [], parameters: {scale: -3.0e-05}}\n");
  EXPECT_EQ(WriteEffects({}), "effects: []\n");
}

TEST(EffectYaml, OfAnUnknownKeepsItsWords) {
  Effect unknown;
  unknown.name = "unknown";
  unknown.found = {{"driver", "a \"column\" \\ two"}, {"shape", "linear"}};
  const std::vector<Effect> back = Read(WriteEffects({unknown}));
  ASSERT_EQ(back.size(), 1u);
  EXPECT_EQ(back[0].found, unknown.found);
}

TEST(EffectYaml, OfAnUnknownThatCorrectsKeepsItsNumbers) {
  Effect unknown;
  unknown.name = "unknown";
  unknown.parameters = Eigen::VectorXd::LinSpaced(6, 0.1, 0.3);
  unknown.reference = {{"centre", {0.5}}, {"half_range", {0.25}}, {"power", {2}}};
  unknown.found = {{"driver", "temperature"}, {"site", "tool"}};
  const std::vector<Effect> back = Read(WriteEffects({unknown}));
  ASSERT_EQ(back.size(), 1u);
  EXPECT_EQ(back[0].parameters, unknown.parameters);
  EXPECT_EQ(back[0].reference, unknown.reference);
  EXPECT_EQ(back[0].found, unknown.found);
}

struct Mistake {
  const char* entry;
  const char* message;
};

TEST(EffectYaml, RefusesMistakesWhereTheyStand) {
  const Mistake mistakes[] = {
      {"{name: leg_gian}",
       "model.yaml:2:12: found the effect 'leg_gian', expected an effect that "
       "docs/effects.md lists (did you mean 'leg_gain'?)"},
      {"{name: zzzzzzzzzzz}",
       "model.yaml:2:12: found the effect 'zzzzzzzzzzz', expected an effect that docs/effects.md "
       "lists"},
      {"{name: tracker_scale, parameters: {scale: [1, 2]}}",
       "model.yaml:2:47: found a list of 2, expected scale as a number"},
      {"{name: leg_offset, parameters: {offset: [1, 2]}}",
       "model.yaml:2:45: found a list of 2, expected offset as a list of 6 numbers"},
      {"{name: tracker_scale, parameters: {scale: .nan}}", "model.yaml:2:47: "},
      {"{name: tracker_scale, parameters: {scale: null}}", "model.yaml:2:47: "},
      {"{name: tracker_scale, parameters: {skale: 1}}", "model.yaml:2:40: "},
      {"{name: tracker_scale}", "model.yaml:2:5: "},
      {"{name: leg_offset, index: [7], parameters: {offset: [1, 2, 3, 4, 5, 6]}}",
       "model.yaml:2:32: found the number 7, expected different legs, 1 to 6"},
      {"{name: leg_offset, index: [2, 2], parameters: {offset: [1, 2, 3, 4, 5, 6]}}",
       "model.yaml:2:35: found the number 2, expected different legs, 1 to 6"},
      {"{name: leg_thermal, parameters: {expansion: 1e-5}}", "model.yaml:2:5: "},
      {"{name: marker_offset, index: [9], parameters: {offset: [1, 2, 3]}, reference: {markers: "
       "[4, 4]}}",
       "model.yaml:2:5: found marker 9, expected 1 to 8"},
      {"{name: swapped_legs, reference: {permutation: [1, 1, 3, 4, 5, 6]}}",
       "model.yaml:2:5: found a permutation without each leg once, expected the numbers 1 to 6"},
      {"{name: shifted_rows, reference: {rows: 0.5}}",
       "model.yaml:2:5: found a shift by 0.5 rows, expected a whole number"},
      {"{name: wrong_rotation_order, found: {order: zxx}}",
       "model.yaml:2:5: found the word 'zxx', expected found: with order: xyz xzy yxz yzx zxy zyx"},
      {"{name: unknown, parameters: {coefficients: [1, 2, 3, 4, 5, 6]}, found: {site: roof}}",
       "model.yaml:2:5: found an unknown effect with coefficients that does not say of what"},
      {"{name: swapped_markers, index: [1]}",
       "model.yaml:2:36: found 1 markers, expected two that are swapped"},
  };
  for (const Mistake& mistake : mistakes) {
    const std::string message = MessageOf(mistake.entry);
    EXPECT_EQ(message.find(mistake.message), 0u) << mistake.entry << "\n" << message;
  }
}

}  // namespace
}  // namespace hexcal
