// SPDX-License-Identifier: BSD-3-Clause
#include "model/forward.h"

#include "model/hexapod.h"
#include "testing/hexapods.h"
#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::JacobianNear;
using testing::MatrixNear;
using testing::NumericJacobian;
using testing::PoseNear;
using testing::SeededByTest;

constexpr int kSize = 6 + 18 + 18 + 18;  // legs, joints, three twists

// The corrections that Forward heeds, of these numbers.
Corrections<double> OfNumbers(const Eigen::VectorXd& v) {
  Corrections<double> c;
  c.leg = v.head<6>();
  c.base_joints = Eigen::Map<const Matrix36d>(v.data() + 6);
  c.platform_joints = Eigen::Map<const Matrix36d>(v.data() + 24);
  c.base_twist = v.segment<6>(42);
  c.platform_twist = v.segment<6>(48);
  c.tool_twist = v.segment<6>(54);
  return c;
}

struct Scene {
  HexapodGeometry hexapod = testing::LargeHexapod();
  Mounts mounts;
  Visit visit;

  explicit Scene(std::mt19937_64& rng) {
    mounts = {testing::RandomPose(rng, 2.0), testing::RandomPose(rng, 0.3)};
    visit.base_from_platform = testing::RandomWorkspacePose(rng, testing::kLargeHeight, 0.3);
  }
  ForwardPose Of(const Corrections<double>& c) const { return Forward(mounts, &hexapod, visit, c); }
  Vector6d By(const Corrections<double>& c, const Corrections<double>& motion) const {
    return ForwardDerivative(mounts, &hexapod, visit, c, Of(c), motion);
  }
};

bool SameBits(const Pose3d& a, const Pose3d& b) {
  return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
}

TEST(Forward, WithoutCorrectionsIsEquation1ToTheLastBit) {
  std::mt19937_64 rng = SeededByTest();
  for (int i = 0; i < 100; ++i) {
    const Scene scene(rng);
    for (const HexapodGeometry* hexapod : {&scene.hexapod, (const HexapodGeometry*)nullptr}) {
      const ForwardPose pose = Forward(scene.mounts, hexapod, scene.visit, {});
      EXPECT_TRUE(pose.reached);
      EXPECT_TRUE(SameBits(pose.base_from_platform, scene.visit.base_from_platform));
      EXPECT_TRUE(SameBits(pose.world_from_tool,
                           scene.mounts.world_from_base * scene.visit.base_from_platform *
                               scene.mounts.platform_from_tool));
    }
  }
}

TEST(Forward, PutsThePlatformWhereTheCorrectedLegsAre) {
  std::mt19937_64 rng = SeededByTest();
  for (int i = 0; i < 100; ++i) {
    const Scene scene(rng);
    Eigen::VectorXd v = 5e-3 * testing::Normal(rng, kSize);
    v.tail<18>().setZero();
    const Corrections<double> c = OfNumbers(v);
    const ForwardPose pose = scene.Of(c);
    ASSERT_TRUE(pose.reached);
    for (int leg = 0; leg < kNumLegs; ++leg) {
      const HexapodGeometry& h = scene.hexapod;
      const Eigen::Vector3d a = h.platform_joints_in_platform.col(leg);
      const Eigen::Vector3d b = h.base_joints_in_base.col(leg);
      const double reported = (scene.visit.base_from_platform * a - b).norm();
      const Eigen::Vector3d true_a = a + c.platform_joints.col(leg);
      const Eigen::Vector3d true_b = b + c.base_joints.col(leg);
      EXPECT_NEAR((pose.base_from_platform * true_a - true_b).norm(), reported + c.leg[leg], 1e-11);
    }
  }
}

TEST(Forward, AddsEachTwistOnTheRightOfItsTransform) {
  std::mt19937_64 rng = SeededByTest();
  const Scene scene(rng);
  Eigen::VectorXd v = Eigen::VectorXd::Zero(kSize);
  v.tail<18>() = 0.1 * testing::Normal(rng, 18);
  const Corrections<double> c = OfNumbers(v);
  const Pose3d expected = Plus(scene.mounts.world_from_base, c.base_twist) *
                          Plus(scene.visit.base_from_platform, c.platform_twist) *
                          Plus(scene.mounts.platform_from_tool, c.tool_twist);
  EXPECT_TRUE(PoseNear(scene.Of(c).world_from_tool, expected, 1e-14, 1e-14));
}

TEST(Forward, SaysWhereLegsReachNoPose) {
  std::mt19937_64 rng = SeededByTest();
  const Scene scene(rng);
  Corrections<double> c;
  c.leg[2] = 3.0;
  EXPECT_FALSE(scene.Of(c).reached);
}

// At zero, at sizes of real machines, and far beyond them.
TEST(Forward, DerivativesAreThoseOfDifferences) {
  std::mt19937_64 rng = SeededByTest();
  for (const double size : {0.0, 1e-4, 1e-2}) {
    for (int i = 0; i < 10; ++i) {
      const Scene scene(rng);
      const Eigen::VectorXd v = size * testing::Normal(rng, kSize);
      const Corrections<double> c = OfNumbers(v);
      const ForwardPose at = scene.Of(c);
      ASSERT_TRUE(at.reached);
      const Eigen::MatrixXd numeric = NumericJacobian(
          [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
            return Minus(scene.Of(OfNumbers(v + d)).world_from_tool, at.world_from_tool);
          },
          kSize,
          1e-5);
      Eigen::MatrixXd analytic(6, kSize);
      for (int k = 0; k < kSize; ++k)
        analytic.col(k) = scene.By(c, OfNumbers(Eigen::VectorXd::Unit(kSize, k)));
      EXPECT_TRUE(JacobianNear(analytic, numeric, 1e-7)) << size;
    }
  }
}

TEST(Forward, DerivativesByMountsAreThoseOfDifferences) {
  std::mt19937_64 rng = SeededByTest();
  for (const double size : {0.0, 1e-2, 0.3}) {
    const Scene scene(rng);
    Eigen::VectorXd v = Eigen::VectorXd::Zero(kSize);
    v.tail<18>() = size * testing::Normal(rng, 18);
    const Corrections<double> c = OfNumbers(v);
    const ForwardPose at = scene.Of(c);
    const Eigen::MatrixXd numeric = NumericJacobian(
        [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
          Scene moved = scene;
          moved.mounts = {Plus(scene.mounts.world_from_base, Vector6d(d.head<6>())),
                          Plus(scene.mounts.platform_from_tool, Vector6d(d.tail<6>()))};
          return Minus(moved.Of(c).world_from_tool, at.world_from_tool);
        },
        12);
    EXPECT_TRUE(JacobianNear(ForwardByMounts(scene.mounts, c, at), numeric, 1e-8)) << size;
  }
}

// Joints that move together are a base that stands elsewhere: no data can tell the two apart.
TEST(Forward, MovesOfAllBaseJointsAreThoseOfTheBase) {
  std::mt19937_64 rng = SeededByTest();
  for (int i = 0; i < 50; ++i) {
    const Scene scene(rng);
    const Pose3d base_from_joints = testing::SmallPose(rng, 0.02, 0.02);
    Corrections<double> joints;
    for (int leg = 0; leg < kNumLegs; ++leg) {
      const Eigen::Vector3d b = scene.hexapod.base_joints_in_base.col(leg);
      joints.base_joints.col(leg) = base_from_joints * b - b;
    }
    const Corrections<double> base = OfNumbers((Eigen::VectorXd(kSize) << Eigen::VectorXd::Zero(42),
                                                Minus(base_from_joints, Pose3d()),
                                                Eigen::VectorXd::Zero(12))
                                                   .finished());
    EXPECT_TRUE(
        PoseNear(scene.Of(joints).world_from_tool, scene.Of(base).world_from_tool, 1e-10, 1e-10));
  }
}

TEST(Forward, MovesOfAllPlatformJointsAreThoseOfTheToolTheOtherWay) {
  std::mt19937_64 rng = SeededByTest();
  for (int i = 0; i < 50; ++i) {
    const Scene scene(rng);
    const Pose3d platform_from_joints = testing::SmallPose(rng, 0.02, 0.02);
    Corrections<double> joints;
    for (int leg = 0; leg < kNumLegs; ++leg) {
      const Eigen::Vector3d a = scene.hexapod.platform_joints_in_platform.col(leg);
      joints.platform_joints.col(leg) = platform_from_joints * a - a;
    }
    Scene moved = scene;
    moved.mounts.platform_from_tool =
        platform_from_joints.Inverse() * scene.mounts.platform_from_tool;
    EXPECT_TRUE(
        PoseNear(scene.Of(joints).world_from_tool, moved.Of({}).world_from_tool, 1e-10, 1e-10));
  }
}

}  // namespace
}  // namespace hexcal
