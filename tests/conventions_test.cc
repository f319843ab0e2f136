// SPDX-License-Identifier: BSD-3-Clause
// A robot's poses read by a wrong convention: the right one is found, and the right one is left
// alone.
#include "estimator/conventions.h"

#include <gtest/gtest.h>

#include "config/units.h"
#include "geometry/quaternion_order.h"
#include "geometry/rotation_order.h"
#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::Normal;
using testing::SeededByTest;
using testing::Uniform;
using testing::UniformVector;
using Vector = Eigen::Vector3d;
using Measured = std::vector<std::optional<Pose3d>>;

// Poses within a hexapod's reach, measured with the noise of an optical tracker.
struct Truth {
  explicit Truth(std::mt19937_64& random, std::size_t count = 40, double reach = 0.25) {
    const auto pose = [&random](double m, double rad) {
      const Vector translation = UniformVector(random, m);
      return Pose3d{translation, Exp(UniformVector(random, rad))};
    };
    const Pose3d world_from_base = pose(1.0, 1.5), platform_from_tool = pose(0.1, 1.5);
    for (std::size_t i = 0; i < count; ++i) {
      Vector6d vector;
      vector << UniformVector(random, 0.03) + Vector(0, 0, 0.2), UniformVector(random, reach);
      vectors.push_back(vector);
      const Pose3d reported = MakePose(RotationByOrder("xyz", vector.tail<3>()), vector.head<3>());
      poses.push_back(reported);
      const Vector6d noise =
          Vector6d(Normal(random, 6))
              .cwiseProduct(
                  (Vector6d() << Vector::Constant(5e-5), Vector::Constant(4e-4)).finished());
      measured.push_back(Plus(world_from_base * reported * platform_from_tool, noise));
    }
  }

  std::vector<Vector6d> vectors;
  std::vector<Pose3d> poses;
  Measured measured;
};

// What an import that takes these vectors by this order makes of them.
std::vector<StatedPose> ByOrder(const std::vector<Vector6d>& vectors, std::string_view order) {
  std::vector<StatedPose> stated;
  for (const Vector6d& v : vectors)
    stated.push_back({MakePose(RotationByOrder(order, v.tail<3>()), v.head<3>()), v});
  return stated;
}

std::vector<StatedPose> AsTheyAre(const std::vector<Pose3d>& poses) {
  std::vector<StatedPose> stated;
  for (const Pose3d& pose : poses) stated.push_back({pose, std::nullopt});
  return stated;
}

std::vector<MeasuredReading> Stated(const Measured& measured) { return {{measured, 0}}; }

RobotReading Order(std::string_view order) {
  RobotReading reading;
  reading.order = order;
  return reading;
}

class ConventionsTest : public ::testing::Test {
 protected:
  std::mt19937_64 random = SeededByTest();
};

TEST_F(ConventionsTest, FindTheOrderOfTheAngles) {
  const Truth truth(random);
  for (const std::string_view order : kRotationOrders) {
    const auto found =
        TryConventions(ByOrder(truth.vectors, order), Stated(truth.measured), Order(order));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->best.robot.order, "xyz") << order;
    EXPECT_FALSE(found->best.robot.is_transposed || found->best.robot.is_inverse) << order;
    EXPECT_EQ(found->gain >= kClearGain, order != "xyz") << order << " " << found->gain;
    EXPECT_EQ(found->tried, 432u);
  }
}

TEST_F(ConventionsTest, FindUnits) {
  const Truth truth(random);
  std::vector<Vector6d> degrees = truth.vectors, metres = truth.vectors;
  for (Vector6d& v : degrees) v.tail<3>() *= 180 / kPi;
  for (Vector6d& v : metres) v.head<3>() *= 1e3;
  const auto angles = TryConventions(ByOrder(degrees, "xyz"), Stated(truth.measured), Order("xyz"));
  EXPECT_NEAR(angles->best.robot.angle_factor, kPi / 180, 1e-12);
  EXPECT_GT(angles->gain, kClearGain);
  EXPECT_EQ(angles->best.changes, 1);
  const auto lengths = TryConventions(ByOrder(metres, "xyz"), Stated(truth.measured), Order("xyz"));
  EXPECT_EQ(lengths->best.robot.length_factor, 1e-3);
  EXPECT_GT(lengths->gain, kClearGain);
  EXPECT_EQ(lengths->best.changes, 1);
}

TEST_F(ConventionsTest, FindInversionsOnEitherSide) {
  const Truth truth(random);
  std::vector<Pose3d> inverse;
  for (const Pose3d& pose : truth.poses) inverse.push_back(pose.Inverse());
  const auto robot = TryConventions(AsTheyAre(inverse), Stated(truth.measured), {});
  EXPECT_TRUE(robot->best.robot.is_inverse);
  EXPECT_EQ(robot->best.changes, 1);
  EXPECT_GT(robot->gain, kClearGain);
  RobotReading inverted;
  inverted.is_inverse = true;
  EXPECT_LT(TryConventions(AsTheyAre(inverse), Stated(truth.measured), inverted)->gain, kClearGain);

  Measured backwards;
  for (const auto& pose : truth.measured) backwards.push_back(pose->Inverse());
  const auto tracker = TryConventions(
      ByOrder(truth.vectors, "xyz"), {{backwards, 0}, {truth.measured, 1}}, Order("xyz"));
  EXPECT_EQ(tracker->best.measured, 1u);
  EXPECT_EQ(tracker->best.changes, 1);
  EXPECT_GT(tracker->gain, kClearGain);
}

// Of two ways to read the tracker that fit alike the one with fewer changes.
TEST_F(ConventionsTest, ChangeTheTrackersReadingAsLittleAsTheyCan) {
  const Truth truth(random);
  Measured wrong = truth.measured;
  for (auto& pose : wrong) pose->rotation = Shifted(pose->rotation, 3);
  const auto found = TryConventions(ByOrder(truth.vectors, "xyz"),
                                    {{wrong, 0}, {truth.measured, 2}, {truth.measured, 1}},
                                    Order("xyz"));
  EXPECT_EQ(found->best.measured, 2u);
  EXPECT_EQ(found->best.changes, 1);
  EXPECT_GT(found->gain, kClearGain);
}

TEST_F(ConventionsTest, FindTransposedRotationsAndOrdersOfQuaternions) {
  const Truth truth(random);
  std::vector<Pose3d> transposed = truth.poses, scalar_last = truth.poses,
                      scalar_first = truth.poses;
  for (Pose3d& pose : transposed) pose.rotation = pose.rotation.conjugate();
  for (Pose3d& pose : scalar_last) {  // x y z w, read as w x y z
    const Eigen::Quaterniond q = pose.rotation;
    pose.rotation = Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w());
  }
  for (Pose3d& pose : scalar_first) {  // w x y z, read as x y z w
    const Eigen::Quaterniond q = pose.rotation;
    pose.rotation = Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y());
  }
  const auto sense = TryConventions(AsTheyAre(transposed), Stated(truth.measured), {});
  EXPECT_TRUE(sense->best.robot.is_transposed);
  EXPECT_EQ(sense->best.changes, 1);
  const auto last = TryConventions(AsTheyAre(scalar_last), Stated(truth.measured), {});
  EXPECT_EQ(last->best.robot.quaternion_shift, 3);
  EXPECT_EQ(last->best.changes, 1);
  const auto first = TryConventions(AsTheyAre(scalar_first), Stated(truth.measured), {});
  EXPECT_EQ(first->best.robot.quaternion_shift, 1);
  EXPECT_EQ(first->best.changes, 1);
  for (const auto& found : {sense, last, first}) EXPECT_GT(found->gain, kClearGain);
}

// Also where all poses lie close together, and where there is no noise at all.
TEST_F(ConventionsTest, LeaveTheRightOneAlone) {
  for (int repeat = 0; repeat < 30; ++repeat) {
    const Truth truth(random, 12, repeat % 2 == 0 ? 0.2 : 0.01);
    const auto found =
        TryConventions(ByOrder(truth.vectors, "xyz"), Stated(truth.measured), Order("xyz"));
    EXPECT_LT(found->gain, kClearGain) << repeat;
  }
  Truth exact(random, 20);
  for (std::size_t i = 0; i < exact.poses.size(); ++i) exact.measured[i] = exact.poses[i];
  EXPECT_LT(
      TryConventions(ByOrder(exact.vectors, "xyz"), Stated(exact.measured), Order("xyz"))->gain,
      kClearGain);
}

TEST_F(ConventionsTest, SayNothingOfTooFewPosesAndLookAtFewOfMany) {
  Truth truth(random, 8);
  for (std::size_t i = 0; i < 3; ++i) truth.measured[i].reset();
  EXPECT_FALSE(TryConventions(ByOrder(truth.vectors, "xyz"), Stated(truth.measured), Order("xyz")));
  const Truth many(random, 2000);
  const auto found =
      TryConventions(ByOrder(many.vectors, "zyx"), Stated(many.measured), Order("zyx"));
  EXPECT_EQ(found->best.robot.order, "xyz");
}

}  // namespace
}  // namespace hexcal
