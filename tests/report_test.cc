// SPDX-License-Identifier: BSD-3-Clause
// What people and programs read of an estimate: every number in its place, in its unit, and null
// or a word where there is none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "geometry/rotation_angles.h"
#include "report/quantity.h"
#include "report/result_json.h"
#include "report/result_table.h"
#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

const ResultHeader kHeader = {"demo", "linearized", "pose", "twist"};

// Every number is another one, so that none can stand for another.
Estimate MakeEstimate() {
  Estimate e;
  Vector6d base, tool;
  base << 1.0, -2.0, 3.0, 0.1, -0.2, 0.3;
  tool << 0.01, 0.02, -0.03, -0.5, 0.4, 0.6;
  e.mounts = {PoseFromVector(base), PoseFromVector(tool)};
  e.converged = true;
  e.iterations = {{5.0, 0.5, 0.25}, {4.0, 0.125, 0.0625}};
  e.poses = {{"p1", 1.0, (Vector6d() << 1, 2, 3, 4, 5, 6).finished()}};
  Outlier outlier;
  outlier.label = "p1";
  outlier.reason = "position 23 sigma off";
  outlier.residual = (Vector6d() << 11, 12, 13, 14, 15, 16).finished();
  outlier.position_sigmas = 23.0;
  outlier.orientation_sigmas = 2.5;
  outlier.statistic = 531.0;
  outlier.p_value = 0.0001;
  e.outliers = {outlier};
  e.noise = {0.0011, 0.0022, true};
  e.noise_scale = 1.5;
  e.rmspe = 0.0033;
  e.rmsoe = 0.0044;
  e.chi_square = 270.0;
  e.degrees_of_freedom = 120;
  for (int i = 0; i < 12; ++i) {
    e.covariance_unscaled(i, i) = std::pow(1e-5 * (i + 1), 2);
    e.observability.determined[i] = true;
    e.observability.singular_values[i] = 12.0 - i;
  }
  e.covariance_unscaled(0, 7) = e.covariance_unscaled(7, 0) = 0.5 * 1e-5 * 8e-5;
  e.covariance = 2.25 * e.covariance_unscaled;
  e.observability.condition_number = 12.0;
  e.warnings = {"a warning"};
  return e;
}

TEST(ResultJson, EveryNumberStandsUnderItsKey) {
  const Estimate e = MakeEstimate();
  const Json r = Json::parse(ResultJson(kHeader, e));
  EXPECT_EQ(r["dataset"], "demo");
  EXPECT_EQ(r["solver"], "linearized");
  EXPECT_EQ(r["residual"], "pose");
  EXPECT_EQ(r["error"], "twist");
  EXPECT_EQ(r["converged"], true);
  const Pose3d& base = e.mounts.world_from_base;
  EXPECT_EQ(r["world_from_base"]["xyz"], (Json{1.0, -2.0, 3.0}));
  EXPECT_EQ(r["world_from_base"]["quaternion"][0], base.rotation.w());
  EXPECT_EQ(r["world_from_base"]["quaternion"][3], base.rotation.z());
  EXPECT_EQ(r["world_from_base"]["matrix"][0][2], base.Matrix()(0, 2));
  EXPECT_EQ(r["world_from_base"]["matrix"][1][3], -2.0);
  EXPECT_EQ(r["platform_from_tool"]["xyz"], (Json{0.01, 0.02, -0.03}));
  const char* names[12] = {"base.dx",
                           "base.dy",
                           "base.dz",
                           "base.rx",
                           "base.ry",
                           "base.rz",
                           "tool.dx",
                           "tool.dy",
                           "tool.dz",
                           "tool.rx",
                           "tool.ry",
                           "tool.rz"};
  for (int i = 0; i < 12; ++i) {
    EXPECT_EQ(r["parameters"][i], names[i]);
    EXPECT_NEAR(r["standard_deviation"][i], 1.5e-5 * (i + 1), 1e-19);
    EXPECT_NEAR(r["standard_deviation_unscaled"][i], 1e-5 * (i + 1), 1e-19);
    EXPECT_EQ(r["observability"]["singular_values"][i], 12.0 - i);
  }
  EXPECT_EQ(r["covariance"][0][7], e.covariance(0, 7));
  EXPECT_EQ(r["covariance_unscaled"][0][7], e.covariance_unscaled(0, 7));
  EXPECT_NEAR(r["correlation"][7][0], 0.5, 1e-15);
  EXPECT_EQ(r["noise"],
            (Json{{"position", 0.0011},
                  {"orientation", 0.0022},
                  {"estimated", true},
                  {"assumed", "tracker"}}));
  EXPECT_EQ(r["noise_scale"], 1.5);
  EXPECT_EQ(r["rmspe"], 0.0033);
  EXPECT_EQ(r["rmsoe"], 0.0044);
  EXPECT_EQ(r["chi_square"], 270.0);
  EXPECT_EQ(r["degrees_of_freedom"], 120);
  EXPECT_EQ(r["iterations"][1], (Json{{"cost", 4.0}, {"rmspe", 0.125}, {"rmsoe", 0.0625}}));
  EXPECT_EQ(r["observability"]["condition_number"], 12.0);
  EXPECT_EQ(r["poses"][0]["pose"], "p1");
  EXPECT_EQ(r["poses"][0]["residual"], (Json{1.0, 2.0, 3.0, 4.0, 5.0, 6.0}));
  EXPECT_EQ(r["outliers"][0],
            (Json{{"pose", "p1"},
                  {"reason", "position 23 sigma off"},
                  {"statistic", 531.0},
                  {"p_value", 0.0001},
                  {"position_sigmas", 23.0},
                  {"orientation_sigmas", 2.5},
                  {"residual", {11.0, 12.0, 13.0, 14.0, 15.0, 16.0}}}));
  EXPECT_EQ(r["warnings"], Json{"a warning"});
}

TEST(ResultJson, OfMarkersHasEachMarkersResidualAndNoise) {
  Estimate e = MakeEstimate();
  EXPECT_FALSE(Json::parse(ResultJson(kHeader, e))["poses"][0].contains("markers"));
  e.poses[0].markers = {{"base/b1", Eigen::Vector3d(7, 8, 9)},
                        {"tool/t2", Eigen::Vector3d(1, 0, 2)}};
  e.noise.marker = Eigen::Vector3d(0.25, 0.5, 0.75);
  e.noise.assumed = NoiseSide::kBoth;
  const Json r = Json::parse(ResultJson({"demo", "nonlinear", "marker", ""}, e));
  EXPECT_EQ(r["residual"], "marker");
  EXPECT_EQ(r["poses"][0]["markers"],
            (Json{{{"marker", "base/b1"}, {"residual", {7.0, 8.0, 9.0}}},
                  {{"marker", "tool/t2"}, {"residual", {1.0, 0.0, 2.0}}}}));
  EXPECT_EQ(r["noise"]["marker"], (Json{0.25, 0.5, 0.75}));
  EXPECT_EQ(r["noise"]["assumed"], "both");
  e.noise.assumed = NoiseSide::kRobot;
  EXPECT_EQ(Json::parse(ResultJson(kHeader, e))["noise"]["assumed"], "robot");
}

TEST(ResultJson, OneLineIsTheSameObject) {
  const std::string line = ResultJsonLine(kHeader, MakeEstimate());
  EXPECT_THAT(line, Not(HasSubstr("\n")));
  EXPECT_EQ(Json::parse(line), Json::parse(ResultJson(kHeader, MakeEstimate())));
}

TEST(ResultJson, WhatIsNotDeterminedIsNullInItsRowAndColumn) {
  Estimate e = MakeEstimate();
  e.observability.determined[2] = false;
  const Json r = Json::parse(ResultJson(kHeader, e));
  for (const char* key : {"covariance", "covariance_unscaled", "correlation"})
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j)
        EXPECT_EQ(r[key][i][j].is_null(), i == 2 || j == 2) << key << i << j;
  for (const char* key : {"standard_deviation", "standard_deviation_unscaled"})
    for (int i = 0; i < 12; ++i) EXPECT_EQ(r[key][i].is_null(), i == 2) << key << i;
}

TEST(ResultJson, TheNonlinearSolverHasNoError) {
  EXPECT_FALSE(
      Json::parse(ResultJson({"demo", "nonlinear", "pose", ""}, MakeEstimate())).contains("error"));
}

TEST(ResultTable, IsInMillimetresAndMilliradiansWithTheSigmaOfEachNumber) {
  Estimate e = MakeEstimate();
  e.mounts.world_from_base = {Eigen::Vector3d(1, -2, 3), Eigen::Quaterniond::Identity()};
  const std::string table = ResultTable(kHeader, e);
  EXPECT_THAT(
      table, HasSubstr("demo: 1 poses, linearized (twist) by poses, converged after 1 iterations"));
  // sigma of base.dy = 1.5 * 2e-5 m, of base.rz = 1.5 * 6e-5 rad.
  EXPECT_THAT(table, HasSubstr("-2000.000 mm   ± 0.030"));
  EXPECT_THAT(table, HasSubstr("0.000 mrad ± 0.090"));
  EXPECT_THAT(table, HasSubstr("3.3 mm and 4.4 mrad RMS"));
  EXPECT_THAT(table, HasSubstr("1.1 mm and 2.2 mrad a coordinate, estimated"));
  EXPECT_THAT(table, HasSubstr("270 with 120 degrees of freedom (noise scale 1.500)"));
  EXPECT_THAT(table, Not(HasSubstr("undetermined")));
}

// Nor where a word stands in place of the last number.
TEST(ResultTable, HasNoBlanksAtTheEndsOfLines) {
  Estimate e = MakeEstimate();
  EXPECT_THAT(ResultTable(kHeader, e), Not(HasSubstr(" \n")));
  e.observability.determined.fill(false);
  EXPECT_THAT(ResultTable(kHeader, e), Not(HasSubstr(" \n")));
}

TEST(MilliText, HasDigitsHoweverSmallTheNumber) {
  EXPECT_EQ(MilliText(0.12345678), "123.4568");
  EXPECT_EQ(MilliText(-4.25e-5), "-0.0425");
  EXPECT_EQ(MilliText(1e-6), "0.0010");
  EXPECT_EQ(MilliText(-3.21e-7), "-0.000321");
  EXPECT_EQ(MilliText(3.2e-13), "3.2e-10");
  EXPECT_EQ(MilliText(-9e-14), "0");
  EXPECT_EQ(MilliText(0.0), "0");
  EXPECT_EQ(MilliText(std::numeric_limits<double>::quiet_NaN()), "–");
}

TEST(QuantityText, HasNoSignOfZero) {
  EXPECT_EQ(QuantityText(-3e-7, 1.4e-5, "1"), "0 ± 14 ppm");
  EXPECT_EQ(QuantityText(-3e-5, 1.4e-5, "1"), "-30 ± 14 ppm");
  EXPECT_EQ(QuantityText(-3e-6, 4e-3, "m"), "0.0 ± 4.0 mm");
}

TEST(ShareText, OfNothingIsZero) {
  EXPECT_EQ(ShareText(1.24e-23), "0 %");
  EXPECT_EQ(ShareText(0.125), "12.5 %");
}

TEST(ResultTable, OfMarkersSaysTheirNoiseAndWhoseItIs) {
  Estimate e = MakeEstimate();
  const ResultHeader header = {"demo", "nonlinear", "marker", ""};
  EXPECT_THAT(ResultTable(header, e), Not(HasSubstr("marker noise")));
  EXPECT_THAT(ResultTable(header, e), HasSubstr("nonlinear by markers"));
  e.noise.marker = Eigen::Vector3d(1e-4, 1e-4, 1e-4);
  EXPECT_THAT(ResultTable(header, e), HasSubstr("marker noise   0.1 mm a reading"));
  EXPECT_THAT(ResultTable(header, e), Not(HasSubstr("robot")));
  e.noise.marker->z() = 3e-4;
  e.noise.assumed = NoiseSide::kBoth;
  EXPECT_THAT(ResultTable(header, e), HasSubstr("marker noise   0.1 0.1 0.3 mm a reading"));
  EXPECT_THAT(ResultTable(header, e), HasSubstr("of tracker and robot"));
  e.noise.assumed = NoiseSide::kRobot;
  EXPECT_THAT(ResultTable(header, e), HasSubstr("of the robot"));
}

TEST(ResultTable, SaysInWordsWhatHasNoNumber) {
  Estimate e = MakeEstimate();
  e.converged = false;
  e.observability.determined[2] = false;
  e.observability.condition_number = std::numeric_limits<double>::infinity();
  const std::string table = ResultTable(kHeader, e);
  EXPECT_THAT(table, HasSubstr("NOT CONVERGED"));
  EXPECT_THAT(table, HasSubstr("undetermined"));
  EXPECT_THAT(table, HasSubstr("infinite of the scaled Jacobian"));
  Vector6d gimbal;
  gimbal << 0, 0, 0, 0, std::acos(0.0), 0;
  e.mounts.platform_from_tool = PoseFromVector(gimbal);
  const std::string at_gimbal = ResultTable(kHeader, e);
  EXPECT_THAT(at_gimbal, HasSubstr("at the gimbal"));
  EXPECT_THAT(at_gimbal, Not(HasSubstr("nan")));
}

// Both mounts' numbers and sigmas stand in their own column.
TEST(ResultTable, NamesOutliersAndWhetherTheyCount) {
  Estimate e = MakeEstimate();
  EXPECT_THAT(ResultTable(kHeader, e),
              HasSubstr("outliers       1 of 1 poses, used all the same\n"
                        "    pose p1      position 23 sigma off\n"));
  e.poses[0].weight = 0.0;
  EXPECT_THAT(ResultTable(kHeader, e), HasSubstr("outliers       1 of 1 poses, left out\n"));
  e.outliers.resize(12, e.outliers[0]);
  EXPECT_THAT(ResultTable(kHeader, e), HasSubstr("2 more, in result.json\n"));
  e.outliers.clear();
  EXPECT_THAT(ResultTable(kHeader, e), Not(HasSubstr("outliers")));
}

TEST(ResultTable, BaseStandsLeftOfTool) {
  Estimate e = MakeEstimate();
  e.mounts = {};
  const std::string table = ResultTable(kHeader, e);
  const std::size_t row = table.find("  x  ");
  const std::string line = table.substr(row, table.find('\n', row) - row);
  EXPECT_LT(line.find("± 0.015"), line.find("± 0.10"));
}

TEST(PoseVectorSigma, IsTheNumericDerivativeOfThePoseVector) {
  auto rng = testing::SeededByTest();
  const Pose3d pose = testing::SmallPose(rng, 1.0, 0.9);
  Matrix6d root;
  for (int i = 0; i < 6; ++i) root.col(i) = testing::Normal(rng, 6);
  const Matrix6d covariance = 1e-4 * root * root.transpose();
  const Matrix6d j = testing::NumericJacobian(
      [&](const Eigen::VectorXd& d) { return VectorFromPose(Plus(pose, Vector6d(d))); }, 6);
  const Vector6d expected = (j * covariance * j.transpose()).diagonal().cwiseSqrt();
  EXPECT_TRUE(testing::MatrixNear(
      PoseVectorSigma(pose, covariance).cwiseQuotient(expected), Vector6d::Ones(), 1e-8));
}

TEST(PoseVectorSigma, HasNoAnglesWhereTheGimbalIsWithinTheirNoise) {
  Vector6d near_gimbal = Vector6d::Zero();
  near_gimbal[4] = std::acos(0.0) - 0.002;
  const Pose3d pose = PoseFromVector(near_gimbal);
  const Matrix6d narrow = 1e-8 * Matrix6d::Identity(), wide = 1e-6 * Matrix6d::Identity();
  EXPECT_TRUE(PoseVectorSigma(pose, narrow).allFinite());
  EXPECT_FALSE(std::isfinite(PoseVectorSigma(pose, wide)[3]));
  EXPECT_TRUE(PoseVectorSigma(pose, wide).head<3>().allFinite());
}

}  // namespace
}  // namespace hexcal
