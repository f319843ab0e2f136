// SPDX-License-Identifier: BSD-3-Clause
// Discovery that starts from a model.
#include <gtest/gtest.h>

#include <cmath>

#include "discovery/discover.h"
#include "model/predict.h"

namespace hexcal {
namespace {

const std::string kExample = HEXCAL_EXAMPLES "/hidden-effect/";

DiscoverOptions Quick() {
  DiscoverOptions options;
  options.bootstraps = 99;
  options.folds = 0;
  return options;
}

const Dataset& Data() {
  static const Dataset dataset = ReadDataset(kExample + "dataset.yaml", true);
  return dataset;
}

// Of the two effects that are hidden in the example.
const Discovery& Found() {
  static const Discovery discovery = Discover(Data(), Quick());
  return discovery;
}

Discovery From(const Machine& model) {
  DiscoverOptions options = Quick();
  options.model = model;
  return Discover(Data(), options);
}

Machine Only(const std::string& name) {
  Machine model = Found().machine;
  model.effects.clear();
  for (const Effect& effect : Found().machine.effects)
    if (effect.name == name) model.effects.push_back(effect);
  return model;
}

TEST(DiscoverGiven, FindsNothingWhereTheModelHasItAll) {
  ASSERT_EQ(Found().effects.size(), 2u);
  const Discovery again = From(Found().machine);
  EXPECT_EQ(again.verdict, Verdict::kAgrees);
  EXPECT_TRUE(again.effects.empty());
  ASSERT_EQ(again.given.size(), 2u);
  for (const GivenEffect& given : again.given) {
    EXPECT_EQ(given.judgement->state, GivenState::kConfirmed) << given.now.effect.name;
    EXPECT_LT(given.judgement->p_absent, 1e-6);
    EXPECT_GT(given.judgement->p_unchanged, 0.5);
  }
  // The gap that is left then is where this one starts, and ends.
  const GapSize& left = Found().gap.after;
  EXPECT_NEAR(again.gap.before.rms_position / left.rms_position, 1.0, 0.02);
  EXPECT_NEAR(again.gap.after.rms_position / left.rms_position, 1.0, 0.02);
  EXPECT_NEAR(again.gap.before.chi_square / left.chi_square, 1.0, 0.05);
  // And the machine is the same.
  const std::vector<Pose3d> first = Predict(Found().machine, Data());
  const std::vector<Pose3d> second = Predict(again.machine, Data());
  for (std::size_t i = 0; i < first.size(); ++i)
    EXPECT_LT((first[i].translation - second[i].translation).norm(), 5e-6) << i;
}

TEST(DiscoverGiven, FindsTheOneThatTheModelLacks) {
  for (const auto& [given, hidden] :
       {std::pair("base_drift", "leg_periodic"), std::pair("leg_periodic", "base_drift")}) {
    const Discovery rest = From(Only(given));
    ASSERT_EQ(rest.effects.size(), 1u) << given;
    EXPECT_EQ(rest.effects[0].effect.name, hidden);
    EXPECT_LT(rest.effects[0].p_value, 0.01);
    ASSERT_EQ(rest.given.size(), 1u);
    EXPECT_EQ(rest.given[0].now.effect.name, given);
    EXPECT_EQ(rest.given[0].judgement->state, GivenState::kConfirmed);
    ASSERT_EQ(rest.machine.effects.size(), 2u);
    EXPECT_EQ(rest.machine.effects[0].name, given);
    EXPECT_LT(rest.gap.after.rms_position, rest.gap.before.rms_position);
    EXPECT_LT(rest.gap.before.rms_position, Found().gap.before.rms_position);
    EXPECT_NEAR(rest.gap.after.rms_position / Found().gap.after.rms_position, 1.0, 0.05);
  }
}

// One effect is not there, another is not as large as the model is sure that it is.
TEST(DiscoverGiven, SaysWhichEffectsTheDataContradict) {
  Machine model = Found().machine;
  for (Effect& effect : model.effects)
    if (effect.name == "base_drift") effect.parameters.head<6>() *= 3.0;
  Effect gain;
  gain.name = "leg_gain";
  gain.index = {4};
  gain.parameters = Eigen::VectorXd::Zero(6);
  gain.parameters[3] = 0.002;
  const std::vector<Visit> visits = MakeVisits(Data(), &*Data().hexapod, ReportedPoses(Data()));
  gain.reference = ReferenceFor(*FindEffectKind("leg_gain"), visits, Data());
  model.effects.push_back(gain);
  const Discovery discovery = From(model);
  EXPECT_EQ(discovery.verdict, Verdict::kAgrees);
  ASSERT_EQ(discovery.given.size(), 3u);
  for (const GivenEffect& given : discovery.given) {
    const std::string& name = given.now.effect.name;
    EXPECT_EQ(NameOf(given.judgement->state),
              name == "base_drift" ? "changed"
              : name == "leg_gain" ? "not supported"
                                   : "confirmed")
        << name;
  }
}

}  // namespace
}  // namespace hexcal
