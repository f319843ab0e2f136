// SPDX-License-Identifier: BSD-3-Clause
#include "report/scene.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  const Chart chart = SceneChart(scene);
  EXPECT_TRUE(chart.is_in_space);
  const std::string data = chart.data.dump();
  EXPECT_EQ(data.find("<b>"), std::string::npos);
  EXPECT_EQ(data.find("<i>"), std::string::npos);
  EXPECT_THAT(chart.shows, HasSubstr("times enlarged"));
  EXPECT_EQ(chart.table.rows.size(), 60u);
}

TEST_F(SceneTest, TheWordsNameOnlyWhatIsDrawn) {
  Scene scene = Make();
  EXPECT_THAT(SceneChart(scene).shows, HasSubstr("frames W, B, A and T, legs, markers at pose"));
  scene.legs.clear();
  EXPECT_THAT(SceneChart(scene).shows, HasSubstr("frames W, B, A and T, markers at pose"));
  scene.markers.clear();
  EXPECT_THAT(SceneChart(scene).shows, HasSubstr("frames W, B, A and T at pose"));
  EXPECT_THAT(SceneChart(scene).shows, HasSubstr("ellipsoid"));
  scene.covariance.setZero();
  EXPECT_THAT(SceneChart(scene).shows, Not(HasSubstr("ellipsoid")));
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
  const Chart chart = SceneChart(scene);
  EXPECT_THAT(chart.shows, HasSubstr("before and after what was found"));
  EXPECT_EQ(chart.table.rows[3].size(), 7u);
  EXPECT_EQ(chart.table.rows[3][4], fmt::format("{:.4f}", 1e3 * scene.arrows[3].before->x()));
  discovery.effects.clear();
  EXPECT_FALSE(MakeScene(testing::DatasetOf(discovery), discovery).arrows[0].before.has_value());
}

// All points are within the ranges, and a mm is as long along each axis.
TEST_F(SceneTest, TheBoxHoldsAllPointsAtOneScale) {
  const Chart chart = SceneChart(Make());
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

// No noise, no legs: still a picture, without numbers that are none.
TEST_F(SceneTest, OfExactDataHasNoInfinity) {
  Scene scene = Make();
  scene.legs.clear(), scene.markers.clear();
  scene.covariance.setZero();
  for (Scene::Arrow& arrow : scene.arrows) arrow.along.setZero();
  for (const auto& trace : SceneChart(scene).data)
    for (const auto& x : trace["x"]) EXPECT_TRUE(x.is_null() || std::isfinite(x.get<double>()));
}

}  // namespace
}  // namespace hexcal
