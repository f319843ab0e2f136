// SPDX-License-Identifier: BSD-3-Clause
#include "report/pose_design.h"

#include <gtest/gtest.h>

#include <cmath>

#include "config/units.h"
#include "testing/random.h"

namespace hexcal {
namespace {

Observations Turned(const Eigen::Quaterniond& mean, const std::vector<Eigen::Vector3d>& rotations) {
  Observations observations;
  for (const Eigen::Vector3d& rotation : rotations) {
    Observation o;
    o.base_from_platform.translation = rotation;
    o.base_from_platform.rotation = mean * Exp(rotation);
    observations.items.push_back(o);
  }
  return observations;
}

// Four rotations of a about x and b about y, there and back: RMS a / sqrt(2) and b / sqrt(2), axes
// at a right angle, whatever the mean orientation.
TEST(PoseDesign, MainAxesAreThoseOfTheRotations) {
  auto rng = testing::SeededByTest();
  const double a = 0.2, b = 0.1;
  const PoseDesign design = PoseDesignOf({},
                                         Turned(testing::RandomPose(rng, 0.1).rotation,
                                                {{a, 0, 0}, {-a, 0, 0}, {0, b, 0}, {0, -b, 0}}));
  EXPECT_NEAR(design.rotation_rms[0], a / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(design.rotation_rms[1], b / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(design.rotation_rms[2], 0.0, 1e-7);
  EXPECT_NEAR(std::abs(design.main_axes(0, 0)), 1.0, 1e-12);
  EXPECT_NEAR(std::abs(design.main_axes(1, 1)), 1.0, 1e-12);
}

// Axes are lines: opposite senses count as one axis. The smaller half has no say.
TEST(PoseDesign, AngleBetweenAxesIsThatOfTheLargeRotations) {
  const Eigen::Vector3d x(0.2, 0, 0);
  const Eigen::Vector3d tilted(0.2 * std::cos(0.5), 0.2 * std::sin(0.5), 0);
  const Eigen::Vector3d small(0, 0, 0.01);
  const PoseDesign two = PoseDesignOf(
      {}, Turned(Eigen::Quaterniond::Identity(), {x, -x, tilted, -tilted, small, -small}));
  EXPECT_NEAR(two.angle_between_axes, 0.5, 1e-9);
  const PoseDesign one = PoseDesignOf({}, Turned(Eigen::Quaterniond::Identity(), {x, -x, x, -x}));
  EXPECT_NEAR(one.angle_between_axes, 0.0, 1e-7);
  // One far larger than the others is no reason to compare none.
  const PoseDesign uneven =
      PoseDesignOf({}, Turned(Eigen::Quaterniond::Identity(), {4.0 * x, small, x, tilted}));
  EXPECT_GT(uneven.angle_between_axes, 0.1);
  const PoseDesign none = PoseDesignOf(
      {},
      Turned(Eigen::Quaterniond::Identity(), {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()}));
  EXPECT_EQ(none.angle_between_axes, 0.0);
}

// Legs of a known hexapod against their limits: the table says which part of a range is covered.
TEST(PoseDesign, TableHasRangesOfPosesAndLegs) {
  const Dataset dataset =
      ReadDataset(std::string(HEXCAL_EXAMPLES) + "/neurobot/dataset.yaml", true);
  const Observations observations = MakeObservations(dataset);
  const PoseDesign design = PoseDesignOf(dataset, observations);
  ASSERT_EQ(design.legs.size(), observations.items.size());
  ASSERT_TRUE(design.leg_limits.has_value());
  for (int leg = 0; leg < 6; ++leg) {
    EXPECT_GE(design.leg_span[leg][0], (*design.leg_limits)[0]);
    EXPECT_LE(design.leg_span[leg][1], (*design.leg_limits)[1]);
    EXPECT_LT(design.leg_span[leg][0], design.leg_span[leg][1]);
  }
  auto box = design.span;
  box[0] = {2.0 * design.span[0][0], 2.0 * design.span[0][1]};  // twice as wide
  const auto charts = PoseDesignCharts(design, MakeWorkspace(box, observations));
  ASSERT_EQ(charts.size(), 2u);
  const auto& rows = charts[0].table.rows;
  ASSERT_EQ(rows.size(), 12u);
  EXPECT_EQ(rows[0].front(), "x, mm");
  EXPECT_EQ(rows[0].back(), "50 %");
  EXPECT_EQ(rows[1].back(), "100 %");
  EXPECT_EQ(rows[6].front(), "leg 1, mm");

  // Of the range is covered what poses and range share, at most all of it.
  const double width = design.span[0][1] - design.span[0][0];
  box[0] = {design.span[0][0] + 0.75 * width, design.span[0][1] + 0.25 * width};
  box[1] = {design.span[1][0] - 9.0, design.span[1][0] - 8.0};
  box[2] = {0.5 * (design.span[2][0] + design.span[2][1]), design.span[2][1]};
  const auto shared = PoseDesignCharts(design, MakeWorkspace(box, observations))[0].table.rows;
  EXPECT_EQ(shared[0].back(), "50 %");
  EXPECT_EQ(shared[1].back(), "0 %");
  EXPECT_EQ(shared[2].back(), "100 %");
}

}  // namespace
}  // namespace hexcal
