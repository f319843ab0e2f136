// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/closed_form.h"

#include "estimator/start.h"
#include "testing/matchers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::AnyMounts;
using testing::Difference;
using testing::HexapodObservations;
using testing::MatrixNear;
using testing::PoseNear;
using testing::SeededByTest;

class ClosedFormTest : public ::testing::TestWithParam<ClosedForm> {};

TEST_P(ClosedFormTest, RecoversAnyBaseAndToolOfAHexapod) {
  auto rng = SeededByTest();
  for (int i = 0; i < 200; ++i) {
    const BaseAndTool truth = AnyMounts(rng);
    const BaseAndTool found = SolveClosedForm(GetParam(), HexapodObservations(rng, truth, 10));
    EXPECT_TRUE(PoseNear(found.world_from_base, truth.world_from_base, 1e-9, 1e-10));
    EXPECT_TRUE(PoseNear(found.platform_from_tool, truth.platform_from_tool, 1e-9, 1e-10));
  }
}

TEST_P(ClosedFormTest, RecoversAnArmWhosePosesAreAnywhere) {
  auto rng = SeededByTest();
  for (int i = 0; i < 200; ++i) {
    const BaseAndTool truth = AnyMounts(rng);
    auto rows = HexapodObservations(rng, truth, 12);
    for (Observation& o : rows) {
      o.base_from_platform = testing::RandomPose(rng, 1.0);
      o.world_from_tool = truth.world_from_base * o.base_from_platform * truth.platform_from_tool;
    }
    EXPECT_LT(Difference(SolveClosedForm(GetParam(), rows), truth).norm(), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(All,
                         ClosedFormTest,
                         ::testing::Values(ClosedForm::kShah, ClosedForm::kParkMartin),
                         [](const auto& method) {
                           return method.param == ClosedForm::kShah ? "Shah" : "ParkMartin";
                         });

TEST(ClosedForm, BothAgreeWithinTheNoise) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  auto rows = HexapodObservations(rng, truth, 60);
  testing::AddNoise(rng, testing::TrackerLikeCovariance(), &rows);
  const auto shah = Difference(SolveClosedForm(ClosedForm::kShah, rows), truth);
  const auto park = Difference(SolveClosedForm(ClosedForm::kParkMartin, rows), truth);
  EXPECT_LT(shah.norm(), 0.02);
  EXPECT_LT(park.norm(), 0.02);
  EXPECT_GT((shah - park).norm(), 0.0);  // two methods, not one
}

// All rotations about one axis: the shift along it stays open, every predicted pose is right all
// the same.
TEST(ClosedForm, TheBestStartFitsPosesThatShareOneAxis) {
  auto rng = SeededByTest();
  for (int i = 0; i < 50; ++i) {
    const BaseAndTool truth = AnyMounts(rng);
    auto rows = HexapodObservations(rng, truth, 20);
    for (Observation& o : rows) {
      o.base_from_platform.rotation = Exp(Eigen::Vector3d(0, 0, testing::Uniform(rng, -2, 2)));
      o.world_from_tool = truth.world_from_base * o.base_from_platform * truth.platform_from_tool;
    }
    const BaseAndTool start = FindStart(rows);
    for (const Observation& o : rows)  // the scan's step is 15 deg
      EXPECT_LT(PoseError(start, o.base_from_platform, o.world_from_tool).tail<3>().norm(), 0.3);
  }
}

TEST(ClosedForm, TheBestStartFitsPosesThatDoNotRotate) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  auto rows = HexapodObservations(rng, truth, 20);
  for (Observation& o : rows) {
    o.base_from_platform.rotation.setIdentity();
    o.world_from_tool = truth.world_from_base * o.base_from_platform * truth.platform_from_tool;
  }
  const BaseAndTool start = FindStart(rows);
  for (const Observation& o : rows)
    EXPECT_LT(PoseError(start, o.base_from_platform, o.world_from_tool).norm(), 1e-9);
}

}  // namespace
}  // namespace hexcal
