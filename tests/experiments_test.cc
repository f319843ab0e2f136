// SPDX-License-Identifier: BSD-3-Clause
// The words for experiments, for every pair of effects of the table.
#include "discovery/experiments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace hexcal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Experiments, EveryPairOfTheTableHasOneThatCanBeDone) {
  for (const EffectKind& one : EffectKinds())
    for (const EffectKind& other : EffectKinds()) {
      if (one.IsFault() || other.IsFault() || one.name == other.name) continue;
      const std::string text = ExperimentFor(std::string(one.name), std::string(other.name));
      EXPECT_GT(text.size(), 20u) << one.name << " or " << other.name;
      // Every effect of the table has its own; what is outside has to do with general advice.
      EXPECT_THAT(text, Not(HasSubstr("all else"))) << one.name << " or " << other.name;
      EXPECT_EQ(text, ExperimentFor(std::string(other.name), std::string(one.name)));
      EXPECT_NE(text.back(), '.');
    }
}

TEST(Experiments, SomeTruths) {
  EXPECT_THAT(ExperimentFor("leg_gain", "base_radius"), HasSubstr("coordinate measuring machine"));
  EXPECT_THAT(ExperimentFor("tool_sag", "leg_compliance"), HasSubstr("several loads"));
  EXPECT_THAT(ExperimentFor("tracker_scale", "leg_gain"), HasSubstr("length bar"));
  EXPECT_THAT(ExperimentFor("leg_thermal", "base_drift"), HasSubstr("temperature"));
  EXPECT_THAT(ExperimentFor("leg_thermal", "plate_thermal"), HasSubstr("warm one part alone"));
  EXPECT_THAT(ExperimentFor("base_drift", "tool_drift"), HasSubstr("reference target"));
  EXPECT_THAT(ExperimentFor("tracker_scale", "tracker_distortion"), HasSubstr("second place"));
  EXPECT_THAT(ExperimentFor("leg_backlash", "latency"), HasSubstr("from both sides"));
  EXPECT_THAT(ExperimentFor("unknown", "an unknown thing"), HasSubstr("all else"));
}

TEST(Experiments, GaugesFollowWhatIsMeasured) {
  Dataset dataset;
  Measurement& measurement = dataset.measurement.emplace();
  const auto rivals = [&](const char* name, const std::vector<int>& index) {
    Effect effect;
    effect.name = name, effect.index = index;
    std::vector<std::string> names;
    for (const Gauge& gauge : GaugesOf(effect, dataset)) names.push_back(gauge.rival);
    return names;
  };
  measurement.kind = Measurement::Kind::kPoses;
  EXPECT_EQ(rivals("tracker_scale", {}).size(), 1u);
  EXPECT_EQ(rivals("base_drift", {}).size(), 1u);
  EXPECT_EQ(rivals("tool_drift", {}).size(), 0u);
  measurement.kind = Measurement::Kind::kMarkers;
  measurement.bodies[0].markers = {"b1", "b2", "b3"};
  measurement.bodies[1].markers = {"t1", "t2", "t3"};
  EXPECT_EQ(rivals("tracker_scale", {}).size(), 0u);
  EXPECT_EQ(rivals("base_drift", {}).size(), 0u);
  EXPECT_EQ(rivals("marker_offset", {4, 5}).size(), 0u);
  EXPECT_EQ(rivals("marker_offset", {1, 4, 5}).size(), 0u);
  EXPECT_EQ(rivals("marker_offset", {4, 5, 6}).size(), 1u);
  EXPECT_EQ(rivals("marker_offset", {1, 2, 3}).size(), 1u);
  dataset.tracker.is_static = true;
  EXPECT_EQ(rivals("base_drift", {}).size(), 1u);
}

}  // namespace
}  // namespace hexcal
