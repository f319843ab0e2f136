// SPDX-License-Identifier: BSD-3-Clause
// Poses within reach. Joint angles beyond a turn of 30 degrees are not looked at.
#include "discovery/pose_pool.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/hexapod.h"
#include "testing/hexapods.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using ::hexcal::testing::SeededByTest;
using ::hexcal::testing::SmallPose;

template <typename Rng>
std::vector<Pose3d> Measured(Rng& rng, int count) {
  std::vector<Pose3d> poses;
  for (int i = 0; i < count; ++i) {
    poses.push_back(SmallPose(rng, 0.01, 0.05));
    poses.back().translation.z() += testing::kSmallHeight;
  }
  return poses;
}

bool AreEqual(const Pose3d& a, const Pose3d& b) {
  return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
}

TEST(PosePool, WithLimitsLegsReachEveryPoseAndSomeStandAtALimit) {
  auto rng = SeededByTest();
  HexapodGeometry hexapod = testing::SmallHexapod();
  hexapod.leg_limits = Eigen::Vector2d(0.22, 0.32);
  const Reach reach = ReachOf(&hexapod, Measured(rng, 20));
  int at_limit = 0, beyond_measured = 0;
  for (const Pose3d& pose : MakePosePool(reach, 300, 1)) {
    const LegLengths lengths = InverseKinematics(hexapod, pose);
    EXPECT_GE(lengths.minCoeff(), 0.22 - 1e-8);
    EXPECT_LE(lengths.maxCoeff(), 0.32 + 1e-8);
    EXPECT_LE(Log(pose.rotation).cwiseAbs().maxCoeff(), M_PI / 6.0 + 0.05);
    if (lengths.minCoeff() < 0.22 + 1e-6 || lengths.maxCoeff() > 0.32 - 1e-6) ++at_limit;
    if (Log(pose.rotation).norm() > 0.2) ++beyond_measured;
  }
  EXPECT_GT(at_limit, 50);
  EXPECT_GT(beyond_measured, 50);
}

TEST(PosePool, WithoutLimitsItStaysWhereTheMeasuredPosesWere) {
  auto rng = SeededByTest();
  const std::vector<Pose3d> measured = Measured(rng, 30);
  const HexapodGeometry hexapod = testing::SmallHexapod();
  double shortest = 1.0, longest = 0.0;
  for (const Pose3d& pose : measured) {
    shortest = std::min(shortest, InverseKinematics(hexapod, pose).minCoeff());
    longest = std::max(longest, InverseKinematics(hexapod, pose).maxCoeff());
  }
  for (const bool has_hexapod : {false, true}) {
    const Reach reach = ReachOf(has_hexapod ? &hexapod : nullptr, measured);
    int on_edge = 0;
    for (const Pose3d& pose : MakePosePool(reach, 200, 2)) {
      Vector6d from_home;
      from_home << pose.translation - reach.home.translation,
          Log(Eigen::Quaterniond(reach.home.rotation.conjugate() * pose.rotation));
      EXPECT_TRUE((from_home.array() >= reach.low.array() - 1e-12).all());
      EXPECT_TRUE((from_home.array() <= reach.high.array() + 1e-12).all());
      if ((from_home - reach.low).cwiseAbs().minCoeff() < 1e-9) ++on_edge;
      if (!has_hexapod) continue;
      EXPECT_GE(InverseKinematics(hexapod, pose).minCoeff(), shortest - 1e-8);
      EXPECT_LE(InverseKinematics(hexapod, pose).maxCoeff(), longest + 1e-8);
    }
    if (!has_hexapod) {
      EXPECT_GT(on_edge, 60);
    }
  }
}

TEST(PosePool, TheBoxIsFilledEvenly) {
  auto rng = SeededByTest();
  const Reach reach = ReachOf(nullptr, Measured(rng, 30));
  // Of the poses inside the box, each half of each coordinate has half.
  Vector6d below = Vector6d::Zero();
  const std::vector<Pose3d> pool = MakePosePool(reach, 400, 3);
  for (std::size_t i = 0; i < pool.size(); i += 2) {
    Vector6d from_home;
    from_home << pool[i].translation - reach.home.translation,
        Log(Eigen::Quaterniond(reach.home.rotation.conjugate() * pool[i].rotation));
    below += (from_home.array() < 0.5 * (reach.low + reach.high).array()).cast<double>().matrix();
  }
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(below[k], 100.0, 8.0) << k;
}

TEST(PosePool, NoPoseComesTwice) {
  auto rng = SeededByTest();
  const std::vector<Pose3d> pool = MakePosePool(ReachOf(nullptr, Measured(rng, 10)), 1000, 5);
  ASSERT_EQ(pool.size(), 1000u);
  for (std::size_t i = 0; i < pool.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) ASSERT_FALSE(AreEqual(pool[i], pool[k])) << i << " " << k;
}

TEST(PosePool, EqualSeedsGiveEqualPoses) {
  auto rng = SeededByTest();
  const Reach reach = ReachOf(nullptr, Measured(rng, 10));
  const auto once = MakePosePool(reach, 50, 7), again = MakePosePool(reach, 50, 7),
             other = MakePosePool(reach, 50, 8);
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_TRUE(AreEqual(once[i], again[i]));
    if (i % 2 == 0) {
      EXPECT_FALSE(AreEqual(once[i], other[i]));
    }
  }
}

TEST(PosePool, PosesKeepAwayFromSingularOnes) {
  // Legs without narrow limits could turn the platform until they line up.
  auto rng = SeededByTest();
  HexapodGeometry hexapod = testing::SmallHexapod();
  hexapod.leg_limits = Eigen::Vector2d(0.05, 0.6);
  const Reach reach = ReachOf(&hexapod, Measured(rng, 20));
  const double home = LegJacobian(hexapod, reach.home).determinant();
  for (const Pose3d& pose : MakePosePool(reach, 200, 4))
    EXPECT_GE(LegJacobian(hexapod, pose).determinant() / home, 0.3 - 1e-9);
}

}  // namespace
}  // namespace hexcal
