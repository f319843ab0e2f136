// SPDX-License-Identifier: BSD-3-Clause
#include "report/point_validation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/rotation_angles.h"

namespace hexcal {
namespace {

// Poses at the origin of W but for the tool's rotation about z by quarter turns.
struct Scene {
  Observations observations;
  std::vector<PoseCheck> checks;

  void Add(const Pose3d& reported, const Pose3d& measured, const Vector6d& held_out) {
    Observation o;
    o.label = std::to_string(checks.size());
    o.base_from_platform = reported;
    o.world_from_tool = measured;
    observations.items.push_back(o);
    PoseCheck check;
    check.label = o.label;
    check.held_out = held_out;
    checks.push_back(check);
  }
};

Pose3d Turned(double angle, double x) {
  return {{x, 0.0, 0.0}, Exp(Eigen::Vector3d(0.0, 0.0, angle))};
}

Vector6d HeldOut(double x, double y, double rx) {
  return (Vector6d() << x, y, 0.0, rx, 0.0, 0.0).finished();
}

// By hand: 1 mm along x of W seen from a tool that is turned by 90 degrees is -1 mm along its y.
TEST(PointValidation, BiasAndPrecisionAreInTheAxesOfTheWorld) {
  Scene scene;
  scene.Add(Turned(0.0, 0.1), Turned(0.0, 0.1), HeldOut(1e-3, 0.0, 0.0));
  scene.Add(Turned(M_PI_2, 0.2), Turned(M_PI_2, 0.2), HeldOut(0.0, -3e-3, 0.0));
  const PointValidation v =
      ValidatePoint(scene.checks, scene.observations, {}, Eigen::Vector3d::Zero());
  EXPECT_EQ(v.poses, 2);
  EXPECT_NEAR((v.bias - Eigen::Vector3d(2e-3, 0, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((v.precision - Eigen::Vector3d(std::sqrt(2.0) * 1e-3, 0, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(v.BiasUncertainty().x(), 1e-3, 1e-12);
  EXPECT_NEAR(v.rms, std::sqrt(5.0) * 1e-3, 1e-12);
  EXPECT_FALSE(v.repeated);
}

// By hand: a rotation of 2 mrad about x moves a point 0.1 m along z by -0.2 mm along y.
TEST(PointValidation, ARotationActsByItsLever) {
  Scene scene;
  scene.Add(Turned(0.0, 0.1), Turned(0.0, 0.1), HeldOut(0.0, 0.0, 2e-3));
  scene.Add(Turned(0.0, 0.2), Turned(0.0, 0.2), HeldOut(0.0, 0.0, 2e-3));
  const PointValidation v = ValidatePoint(scene.checks, scene.observations, {}, {0, 0, 0.1});
  EXPECT_NEAR((v.bias - Eigen::Vector3d(0, -2e-4, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(v.precision.norm(), 0.0, 1e-12);
}

// By hand: visits 2 and 4 mm beyond where they are predicted: barycentre 3 mm, both 1 mm from it.
// Of the second pose, thrice at 0, 0 and 3 mm: barycentre 1 mm, distances 1, 1, 2, their mean 4/3,
// their deviation 1/sqrt(3).
TEST(PointValidation, RepeatedPosesHaveAccuracyAndRepeatability) {
  Scene scene;
  for (const double x : {0.002, 0.004})
    scene.Add(Turned(0.0, 0.1), Turned(0.0, 0.1 + x), Vector6d::Zero());
  PointValidation v = ValidatePoint(scene.checks, scene.observations, {}, Eigen::Vector3d::Zero());
  ASSERT_TRUE(v.repeated);
  EXPECT_EQ(v.repeated->poses, 1);
  EXPECT_EQ(v.repeated->fewest, 2);
  EXPECT_NEAR(v.repeated->accuracy, 3e-3, 1e-12);
  EXPECT_NEAR(v.repeated->repeatability, 1e-3, 1e-9);
  for (const double x : {0.0, 0.0, 0.003})
    scene.Add(Turned(0.0, 0.2), Turned(0.0, 0.2 + x), Vector6d::Zero());
  v = ValidatePoint(scene.checks, scene.observations, {}, Eigen::Vector3d::Zero());
  EXPECT_EQ(v.repeated->poses, 2);
  EXPECT_EQ(v.repeated->fewest, 2);
  EXPECT_NEAR(v.repeated->accuracy, 3e-3, 1e-12);  // of the first
  EXPECT_NEAR(v.repeated->repeatability, (4.0 / 3.0 + std::sqrt(3.0)) * 1e-3, 1e-12);
}

TEST(PointValidation, IsWithoutWhatWasLeftOut) {
  Scene scene;
  scene.Add(Turned(0.0, 0.1), Turned(0.0, 0.1), HeldOut(1.0, 0.0, 0.0));
  scene.Add(Turned(0.0, 0.2), Turned(0.0, 0.2), HeldOut(1e-3, 0.0, 0.0));
  Estimate estimate;
  estimate.poses.resize(2);
  estimate.poses[0].label = "0", estimate.poses[0].weight = 0.0;
  estimate.poses[1].label = "1";
  const auto used = UsedOf(scene.checks, estimate);
  ASSERT_EQ(used.size(), 1u);
  EXPECT_EQ(used[0].label, "1");
}

}  // namespace
}  // namespace hexcal
