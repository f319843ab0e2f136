// SPDX-License-Identifier: BSD-3-Clause
#include "report/coordinate_charts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "config/units.h"
#include "geometry/rotation_angles.h"
#include "testing/audits.h"

namespace hexcal {
namespace {

// By hand: a line, a line downhill, and a parabola about the middle.
TEST(CorrelationOf, IsOfLinesAndOfWhatIsNoLine) {
  EXPECT_NEAR(CorrelationOf({1, 2, 3, 4}, {2, 4, 6, 8}), 1.0, 1e-12);
  EXPECT_NEAR(CorrelationOf({1, 2, 3, 4}, {8, 6, 4, 2}), -1.0, 1e-12);
  EXPECT_NEAR(CorrelationOf({-2, -1, 1, 2}, {4, 1, 1, 4}), 0.0, 1e-12);
  EXPECT_NEAR(CorrelationOf({0, 1, 2}, {0, 0, 1}), std::sqrt(0.75), 1e-12);
  EXPECT_TRUE(std::isnan(CorrelationOf({1, 1}, {2, 3})));
}

// A residual along y that grows with rz, and nothing else: in the right panel and cell.
TEST(CoordinateCharts, ShowWhatFollowsACoordinate) {
  PoseResiduals residuals;
  for (int i = 0; i < 5; ++i) {
    Vector6d pose = Vector6d::Zero(), error = Vector6d::Zero();
    pose << 0.01 * (i % 2), 0.0, 0.2 + 0.01 * (i % 3), 0.0, 0.0, 0.1 * i;
    error[1] = 2e-3 * i;
    residuals.labels.push_back(std::to_string(i));
    residuals.used.push_back(true);
    residuals.coordinates.push_back(pose);
    residuals.after.error.push_back(error);
  }
  const std::vector<Chart> charts = CoordinateCharts(residuals);
  ASSERT_EQ(charts.size(), 2u);
  const Chart& position = charts[0];
  ASSERT_EQ(position.data.size(), 18u);
  const auto& trace = position.data[3 * 5 + 1];
  EXPECT_EQ(trace["xaxis"], "x6");
  EXPECT_EQ(trace["name"], "y");
  EXPECT_NEAR(trace["x"][4].get<double>(), 0.4 * 180.0 / kPi, 1e-9);
  EXPECT_NEAR(trace["y"][4].get<double>(), 8.0, 1e-9);
  EXPECT_EQ(position.table.rows[5], (std::vector<std::string>{"rz", "–", "1.00", "–"}));
  EXPECT_EQ(position.table.rows[1][2], "–");  // y never moves
  EXPECT_EQ(charts[1].table.rows[5][1], "–");
  EXPECT_TRUE(CoordinateCharts({}).empty());
}

// A pose that was left out is drawn, but in no correlation.
TEST(CoordinateCharts, HaveNoPoseThatWasLeftOutInTheirNumbers) {
  PoseResiduals residuals;
  for (int i = 0; i < 6; ++i) {
    Vector6d pose = Vector6d::Zero(), error = Vector6d::Zero();
    pose[0] = 0.01 * i, error[0] = i == 5 ? -1.0 : 1e-4 * i;
    residuals.labels.push_back(std::to_string(i));
    residuals.used.push_back(i != 5);
    residuals.coordinates.push_back(pose);
    residuals.after.error.push_back(error);
  }
  const Chart chart = CoordinateCharts(residuals)[0];
  EXPECT_EQ(chart.data[0]["x"].size(), 6u);
  EXPECT_EQ(chart.table.rows[0][1], "1.00");
}

// What the pictures are drawn from: of a real calibration, pose by pose.
TEST(CoordinateCharts, AreOfTheReportedPoses) {
  const testing::AuditedExample example = testing::AuditExample();
  const PoseResiduals residuals =
      ResidualsOf(example.dataset, example.observations, example.estimate);
  ASSERT_EQ(residuals.coordinates.size(), 60u);
  for (std::size_t i = 0; i < 60; ++i)
    EXPECT_EQ(residuals.coordinates[i],
              VectorFromPose(example.observations.items[i].base_from_platform));
}

}  // namespace
}  // namespace hexcal
