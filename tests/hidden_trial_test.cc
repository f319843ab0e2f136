// SPDX-License-Identifier: BSD-3-Clause
// How answers are judged and counted, and one small study from end to end.
#include <gtest/gtest.h>

#include <cmath>

#include "hidden/tally.h"
#include "hidden/trial.h"

namespace hexcal::hidden {
namespace {

Trial Hidden(const std::vector<std::string>& truth, const std::vector<Found>& found) {
  Trial trial;
  trial.truth = truth;
  if (!truth.empty()) trial.right = {truth[0]};
  trial.found = found;
  trial.verdict = found.empty() ? "agrees" : "explained";
  return trial;
}

TEST(Trial, JudgesNamesAndClasses) {
  const Found drift = {"base_drift", {}, {"tool_drift"}}, gain = {"leg_gain", {2}, {}};
  const Trial right = Hidden({"base_drift"}, {drift});
  EXPECT_TRUE(right.NamesFirst() && right.ClassIsRight() && right.SetIsExact());
  EXPECT_FALSE(right.AddsWrong());
  const Trial in_class = Hidden({"tool_drift"}, {drift});
  EXPECT_FALSE(in_class.NamesFirst() || in_class.SetIsExact());
  EXPECT_TRUE(in_class.ClassIsRight() && in_class.SetIsInClasses());
  EXPECT_FALSE(in_class.AddsWrong());
  const Trial more = Hidden({"base_drift"}, {drift, gain});
  EXPECT_TRUE(more.NamesFirst() && more.AddsWrong());
  EXPECT_FALSE(more.SetIsExact() || more.SetIsInClasses());
  EXPECT_TRUE(Hidden({"leg_gain", "base_drift"}, {drift, gain}).SetIsExact());
  EXPECT_FALSE(Hidden({"leg_gain", "leg_offset"}, {gain}).SetIsExact());
  const Trial missed = Hidden({"leg_gain"}, {});
  EXPECT_FALSE(missed.NamesFirst() || missed.ClassIsRight() || missed.IsAlarm());
  Trial undecided = Hidden({}, {});
  EXPECT_FALSE(undecided.IsAlarm());
  undecided.verdict = "undecided";
  EXPECT_TRUE(undecided.IsAlarm());
}

TEST(Trial, JudgesCarriers) {
  Trial trial = Hidden({"leg_gain"}, {{"leg_gain", {2, 5}, {}}});
  trial.carriers = {5};
  EXPECT_TRUE(trial.HasCarrier());
  EXPECT_FALSE(trial.HasCarrierAlone());
  trial.carriers = {4};
  EXPECT_FALSE(trial.HasCarrier());
}

TEST(Trial, JudgesWhatHasNoName) {
  const std::vector<std::string> truth = {"leg_cubic"};
  const auto judge = [&](const Found& found) {
    Trial trial = Hidden(truth, {found});
    trial.right = {"leg_gain", "leg_nonlinearity"};
    return std::pair(trial.IsUnknownOrRightSite(), trial.IsConfidentlyWrong());
  };
  EXPECT_EQ(judge({"unknown", {}, {}}), std::pair(true, false));
  EXPECT_EQ(judge({"leg_gain", {}, {}}), std::pair(true, false));
  EXPECT_EQ(judge({"tool_sag", {}, {"leg_gain"}}), std::pair(true, false));
  EXPECT_EQ(judge({"tool_sag", {}, {"base_drift"}}), std::pair(false, false));
  EXPECT_EQ(judge({"tool_sag", {}, {}}), std::pair(false, true));
  EXPECT_TRUE(Hidden(truth, {{"tool_sag", {}, {"base_drift"}}}).IsWrong());
  EXPECT_FALSE(Hidden(truth, {{"tool_sag", {}, {"unknown"}}}).IsWrong());
  EXPECT_FALSE(Hidden(truth, {}).IsWrong());
}

TEST(Trial, ClosesAGap) {
  Trial trial;
  trial.before = 5.0;
  trial.oracle = 3.0;
  trial.after = 4.0;
  EXPECT_DOUBLE_EQ(trial.GapClosed(), 9.0 / 16.0);
  trial.oracle = 4.5;
  EXPECT_TRUE(std::isnan(trial.GapClosed()));
}

// Values from a table of Wilson's interval: 0 of 10 and 5 of 10.
TEST(Share, HasWilsonsInterval) {
  EXPECT_NEAR((Share{0, 10}).High(), 0.2775, 1e-4);
  EXPECT_EQ((Share{0, 10}).Low(), 0.0);
  EXPECT_NEAR((Share{5, 10}).Low(), 0.2366, 1e-4);
  EXPECT_NEAR((Share{5, 10}).High(), 0.7634, 1e-4);
}

// Clear effects of two sites, each on another machine, and a clean set. The study proper has
// hundreds.
TEST(Study, NamesClearEffects) {
  DiscoverOptions options;
  options.bootstraps = 99;
  options.folds = 2;
  CaseOptions hidden;
  hidden.snr = 25.0;
  int number = 0;
  for (const char* kind : {"leg_thermal", "tracker_scale"}) {
    hidden.kind = kind;
    const Trial trial = RunTrial("test", MakeCase(hidden, 31, number++), options, false);
    EXPECT_EQ(trial.error, "");
    EXPECT_TRUE(trial.NamesFirst() && trial.SetIsExact()) << AsJson(trial);
    EXPECT_LT(trial.after, 0.7 * trial.before) << AsJson(trial);
  }
  hidden.kind = "clean";
  const Trial clean = RunTrial("test", MakeCase(hidden, 31, number), options, false);
  EXPECT_FALSE(clean.IsAlarm()) << AsJson(clean);
}

}  // namespace
}  // namespace hexcal::hidden
