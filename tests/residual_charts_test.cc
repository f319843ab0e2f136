// SPDX-License-Identifier: BSD-3-Clause
// The pictures of residuals that all reports share: their numbers are those of the estimate.
#include "report/residual_charts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "estimator/autocorrelation.h"
#include "estimator/normal_plot.h"
#include "model/hexapod.h"
#include "report/coordinate_charts.h"
#include "report/distribution_charts.h"
#include "report/estimate_charts.h"
#include "report/leg_charts.h"
#include "report/scene.h"
#include "testing/audits.h"
#include "testing/matchers.h"

namespace hexcal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

const testing::AuditedExample& Example() {
  static const auto* example = new testing::AuditedExample(testing::AuditExample());
  return *example;
}

PoseResiduals Make() {
  return ResidualsOf(Example().dataset, Example().observations, Example().estimate);
}

// As after a discovery: before everything is thrice as far off.
PoseResiduals WithBefore() {
  PoseResiduals residuals = Make();
  residuals.before = residuals.after;
  for (auto* list :
       {&residuals.before->error, &residuals.before->standard, &residuals.before->legs})
    for (Vector6d& pose : *list) pose *= 3.0;
  return residuals;
}

// Legs of the pose in which the measurement has the platform, less those that are reported.
TEST(PoseResiduals, OfLegsAreTheLengthsThatAreMissing) {
  const PoseResiduals residuals = Make();
  const testing::AuditedExample& example = Example();
  ASSERT_EQ(residuals.after.legs.size(), 60u);
  for (std::size_t i = 0; i < 60; ++i) {
    const Observation& o = example.observations.items[i];
    const Pose3d seen = example.estimate.mounts.world_from_base.Inverse() * o.world_from_tool *
                        example.estimate.mounts.platform_from_tool.Inverse();
    const LegLengths reported = InverseKinematics(*example.dataset.hexapod, o.base_from_platform);
    const LegLengths missing = InverseKinematics(*example.dataset.hexapod, seen) - reported;
    EXPECT_TRUE(testing::MatrixNear(residuals.leg_lengths[i], reported, 1e-15));
    EXPECT_TRUE(testing::MatrixNear(
        residuals.after.legs[i], missing, 1e-2 * missing.cwiseAbs().maxCoeff()));
  }
}

TEST(PoseResiduals, AreInTheirOwnStandardDeviations) {
  const PoseResiduals residuals = Make();
  ASSERT_EQ(residuals.after.standard.size(), 60u);
  double squares = 0.0;
  for (const Vector6d& pose : residuals.after.standard) squares += pose.squaredNorm() / 360.0;
  EXPECT_NEAR(std::sqrt(squares), Example().estimate.noise_scale, 0.05);
}

TEST(ResidualCharts, ShowEveryAxisInItsUnitBeforeAndAfter) {
  PoseResiduals residuals = WithBefore();
  residuals.times.assign(60, 7.0);
  residuals.times.back() = 7207.0;
  const std::vector<Chart> charts = ResidualCharts(residuals);
  ASSERT_EQ(charts.size(), 4u);
  EXPECT_EQ(charts[1].title, "Orientation residuals in order of visit");
  ASSERT_EQ(charts[1].data.size(), 6u);
  const double about_z = 1e3 * residuals.after.error[4][5];
  EXPECT_EQ(charts[1].data[4]["name"], "before");
  EXPECT_DOUBLE_EQ(charts[1].data[4]["y"][4].get<double>(), 3.0 * about_z);
  EXPECT_DOUBLE_EQ(charts[1].data[5]["y"][4].get<double>(), about_z);
  EXPECT_EQ(charts[1].data[5]["yaxis"], "y3");
  EXPECT_EQ(charts[3].title, "Orientation residuals over time");
  EXPECT_EQ(charts[3].data[5]["x"][59], 120.0);  // minutes from the first on
  EXPECT_EQ(charts[3].table.columns.size(), 8u);
  EXPECT_EQ(charts[3].table.rows[4].size(), 8u);

  residuals.before.reset();
  residuals.times.clear();
  const std::vector<Chart> alone = ResidualCharts(residuals);
  ASSERT_EQ(alone.size(), 2u);
  EXPECT_EQ(alone[0].data.size(), 3u);
  EXPECT_THAT(alone[0].shows, Not(HasSubstr("before")));
}

// A pose that the fit left out has another sign than its neighbours wherever poses are dots, and
// the words say which. Where all were used nothing is said.
TEST(Pictures, SetALeftOutPoseApart) {
  testing::AuditedExample example = Example();
  const auto all_of = [&example] {
    const PoseResiduals residuals =
        ResidualsOf(example.dataset, example.observations, example.estimate);
    std::vector<PoseCheck> checks(60);
    std::vector<Chart> all = ResidualCharts(residuals);
    for (const Chart& chart : CoordinateCharts(residuals)) all.push_back(chart);
    all.push_back(LegCharts(residuals)[0]);
    all.push_back(HeldOutChart(checks, residuals.used));
    all.push_back(SmallestChart(checks, residuals.used));
    for (const Chart& chart :
         SceneCharts(MakeScene(example.dataset, example.observations, example.estimate)))
      all.push_back(chart);
    return all;
  };
  for (const Chart& chart : all_of()) EXPECT_THAT(chart.shows, Not(HasSubstr("cross")));
  example.estimate.poses[7].weight = 0.0;
  const std::vector<Chart> all = all_of();
  ASSERT_EQ(all.size(), 9u);
  for (const Chart& chart : all) {
    EXPECT_THAT(chart.shows, HasSubstr("A cross is of a pose that was left out")) << chart.title;
    int traces = 0;
    for (const Json& trace : chart.data) {
      if (trace["x"].size() != 60u || trace["mode"] != "markers") continue;
      ++traces;
      const Json& symbols = trace["marker"]["symbol"];
      ASSERT_EQ(symbols.size(), 60u) << chart.title;
      for (std::size_t i = 0; i < 60; ++i)
        EXPECT_EQ(symbols[i].get<std::string>()[0] == 'x', i == 7) << chart.title;
    }
    EXPECT_GT(traces, 0) << chart.title;
  }
}

TEST(LegCharts, ShowEveryLegByLengthAndByPose) {
  PoseResiduals residuals = WithBefore();
  residuals.labels[2] = "<b>";
  const std::vector<Chart> charts = LegCharts(residuals);
  ASSERT_EQ(charts.size(), 2u);
  ASSERT_EQ(charts[0].data.size(), 12u);
  const Json& fifth = charts[0].data[9];  // leg 5, after
  EXPECT_EQ(fifth["xaxis"], "x5");
  EXPECT_DOUBLE_EQ(fifth["x"][7].get<double>(), 1e3 * residuals.leg_lengths[7][4]);
  EXPECT_DOUBLE_EQ(fifth["y"][7].get<double>(), 1e3 * residuals.after.legs[7][4]);
  EXPECT_THAT(charts[0].data.dump(), Not(HasSubstr("<b>")));
  const Json& before = charts[1].data[0];
  EXPECT_DOUBLE_EQ(before["z"][4][7].get<double>(), 3e3 * residuals.after.legs[7][4]);
  EXPECT_DOUBLE_EQ(charts[1].data[1]["z"][4][7].get<double>(), 1e3 * residuals.after.legs[7][4]);
  EXPECT_EQ(charts[1].table.rows[7].size(), 13u);
  double largest = 0.0;
  for (const Vector6d& pose : residuals.before->legs)
    largest = std::max(largest, 1e3 * pose.cwiseAbs().maxCoeff());
  EXPECT_DOUBLE_EQ(charts[1].layout["coloraxis"]["cmax"].get<double>(), largest);

  residuals.before.reset();
  EXPECT_EQ(LegCharts(residuals)[0].data.size(), 6u);
  EXPECT_EQ(LegCharts(residuals)[1].table.rows[7].size(), 7u);
  residuals.leg_lengths.clear();
  EXPECT_TRUE(LegCharts(residuals).empty());
}

TEST(DistributionCharts, HaveTheNumbersOfTheEstimator) {
  PoseResiduals residuals = Make();
  residuals.after.standard[3].setConstant(std::numeric_limits<double>::quiet_NaN());
  residuals.after.standard[5][0] = 9.0;
  const std::vector<Chart> charts = DistributionCharts(residuals);
  ASSERT_EQ(charts.size(), 3u);
  // 59 poses of three positions; what is beyond stands in the last bar.
  int count = 0;
  for (const Json& bar : charts[0].data[0]["y"]) count += bar.get<int>();
  EXPECT_EQ(count, 177);
  EXPECT_EQ(charts[0].data[0]["name"], "positions");
  EXPECT_GE(charts[0].data[0]["y"].back().get<int>(), 1);
  double ideal = 0.0;
  for (const auto& row : charts[0].table.rows) ideal += std::stod(row[3]);
  EXPECT_NEAR(ideal, 177.0, 0.5);

  std::vector<double> orientations;
  std::vector<Eigen::VectorXd> rows;
  for (const Vector6d& pose : residuals.after.standard) {
    rows.emplace_back(pose.tail<3>());
    for (const double x : rows.back())
      if (std::isfinite(x)) orientations.push_back(x);
  }
  const auto points = NormalPlot(orientations, 1000);
  const Json& sorted = charts[1].data[1];
  ASSERT_EQ(sorted["y"].size(), points.size());
  EXPECT_EQ(sorted["y"][176].get<double>(), points[176].value);
  EXPECT_EQ(sorted["x"][176].get<double>(), points[176].expected);
  EXPECT_EQ(charts[1].data[3]["y"][0].get<double>(), points[0].low);
  EXPECT_EQ(charts[1].data[4]["y"][0].get<double>(), points[0].high);

  const Autocorrelation found = FindAutocorrelation(rows, 15);
  EXPECT_EQ(charts[2].data[1]["y"], Json(found.of_lag));
  EXPECT_EQ(charts[2].layout["shapes"][0]["y0"].get<double>(), found.band);
  EXPECT_EQ(charts[2].layout["shapes"][1]["y0"].get<double>(), -found.band);
}

TEST(DistributionCharts, OfADiscoveryAreBeforeAndAfter) {
  PoseResiduals residuals = WithBefore();
  const std::vector<Chart> charts = DistributionCharts(residuals);
  ASSERT_EQ(charts.size(), 3u);
  for (const Chart& chart : charts) {
    EXPECT_EQ(chart.data[0]["name"], "before");
    EXPECT_EQ(chart.data[1]["name"], "after");
  }
  EXPECT_NEAR(charts[1].data[0]["y"][0].get<double>(),
              3.0 * charts[1].data[1]["y"][0].get<double>(),
              1e-12);
  residuals.after.standard.clear(), residuals.before->standard.clear();
  EXPECT_TRUE(DistributionCharts(residuals).empty());
}

TEST(ConvergenceChart, SaysWhatIsTrueOfAStartAtTheEnd) {
  const Chart fall = ConvergenceChart({{9.0, 1e-3, 1e-2}, {1.0, 1e-4, 1e-3}}, "solver");
  EXPECT_THAT(fall.good, HasSubstr("a steep fall"));
  const Chart level = ConvergenceChart({{1.0, 1.04e-4, 1e-3}, {1.0, 1e-4, 1e-3}}, "solver");
  EXPECT_THAT(level.good, HasSubstr("a level line"));
  // Orientation alone may fall.
  const Chart half = ConvergenceChart({{1.0, 1e-4, 2e-3}, {1.0, 1e-4, 1e-3}}, "solver");
  EXPECT_THAT(half.good, HasSubstr("a steep fall"));
}

}  // namespace
}  // namespace hexcal
