// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/closed_form.h"

#include "estimator/start.h"
#include "geometry/align_points.h"
#include "geometry/linear_algebra.h"
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

// Zhuang's divides by the scalar part of the base's quaternion.
bool Applies(ClosedForm method, const BaseAndTool& truth) {
  return method != ClosedForm::kZhuang || std::abs(truth.world_from_base.rotation.w()) > 0.05;
}

class ClosedFormTest : public ::testing::TestWithParam<ClosedForm> {};

TEST_P(ClosedFormTest, RecoversAnyBaseAndToolOfAHexapod) {
  auto rng = SeededByTest();
  for (int i = 0; i < 200; ++i) {
    const BaseAndTool truth = AnyMounts(rng);
    if (!Applies(GetParam(), truth)) continue;
    const BaseAndTool found = SolveClosedForm(GetParam(), HexapodObservations(rng, truth, 10));
    EXPECT_TRUE(PoseNear(found.world_from_base, truth.world_from_base, 1e-9, 1e-10));
    EXPECT_TRUE(PoseNear(found.platform_from_tool, truth.platform_from_tool, 1e-9, 1e-10));
  }
}

TEST_P(ClosedFormTest, RecoversAnArmWhosePosesAreAnywhere) {
  auto rng = SeededByTest();
  for (int i = 0; i < 200; ++i) {
    const BaseAndTool truth = AnyMounts(rng);
    if (!Applies(GetParam(), truth)) continue;
    auto rows = HexapodObservations(rng, truth, 12);
    for (Observation& o : rows) {
      o.base_from_platform = testing::RandomPose(rng, 1.0);
      o.world_from_tool = truth.world_from_base * o.base_from_platform * truth.platform_from_tool;
    }
    EXPECT_LT(Difference(SolveClosedForm(GetParam(), rows), truth).norm(), 1e-9);
  }
}

// Li's takes the lever from the world's origin into its noise.
TEST_P(ClosedFormTest, StaysWithinTheNoise) {
  auto rng = SeededByTest();
  const double bound = GetParam() == ClosedForm::kLi ? 0.05 : 0.02;
  for (int i = 0; i < 50; ++i) {
    const BaseAndTool truth{testing::SmallPose(rng, 2.0, 1.0), testing::RandomPose(rng, 0.3)};
    auto rows = HexapodObservations(rng, truth, 60);
    testing::AddNoise(rng, testing::TrackerLikeCovariance(), &rows);
    EXPECT_LT(Difference(SolveClosedForm(GetParam(), rows), truth).norm(), bound);
  }
}

INSTANTIATE_TEST_SUITE_P(All,
                         ClosedFormTest,
                         ::testing::Values(ClosedForm::kShah,
                                           ClosedForm::kParkMartin,
                                           ClosedForm::kLi,
                                           ClosedForm::kZhuang),
                         [](const auto& method) -> std::string {
                           switch (method.param) {
                             case ClosedForm::kShah:
                               return "Shah";
                             case ClosedForm::kParkMartin:
                               return "ParkMartin";
                             case ClosedForm::kLi:
                               return "Li";
                             default:
                               return "Zhuang";
                           }
                         });

// Four methods, not one: with noise each has its own answer.
TEST(ClosedForm, AllDifferWithinTheNoise) {
  auto rng = SeededByTest();
  const BaseAndTool truth{testing::SmallPose(rng, 2.0, 1.0), testing::RandomPose(rng, 0.3)};
  auto rows = HexapodObservations(rng, truth, 60);
  testing::AddNoise(rng, testing::TrackerLikeCovariance(), &rows);
  const ClosedForm methods[] = {
      ClosedForm::kShah, ClosedForm::kParkMartin, ClosedForm::kLi, ClosedForm::kZhuang};
  for (const ClosedForm one : methods)
    for (const ClosedForm other : methods)
      if (one != other) {
        const auto difference =
            Difference(SolveClosedForm(one, rows), SolveClosedForm(other, rows)).norm();
        EXPECT_GT(difference, 1e-9);
        EXPECT_LT(difference, 0.07);
      }
}

// A quaternion and its negative are one rotation: whatever sign a dataset gives, the answer stays.
TEST(ClosedForm, ZhuangsDoesNotDependOnTheSignsOfQuaternions) {
  auto rng = SeededByTest();
  const BaseAndTool truth{testing::SmallPose(rng, 2.0, 1.0), testing::RandomPose(rng, 0.3)};
  auto rows = HexapodObservations(rng, truth, 12);
  for (Observation& o : rows) {
    o.base_from_platform = testing::RandomPose(rng, 1.0);
    o.world_from_tool = truth.world_from_base * o.base_from_platform * truth.platform_from_tool;
    if (testing::Uniform(rng, -1, 1) < 0) o.world_from_tool.rotation.coeffs() *= -1.0;
    if (testing::Uniform(rng, -1, 1) < 0) o.base_from_platform.rotation.coeffs() *= -1.0;
  }
  EXPECT_LT(Difference(SolveClosedForm(ClosedForm::kZhuang, rows), truth).norm(), 1e-9);
}

// What it assumes: the base's quaternion has a scalar part.
TEST(ClosedForm, ZhuangsIsWrongForABaseTurnedByHalfATurn) {
  auto rng = SeededByTest();
  const BaseAndTool truth{{Eigen::Vector3d(0.1, 0.2, 0.3), Eigen::Quaterniond(0, 0.6, 0.8, 0)},
                          testing::RandomPose(rng, 0.3)};
  const auto rows = HexapodObservations(rng, truth, 20);
  const BaseAndTool zhuang = SolveClosedForm(ClosedForm::kZhuang, rows);
  EXPECT_TRUE(zhuang.world_from_base.rotation.coeffs().allFinite());
  EXPECT_GT(Difference(zhuang, truth).norm(), 0.1);
  EXPECT_LT(Difference(SolveClosedForm(ClosedForm::kShah, rows), truth).norm(), 1e-9);
}

// Li's problem is that of all 24 numbers at once: solved here by stacking its 12 n rows.
TEST(ClosedForm, LisIsTheLeastSquaresSolutionOfItsRows) {
  auto rng = SeededByTest();
  const BaseAndTool truth{testing::SmallPose(rng, 2.0, 1.0), testing::RandomPose(rng, 0.3)};
  auto rows = HexapodObservations(rng, truth, 30);
  testing::AddNoise(rng, testing::TrackerLikeCovariance(), &rows);
  // Rows of [A R - Z Q] and of [Z q - b - A t - a] for v = [vec Z, vec R, t, b].
  Eigen::MatrixXd left = Eigen::MatrixXd::Zero(12 * rows.size(), 24);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(12 * rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Eigen::Matrix4d robot = rows[k].base_from_platform.Matrix();
    const Eigen::Matrix4d tool = rows[k].world_from_tool.Matrix();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j)
        for (int l = 0; l < 3; ++l) {
          left(12 * k + 3 * i + j, 9 + 3 * j + l) = robot(i, l);
          left(12 * k + 3 * i + j, 3 * l + i) = -tool(l, j);
        }
      for (int l = 0; l < 3; ++l) {
        left(12 * k + 9 + i, 3 * l + i) = tool(l, 3);
        left(12 * k + 9 + i, 18 + l) = -robot(i, l);
      }
      left(12 * k + 9 + i, 21 + i) = -1.0;
      right[12 * k + 9 + i] = robot(i, 3);
    }
  }
  const Eigen::VectorXd v = ShortestSolution(left, right, 1e-12);
  const Eigen::Matrix3d base =
      NearestRotation(Eigen::Map<const Eigen::Matrix3d>(v.data())).transpose();
  const Eigen::Matrix3d turn = NearestRotation(Eigen::Map<const Eigen::Matrix3d>(v.data() + 9));
  const BaseAndTool expected{MakePose(base, base * v.segment<3>(21)),
                             MakePose(turn, v.segment<3>(18))};
  EXPECT_LT(Difference(SolveClosedForm(ClosedForm::kLi, rows), expected).norm(), 1e-9);
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
