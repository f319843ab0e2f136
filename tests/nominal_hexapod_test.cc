// SPDX-License-Identifier: BSD-3-Clause
#include "model/nominal_hexapod.h"

#include <gtest/gtest.h>

#include <cmath>

#include "testing/matchers.h"

namespace hexcal {
namespace {

using testing::MatrixNear;

NominalHexapod Example() {
  NominalHexapod nominal;
  nominal.base_radius = 0.5, nominal.platform_radius = 0.3;
  nominal.base_half_angle = 0.2, nominal.platform_half_angle = 0.1;
  nominal.base_height = -0.6, nominal.platform_height = -0.05;
  nominal.yaw = 0.4;
  return nominal;
}

Eigen::Matrix3d TurnAboutZ(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

TEST(NominalHexapod, ItsPlatesAreCirclesAtTheirHeights) {
  const HexapodGeometry hexapod = MakeHexapod(Example());
  for (int i = 0; i < kNumLegs; ++i) {
    const Eigen::Vector3d b = hexapod.base_joints_in_base.col(i),
                          a = hexapod.platform_joints_in_platform.col(i);
    EXPECT_NEAR(b.head<2>().norm(), 0.5, 1e-15);
    EXPECT_NEAR(a.head<2>().norm(), 0.3, 1e-15);
    EXPECT_EQ(b.z(), -0.6);
    EXPECT_EQ(a.z(), -0.05);
  }
}

TEST(NominalHexapod, AThirdOfATurnMovesEveryLegToTheNextPair) {
  const HexapodGeometry hexapod = MakeHexapod(Example());
  const Eigen::Matrix3d turn = TurnAboutZ(2.0 * M_PI / 3.0);
  for (int i = 0; i < kNumLegs; ++i) {
    const int next = (i + 2) % kNumLegs;
    EXPECT_TRUE(MatrixNear(Eigen::Vector3d(turn * hexapod.base_joints_in_base.col(i)),
                           Eigen::Vector3d(hexapod.base_joints_in_base.col(next)),
                           1e-15));
    EXPECT_TRUE(MatrixNear(Eigen::Vector3d(turn * hexapod.platform_joints_in_platform.col(i)),
                           Eigen::Vector3d(hexapod.platform_joints_in_platform.col(next)),
                           1e-15));
  }
}

// Chords of the half angles; pairs of the platform are of legs from neighbouring pairs of the base.
TEST(NominalHexapod, PairsAreAsFarApartAsTheirAnglesSay) {
  const HexapodGeometry hexapod = MakeHexapod(Example());
  const Matrix36d &base = hexapod.base_joints_in_base,
                  &platform = hexapod.platform_joints_in_platform;
  EXPECT_NEAR((base.col(0) - base.col(1)).norm(), 2.0 * 0.5 * std::sin(0.2), 1e-15);
  EXPECT_NEAR((platform.col(1) - platform.col(2)).norm(), 2.0 * 0.3 * std::sin(0.1), 1e-15);
  EXPECT_NEAR((platform.col(5) - platform.col(0)).norm(), 2.0 * 0.3 * std::sin(0.1), 1e-15);
  const Eigen::Vector3d pair = base.col(0) + base.col(1);
  EXPECT_NEAR(std::atan2(pair.y(), pair.x()), 0.4, 1e-15);
}

}  // namespace
}  // namespace hexcal
