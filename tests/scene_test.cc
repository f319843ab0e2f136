// SPDX-License-Identifier: BSD-3-Clause
#include "report/scene.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/hexapod.h"
#include "testing/audits.h"
#include "testing/discoveries.h"
#include "testing/matchers.h"

namespace hexcal {
namespace {

using ::hexcal::testing::MatrixNear;
using ::testing::HasSubstr;
using ::testing::Not;

class SceneTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { example = new testing::AuditedExample(testing::AuditExample()); }
  static void TearDownTestSuite() { delete example; }
  static Scene Make() {
    return MakeScene(example->dataset, example->observations, example->estimate);
  }
  static testing::AuditedExample* example;
};
testing::AuditedExample* SceneTest::example = nullptr;

TEST_F(SceneTest, ArrowsAreMeasuredMinusPredictedInTheWorld) {
  const Scene scene = Make();
  ASSERT_EQ(scene.arrows.size(), 60u);
  const BaseAndTool& mounts = example->estimate.mounts;
  for (int i = 0; i < 60; ++i) {
    const Observation& o = example->observations.items[i];
    const Eigen::Vector3d predicted =
        (mounts.world_from_base * o.base_from_platform * mounts.platform_from_tool).translation;
    EXPECT_TRUE(MatrixNear(scene.arrows[i].from, predicted, 1e-12));
    EXPECT_TRUE(MatrixNear(
        scene.arrows[i].from + scene.arrows[i].along, o.world_from_tool.translation, 1e-9));
  }
}

// Legs end at their joints: as long as inverse kinematics has them.
TEST_F(SceneTest, LegsAndMarkersStandWhereTheyAre) {
  const Scene scene = Make();
  ASSERT_EQ(scene.legs.size(), 6u);
  const Pose3d base_from_platform = scene.world_from_base.Inverse() * scene.world_from_platform;
  const LegLengths lengths = InverseKinematics(*example->dataset.hexapod, base_from_platform);
  for (int leg = 0; leg < 6; ++leg)
    EXPECT_NEAR((scene.legs[leg].second - scene.legs[leg].first).norm(), lengths[leg], 1e-12);
  ASSERT_EQ(scene.markers.size(), 6u);
  EXPECT_EQ(scene.markers[0].first, "base/b1");
  EXPECT_TRUE(MatrixNear(scene.markers[0].second, Eigen::Vector3d(-0.208, -0.12, 0.0), 1e-12));
  EXPECT_EQ(scene.markers[5].first, "tool/t3");
  EXPECT_TRUE(MatrixNear(
      scene.markers[5].second, scene.world_from_tool * Eigen::Vector3d(0.0, 0.08, 0.0), 1e-12));
}

TEST_F(SceneTest, EllipsoidIsThatOfTheOriginOfTheTool) {
  const Scene scene = Make();
  const TargetCovariance at =
      TargetError(example->estimate, {})
          .At(scene.world_from_base.Inverse() * scene.world_from_platform, Eigen::Vector3d::Zero());
  EXPECT_TRUE(MatrixNear(scene.covariance, at.total, 1e-15));
}

TEST_F(SceneTest, NamesAreEscapedAndFactorsAreSaid) {
  Scene scene = Make();
  scene.markers[0].first = "<b>";
  scene.arrows[0].label = "<i>";
  const std::vector<Chart> charts = SceneCharts(scene);
  ASSERT_EQ(charts.size(), 2u);
  for (const Chart& chart : charts) {
    EXPECT_TRUE(chart.is_in_space);
    const std::string data = chart.data.dump();
    EXPECT_EQ(data.find("<b>"), std::string::npos);
    EXPECT_EQ(data.find("<i>"), std::string::npos);
  }
  EXPECT_THAT(charts[1].shows, HasSubstr("times enlarged"));
  EXPECT_EQ(charts[1].table.rows.size(), 60u);
}

TEST_F(SceneTest, TheWordsNameOnlyWhatIsDrawn) {
  Scene scene = Make();
  const auto shows = [&](int i) { return SceneCharts(scene)[i].shows; };
  EXPECT_THAT(
      shows(0),
      HasSubstr("frames W, B, A and T, legs, outlines of base and platform, markers at pose"));
  scene.legs.clear();
  EXPECT_THAT(shows(0), HasSubstr("frames W, B, A and T, markers at pose"));
  scene.markers.clear();
  EXPECT_THAT(shows(0), HasSubstr("frames W, B, A and T at pose"));
  EXPECT_THAT(shows(1), HasSubstr("ellipsoid"));
  scene.covariance.setZero();
  EXPECT_THAT(shows(1), Not(HasSubstr("ellipsoid")));
}

// Of a discovery every pose has two arrows, turned from the tool's axes into the world's.
TEST(SceneOfADiscovery, HasArrowsBeforeAndAfter) {
  Discovery discovery = testing::MakeDiscovery();
  const Eigen::Quaterniond turn = Exp(Eigen::Vector3d(0.3, -0.2, 0.9));
  for (Observation& o : discovery.observations.items)
    o.base_from_platform.rotation = o.world_from_tool.rotation = turn;
  const Scene scene = MakeScene(testing::DatasetOf(discovery), discovery);
  ASSERT_EQ(scene.arrows.size(), discovery.poses.size());
  for (std::size_t i = 0; i < scene.arrows.size(); ++i) {
    const PoseGap& pose = discovery.poses[i];
    ASSERT_TRUE(scene.arrows[i].before.has_value());
    EXPECT_TRUE(
        MatrixNear(*scene.arrows[i].before, turn * Eigen::Vector3d(pose.before.head<3>()), 1e-15));
    EXPECT_TRUE(
        MatrixNear(scene.arrows[i].along, turn * Eigen::Vector3d(pose.after.head<3>()), 1e-15));
  }
  const Chart chart = SceneCharts(scene)[1];
  EXPECT_THAT(chart.shows, HasSubstr("before and after what was found"));
  EXPECT_EQ(chart.table.rows[3].size(), 7u);
  EXPECT_EQ(chart.table.rows[3][4], fmt::format("{:.4f}", 1e3 * scene.arrows[3].before->x()));
  discovery.effects.clear();
  EXPECT_FALSE(MakeScene(testing::DatasetOf(discovery), discovery).arrows[0].before.has_value());
}

void ExpectBoxAtOneScale(const Chart& chart) {
  const auto& scene = chart.layout["scene"];
  double diagonal = 0.0;
  std::vector<double> scales;
  for (const std::string axis : {"x", "y", "z"}) {
    const auto& range = scene[axis + "axis"]["range"];
    const double low = range[0], high = range[1], ratio = scene["aspectratio"][axis];
    for (const auto& trace : chart.data)
      for (const auto& x : trace[axis])
        if (!x.is_null()) {
          EXPECT_GT(x.get<double>(), low);
          EXPECT_LT(x.get<double>(), high);
        }
    scales.push_back(ratio / (high - low));
    diagonal += ratio * ratio;
  }
  EXPECT_NEAR(scales[0], scales[1], 1e-12 * scales[0]);
  EXPECT_NEAR(scales[0], scales[2], 1e-12 * scales[0]);
  EXPECT_NEAR(diagonal, 4.0, 1e-12);
}

// All points are within the ranges, and a mm is as long along each axis.
TEST_F(SceneTest, TheBoxHoldsAllPointsAtOneScale) {
  for (const Chart& chart : SceneCharts(Make())) ExpectBoxAtOneScale(chart);
}

// What is to be read is not a clot: the longest arrow and the ellipsoid are a good part of the
// picture that they are in, which is of the poses, not of the machine.
TEST_F(SceneTest, ArrowsAndEllipsoidAreLargeInTheirPicture) {
  const Chart chart = SceneCharts(Make())[1];
  const auto extent = [](const nlohmann::ordered_json& trace, const char* axis) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const auto& x : trace[axis])
      if (!x.is_null())
        low = std::min(low, x.get<double>()), high = std::max(high, x.get<double>());
    return Eigen::Vector2d(low, high);
  };
  double box = 0.0, arrow = 0.0, ellipsoid = 0.0;
  for (const char* axis : {"x", "y", "z"}) {
    const auto& range = chart.layout["scene"][std::string(axis) + "axis"]["range"];
    box = std::max(box, range[1].get<double>() - range[0].get<double>());
  }
  for (const auto& trace : chart.data) {
    const std::string name = trace["name"];
    if (name.rfind("95 %", 0) == 0)
      for (const char* axis : {"x", "y", "z"}) {
        const Eigen::Vector2d ends = extent(trace, axis);
        ellipsoid = std::max(ellipsoid, ends[1] - ends[0]);
      }
    if (name.rfind("left over", 0) == 0)
      for (std::size_t i = 0; i + 1 < trace["x"].size(); i += 3) {
        Eigen::Vector3d along;
        for (int k = 0; k < 3; ++k) {
          const auto& list = trace[std::string(1, "xyz"[k])];
          along[k] = list[i + 1].get<double>() - list[i].get<double>();
        }
        arrow = std::max(arrow, along.norm());
      }
  }
  EXPECT_GT(arrow, 0.05 * box);
  EXPECT_GT(ellipsoid, 0.05 * box);
  EXPECT_LT(ellipsoid, 0.8 * box);
}

// From joint to joint of the platform; seen from above it goes round once and does not cross
// itself.
TEST_F(SceneTest, TheOutlineOfThePlatformGoesRoundOnce) {
  const Scene scene = Make();
  const Chart chart = SceneCharts(scene)[0];
  for (const auto& trace : chart.data) {
    if (trace["name"] != "platform") continue;
    ASSERT_EQ(trace["x"].size(), 7u);
    const Pose3d platform_from_world = scene.world_from_platform.Inverse();
    std::vector<Eigen::Vector3d> corners;  // m, frame W
    for (int i = 0; i < 7; ++i)
      corners.push_back(1e-3 * Eigen::Vector3d(trace["x"][i].get<double>(),
                                               trace["y"][i].get<double>(),
                                               trace["z"][i].get<double>()));
    EXPECT_TRUE(MatrixNear(corners[6], corners[0], 1e-12));
    for (int i = 0; i < 6; ++i) {
      const Eigen::Vector3d here = platform_from_world * corners[i];
      EXPECT_GT(here.cross(platform_from_world * corners[i + 1]).z(), 0.0);
      EXPECT_TRUE(std::any_of(scene.legs.begin(), scene.legs.end(), [&](const auto& leg) {
        return (leg.second - corners[i]).norm() < 1e-9;
      })) << i;
    }
    return;
  }
  FAIL() << "no outline";
}

// No noise, no legs: still a picture, without numbers that are none.
TEST_F(SceneTest, OfExactDataHasNoInfinity) {
  Scene scene = Make();
  scene.legs.clear(), scene.markers.clear();
  scene.covariance.setZero();
  for (Scene::Arrow& arrow : scene.arrows) arrow.along.setZero();
  for (const Chart& chart : SceneCharts(scene))
    for (const auto& trace : chart.data)
      for (const auto& x : trace["x"]) EXPECT_TRUE(x.is_null() || std::isfinite(x.get<double>()));
}

}  // namespace
}  // namespace hexcal
