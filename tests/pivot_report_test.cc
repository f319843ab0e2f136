// SPDX-License-Identifier: BSD-3-Clause
// What people read of a pivoting in a browser: every number is the result's.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "report/pivot_charts.h"
#include "report/pivot_html.h"
#include "testing/pivot_scene.h"

namespace hexcal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

constexpr int kSlipped = 7;

struct Pivoted {
  PivotPoses poses;
  PivotOptions options;
  PivotResult result;
};

// Thirty readings, one of which slipped by 5 mm and is left out.
Pivoted Pivot() {
  auto rng = testing::SeededByTest();
  Pivoted pivoted;
  pivoted.poses = testing::WithNoise(
      testing::DrawPivotPoses({}, testing::IsotropicNoise(1e-4, 1e-3), rng), rng);
  pivoted.poses.items[kSlipped].world_from_tool.translation.x() += 5e-3;
  pivoted.poses.items[kSlipped].label = "<b>slipped";
  pivoted.options.reject_outliers = true;
  pivoted.result = CalibratePivot(pivoted.poses, pivoted.options);
  return pivoted;
}

TEST(PivotCharts, ShowEveryReadingAndSetApartWhatWasLeftOut) {
  const Pivoted pivoted = Pivot();
  ASSERT_FALSE(pivoted.result.rows[kSlipped].used);
  const Chart residuals = PivotResidualChart(pivoted.result);
  ASSERT_EQ(residuals.data.size(), 6u);
  const Json &used = residuals.data[2], &left_out = residuals.data[3];  // along y
  EXPECT_EQ(used["name"], "used");
  EXPECT_EQ(used["y"].size(), 29u);
  EXPECT_DOUBLE_EQ(used["y"][7].get<double>(), 1e3 * pivoted.result.rows[8].residual.y());
  EXPECT_EQ(used["x"][7], 9);
  EXPECT_EQ(left_out["name"], "left out");
  EXPECT_EQ(left_out["x"], Json{kSlipped + 1});
  EXPECT_DOUBLE_EQ(left_out["y"][0].get<double>(), 1e3 * pivoted.result.rows[7].residual.y());
  EXPECT_EQ(left_out["text"][0], "&lt;b&gt;slipped");

  const Chart sigmas = PivotSigmasChart(pivoted.result);
  EXPECT_EQ(sigmas.data[1]["y"][0].get<double>(), pivoted.result.rows[7].squared_sigmas);
  EXPECT_NEAR(sigmas.layout["shapes"][0]["y0"].get<double>(), 7.815, 1e-3);
}

// Ties run from the frames to the tips; the pivot is where the truth has it.
TEST(PivotCharts, TheSceneTiesEveryFrameToItsTip) {
  const Pivoted pivoted = Pivot();
  const Chart scene = PivotSceneChart(pivoted.poses, pivoted.result);
  EXPECT_TRUE(scene.is_in_space);
  const Json& ties = scene.data[1];
  EXPECT_EQ(ties["x"].size(), 3u * 29u);
  const Pose3d& first = pivoted.poses.items[0].world_from_tool;
  EXPECT_DOUBLE_EQ(ties["z"][0].get<double>(), 1e3 * first.translation.z());
  EXPECT_TRUE(ties["z"][2].is_null());
  // The longest miss, of some 5 mm, is enlarged to no more than a tenth of the tool's 150 mm.
  EXPECT_THAT(scene.shows, HasSubstr("is 2 times enlarged"));
  EXPECT_DOUBLE_EQ(
      ties["z"][1].get<double>(),
      1e3 * (pivoted.result.x.pivot_in_world + 2.0 * pivoted.result.rows[0].residual).z());
  const Json& pivot = scene.data.back();
  EXPECT_EQ(pivot["name"], "pivot");
  EXPECT_NEAR(pivot["x"][0].get<double>(), 300.0, 1.0);
  EXPECT_NEAR(pivot["z"][0].get<double>(), 1800.0, 1.0);
}

TEST(PivotCharts, TiltsAreInDegreesBesideWhatIsNeeded) {
  Pivoted pivoted = Pivot();
  const Chart tilts = TiltChart(pivoted.result, pivoted.options);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(
        tilts.data[0]["y"][k].get<double>(), 180.0 / M_PI * pivoted.result.tilts.rms[k], 1e-12);
    EXPECT_NEAR(tilts.data[1]["y"][k].get<double>(),
                4.0 * 180.0 / M_PI * pivoted.result.noise_tilts[k],
                1e-12);
    EXPECT_EQ(tilts.table.rows[k].back(), "determined");
  }
  pivoted.result.is_lost[0] = true;
  EXPECT_EQ(TiltChart(pivoted.result, pivoted.options).table.rows[0].back(), "not determined");
}

TEST(PivotHtml, SaysHowSureTheTipIsAndWhatIsNotKnown) {
  Pivoted pivoted = Pivot();
  RunRecord record;
  record.version = "hexcal 1.2.3\n";
  const auto html = [&] {
    return PivotHtml("demo", record, pivoted.poses, pivoted.options, pivoted.result);
  };
  const std::string page = html();
  EXPECT_THAT(page, HasSubstr("id=\"verdict\"><strong>determined</strong>"));
  EXPECT_THAT(page, HasSubstr("&lt;b&gt;slipped"));
  EXPECT_THAT(page, Not(HasSubstr("<b>slipped")));
  EXPECT_THAT(page, HasSubstr("left out"));
  EXPECT_THAT(page, HasSubstr("hexcal 1.2.3"));
  EXPECT_THAT(page,
              HasSubstr(fmt::format("<td class=\"number\">{:.4f}</td>",
                                    1e3 * std::sqrt(pivoted.result.covariance(2, 2)))));
  EXPECT_THAT(page, Not(HasSubstr("not determined")));
  pivoted.result.is_lost[0] = true;
  pivoted.result.tilts.directions = Eigen::Matrix3d::Identity();
  EXPECT_THAT(html(), HasSubstr("<strong>not determined</strong>"));
  pivoted.result.converged = false;
  EXPECT_THAT(html(), HasSubstr("<strong>not converged</strong>"));
}

}  // namespace
}  // namespace hexcal
