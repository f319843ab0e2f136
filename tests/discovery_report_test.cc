// SPDX-License-Identifier: BSD-3-Clause
// What people and programs read of a discovery: every key, every number under its name and in its
// unit. The report for the browser has tests of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "model/described_effect.h"
#include "report/discovery_json.h"
#include "report/discovery_table.h"
#include "report/discovery_words.h"
#include "report/result_json.h"
#include "testing/discoveries.h"

namespace hexcal {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Json = nlohmann::ordered_json;

DiscoverOptions Options() {
  DiscoverOptions options;
  options.seed = 7;
  options.threads = 5;
  return options;
}

Json Written(const Discovery& discovery) {
  return Json::parse(DiscoveryJson("demo", Options(), discovery));
}

std::vector<std::string> KeysOf(const Json& object) {
  std::vector<std::string> keys;
  for (const auto& item : object.items()) keys.push_back(item.key());
  return keys;
}

TEST(DiscoveryJson, SaysWhatIsKnownOfUnpublishedLegs) {
  Discovery discovery = testing::MakeDiscovery();
  EXPECT_FALSE(Written(discovery).contains("leg_geometry"));
  GeometryClass& geometry = discovery.leg_geometry.emplace();
  geometry.is_in_model = true;
  geometry.bounds = {{"base_radius", "m", 0.5, 0.25, 0.75},
                     {"base_half_angle", "rad", 0.125, 0.0625, 0.25}};
  geometry.yaw = 0.5, geometry.error_size = 1e-3;
  geometry.after.chi_square = 400.0;
  geometry.heldout.rms_position = 4e-5, geometry.heldout_map.rms_position = 6e-5;
  const Json json = Written(discovery)["leg_geometry"];
  EXPECT_THAT(KeysOf(json),
              ElementsAre("in_model",
                          "complete",
                          "bounds",
                          "yaw",
                          "error_size",
                          "after",
                          "heldout",
                          "heldout_map"));
  EXPECT_EQ(json["in_model"], true);
  EXPECT_EQ(json["complete"], false);
  const Json& radius = json["bounds"]["base_radius"];
  EXPECT_THAT(KeysOf(radius), ElementsAre("value", "lower", "upper", "unit"));
  EXPECT_EQ(radius["value"], 0.5);
  EXPECT_EQ(radius["lower"], 0.25);
  EXPECT_EQ(radius["upper"], 0.75);
  EXPECT_EQ(json["bounds"]["base_half_angle"]["unit"], "rad");
  EXPECT_EQ(json["yaw"], 0.5);
  EXPECT_EQ(json["error_size"], 1e-3);
  EXPECT_EQ(json["after"]["chi_square"], 400.0);
  EXPECT_EQ(json["heldout"]["rms_position"], 4e-5);
  EXPECT_EQ(json["heldout_map"]["rms_position"], 6e-5);
}

TEST(DiscoveryWords, JointsAreCalledAllWhereTheyAre) {
  DiscoveredEffect found;
  for (int i = 1; i <= 6; ++i) found.labels.push_back("base joint " + std::to_string(i));
  EXPECT_EQ(CarriersOf(found), "all base joints");
  found.labels.pop_back();
  EXPECT_THAT(CarriersOf(found), HasSubstr("base joint 5"));
}

TEST(DiscoveryJson, HasTheKeysOfItsFormat) {
  const Json json = Written(testing::MakeDiscovery());
  EXPECT_THAT(KeysOf(json),
              ElementsAre("format",
                          "dataset",
                          "verdict",
                          "settings",
                          "not_testable",
                          "detectable",
                          "gap",
                          "effects",
                          "steps",
                          "where",
                          "noise",
                          "poses",
                          "warnings"));
  EXPECT_THAT(KeysOf(json["gap"]),
              ElementsAre("before", "after", "heldout_before", "heldout_after", "noise_floor"));
  for (const Json& size : json["gap"])
    EXPECT_THAT(KeysOf(size),
                ElementsAre("rms_position", "rms_orientation", "chi_square", "degrees_of_freedom"));
  EXPECT_THAT(KeysOf(json["effects"][0]),
              ElementsAre("name",
                          "site",
                          "index",
                          "labels",
                          "driver",
                          "shape",
                          "parameters",
                          "standard_deviation",
                          "units",
                          "p_value",
                          "log10_p",
                          "gap_closed",
                          "could_also_be",
                          "description"));
  EXPECT_THAT(KeysOf(json["where"]), ElementsAre("poses", "legs", "axes", "covariates", "sites"));
}

TEST(DiscoveryJson, EveryNumberStandsUnderItsKey) {
  const Json json = Written(testing::MakeDiscovery());
  EXPECT_EQ(json["format"], "hexcal/discovery/1");
  EXPECT_EQ(json["dataset"], "demo");
  EXPECT_EQ(json["verdict"], "explained");
  EXPECT_EQ(json["settings"]["seed"], 7);
  EXPECT_EQ(json["not_testable"],
            (Json{{{"name", "leg_thermal"}, {"needs", "a temperature column"}}}));
  EXPECT_EQ(json["detectable"][0]["index"], Json{2});
  EXPECT_EQ(json["detectable"][0]["smallest"], 4.5e-6);
  EXPECT_EQ(json["detectable"][1]["unit"], "1");
  const double positions[] = {1.5e-4, 5e-5, 1.75e-4, 5.5e-5, 4.5e-5};
  int i = 0;
  for (const Json& size : json["gap"]) EXPECT_EQ(size["rms_position"], positions[i++]);
  EXPECT_EQ(json["gap"]["before"]["rms_orientation"], 1.25e-3);
  EXPECT_EQ(json["gap"]["before"]["chi_square"], 900.0);
  EXPECT_EQ(json["gap"]["before"]["degrees_of_freedom"], 420);
  const Json& effect = json["effects"][0];
  EXPECT_EQ(effect["name"], "leg_gain");
  EXPECT_EQ(effect["site"], "leg");
  EXPECT_EQ(effect["driver"], "leg_length");
  EXPECT_EQ(effect["shape"], "linear");
  EXPECT_EQ(effect["index"], Json{3});
  EXPECT_EQ(effect["labels"], Json{"leg 3"});
  EXPECT_EQ(effect["p_value"], 0.001);
  EXPECT_EQ(effect["log10_p"], -41.5);
  EXPECT_EQ(effect["gap_closed"], 0.875);
  EXPECT_EQ(effect["could_also_be"][0]["name"], "base_radius");
  EXPECT_THAT(effect["could_also_be"][0]["why"], HasSubstr("heights"));
  EXPECT_EQ(json["steps"][0]["added"], "leg_gain");
  EXPECT_EQ(json["steps"][0]["candidates"][1]["score"], 80.25);
  EXPECT_EQ(json["steps"][0]["candidates"][0]["p_value"], 1e-12);
  EXPECT_TRUE(json["steps"][2]["added"].is_null());
  EXPECT_EQ(json["where"]["legs"][0]["what"], "leg 3");
  EXPECT_EQ(json["where"]["poses"][0]["p_value"], 0.0004);
  EXPECT_EQ(json["noise"]["robot_orientation"], 3e-5);
  EXPECT_EQ(json["poses"][4]["weight"], 0.25);
  EXPECT_EQ(json["poses"][4]["before"].size(), 6u);
  EXPECT_EQ(json["poses"][4]["legs_after"].size(), 6u);
  EXPECT_EQ(json["warnings"], Json{"a warning"});
}

TEST(DiscoveryJson, ParametersAreNumbersListsOrRowsByTheirKind) {
  Discovery discovery = testing::MakeDiscovery();
  DiscoveredEffect joints;
  joints.effect.name = "base_joint_offset";
  joints.effect.parameters = Eigen::VectorXd::LinSpaced(18, 1.0, 18.0);
  DiscoveredEffect sag;
  sag.effect.name = "tool_sag";
  sag.effect.parameters = Eigen::Vector2d(5e-5, 1e-4);
  discovery.effects.push_back(joints);
  discovery.effects.push_back(sag);
  const Json effects = Written(discovery)["effects"];
  EXPECT_EQ(effects[0]["parameters"]["gain"], (Json{0.0, 0.0, 3.125e-4, 0.0, 0.0, 0.0}));
  EXPECT_EQ(effects[0]["standard_deviation"]["gain"][2], 1.25e-5);
  EXPECT_EQ(effects[0]["units"]["gain"], "1");
  EXPECT_EQ(effects[1]["parameters"]["offset"], (Json{1e-4, -2e-4, 3e-4}));
  EXPECT_TRUE(effects[1]["standard_deviation"]["offset"][2].is_null());
  EXPECT_EQ(effects[2]["parameters"]["offset"].size(), 6u);
  EXPECT_EQ(effects[2]["parameters"]["offset"][1], (Json{4.0, 5.0, 6.0}));
  EXPECT_TRUE(effects[2]["standard_deviation"]["offset"][0][0].is_null());
  EXPECT_EQ(effects[3]["parameters"]["deflection"], 5e-5);
  EXPECT_EQ(effects[3]["parameters"]["rotation"], 1e-4);
}

TEST(DiscoveryJson, AnUnknownHasADescriptionAndItsCoefficients) {
  Discovery discovery = testing::MakeDiscovery();
  discovery.effects.resize(1);
  DiscoveredEffect& found = discovery.effects[0];
  found.effect = Effect{"unknown", {}, {}, {}, {}, {}};
  EXPECT_EQ(Written(discovery)["effects"][0]["parameters"], Json::object());

  found.effect = DescribedEffect("tool", "payload", 2, 3.0, 1.5);
  found.effect.parameters << 1e-4, 2e-4, 3e-4, 4e-4, 5e-4, 6e-4;
  const Json effect = Written(discovery)["effects"][0];
  EXPECT_EQ(effect["name"], "unknown");
  EXPECT_EQ(effect["parameters"]["coefficients"], (Json{1e-4, 2e-4, 3e-4, 4e-4, 5e-4, 6e-4}));
  EXPECT_EQ(effect["units"]["coefficients"], "m, rad");
  EXPECT_EQ(effect["found"]["driver"], "payload");
  EXPECT_EQ(effect["reference"]["centre"], Json{3.0});
  EXPECT_EQ(effect["description"], "Leg 3 moves 312 ppm further than it reports.");
  EXPECT_THAT(
      SizesOf(found),
      ElementsAre("coefficients: dx 0.1 mm, dy 0.2 mm, dz 0.3 mm, rx 0.4 mrad, ry 0.5 mrad, "
                  "rz 0.6 mrad"));

  found.effect = DescribedEffect("leg", "time", 1, 0.0, 1.0);
  found.effect.parameters << 1e-4, 2e-4, 3e-4, 4e-4, 5e-4, 6e-4;
  EXPECT_EQ(Written(discovery)["effects"][0]["units"]["coefficients"], "m");
  EXPECT_THAT(SizesOf(found)[0], HasSubstr("leg 6 0.6 mm"));

  found.effect.found["site"] = "platform";  // a map of the pose, six numbers a term
  found.effect.parameters = Eigen::VectorXd::LinSpaced(36, 1.0, 36.0);
  EXPECT_EQ(Written(discovery)["effects"][0]["parameters"]["coefficients"][5][0], 31.0);
  EXPECT_THAT(SizesOf(found), ElementsAre("coefficients: 36, in model.yaml"));
}

TEST(DiscoveryJson, AFaultSaysWhatWasFound) {
  Discovery discovery = testing::MakeDiscovery();
  discovery.effects.resize(1);
  discovery.effects[0].effect =
      Effect{"wrong_rotation_order", {}, {}, {}, {}, {{"order", "zyx, stated xyz"}}};
  EXPECT_EQ(Written(discovery)["effects"][0]["found"]["order"], "zyx, stated xyz");
  EXPECT_THAT(SizesOf(discovery.effects[0]), ElementsAre("order: zyx, stated xyz"));
}

TEST(DiscoveryJson, HasNoTimesAndNoThreadsAndTheSameBytesTwice) {
  const std::string once = DiscoveryJson("demo", Options(), testing::MakeDiscovery());
  DiscoverOptions more_threads = Options();
  more_threads.threads = 1;
  EXPECT_EQ(DiscoveryJson("demo", more_threads, testing::MakeDiscovery()), once);
  EXPECT_THAT(once, AllOf(Not(HasSubstr("seconds")), Not(HasSubstr("threads"))));
  const std::string line = DiscoveryJsonLine("demo", Options(), testing::MakeDiscovery());
  EXPECT_EQ(Json::parse(line), Json::parse(once));
  EXPECT_THAT(line, Not(HasSubstr("\n")));
}

TEST(DiscoveryJson, WhereNoLegsAreKnownSaysNothingOfThem) {
  Discovery discovery = testing::MakeDiscovery();
  for (PoseGap& pose : discovery.poses) pose.leg_lengths.reset();
  EXPECT_FALSE(Written(discovery)["poses"][0].contains("legs_before"));
}

TEST(ResultJson, ListsTheEffectsOfTheModel) {
  const Discovery discovery = testing::MakeDiscovery();
  const Json result = Json::parse(ResultJson(
      {"demo", "nonlinear", "marker", ""}, discovery.estimate, {discovery.effects[0].effect}));
  EXPECT_EQ(result["effects"][0]["name"], "leg_gain");
  EXPECT_EQ(result["effects"][0]["index"], Json{3});
  EXPECT_EQ(result["effects"][0]["parameters"]["gain"][2], 3.125e-4);
  EXPECT_EQ(result["effects"][0]["standard_deviation"]["gain"][2], 1.25e-5);
}

TEST(DiscoveryTable, ShowsWhatWasFoundWithSizesInUnits) {
  const std::string table = DiscoveryTable("demo", testing::MakeDiscovery());
  for (const char* text : {"demo: 24 poses, explained",
                           "leg_gain, leg 3: p = 0.001, 87.5 % of the held-out gap closed",
                           "gain: leg 3 312 ± 12 ppm",
                           "could also be base_radius: poses of other heights",
                           "marker_offset, tool/t2",
                           "tool/t2 x 0.100 ± 0.010 mm",
                           "tool/t2 y -0.200 ± 0.020 mm",
                           "before                    0.1500      1.2500         900.0     420",
                           "held out, after           0.0550",
                           "noise floor               0.0450",
                           "1.12 times the stated",
                           "leg_thermal (needs a temperature column)",
                           "leg_backlash (2) 4.5 µm"})
    EXPECT_THAT(table, HasSubstr(text));
}

TEST(DiscoveryTable, PhasesAreInDegreesAndWhatWasNotSearchedIsNotShown) {
  DiscoveredEffect found;
  found.effect.name = "leg_periodic";
  found.effect.index = {2};
  const EffectKind& kind = *FindEffectKind("leg_periodic");
  found.effect.parameters = Eigen::VectorXd::Zero(kind.size());
  found.effect.standard_deviation = Eigen::VectorXd::Constant(kind.size(), std::nan(""));
  const int phase = kind.OffsetOf("phase") + 1;
  found.effect.parameters[phase] = M_PI / 2;
  found.effect.standard_deviation[phase] = M_PI / 180;
  EXPECT_THAT(SizesOf(found), ElementsAre("phase: leg 2 90.0 ± 1.0 °"));
  EXPECT_EQ(NameWithIndex("leg_gain", {1, 2, 3, 4, 5, 6}), "leg_gain (all six)");
  EXPECT_EQ(NameWithIndex("leg_gain", {3, 5}), "leg_gain (3, 5)");
}

TEST(DiscoveryTable, SaysPlainlyThatNothingIsThere) {
  Discovery discovery;
  EXPECT_THAT(DiscoveryTable("demo", discovery),
              AllOf(HasSubstr("agrees"), HasSubstr("nothing but noise"), Not(HasSubstr("found"))));
  EXPECT_THAT(NoiseSentences(discovery.noise), IsEmpty());
  discovery.verdict = Verdict::kUndecided;
  EXPECT_THAT(DiscoveryTable("demo", discovery), HasSubstr("do not say why"));
}

TEST(DiscoveryTable, WhatNeedsTheSameStandsTogether) {
  Discovery discovery;
  discovery.not_testable = {{"a", "legs"}, {"b", "time"}, {"c", "legs"}};
  EXPECT_THAT(DiscoveryTable("demo", discovery), HasSubstr("a, c (needs legs); b (needs time)"));
}

TEST(DiscoveryTable, LinesFitTheScreenAndNoWordIsLost) {
  Discovery discovery = testing::MakeDiscovery();
  discovery.effects[0].description = "Begin";
  for (int i = 0; i < 60; ++i) discovery.effects[0].description += " word" + std::to_string(i);
  std::string table = DiscoveryTable("demo", discovery);
  for (int i = 0; i < 60; ++i) EXPECT_THAT(table, HasSubstr("word" + std::to_string(i)));
  std::size_t start = 0;
  for (std::size_t end; (end = table.find('\n', start)) != std::string::npos; start = end + 1)
    EXPECT_LE(end - start, 110u) << table.substr(start, end - start);
}

}  // namespace
}  // namespace hexcal
