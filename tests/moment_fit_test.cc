// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/moment_fit.h"

#include <gtest/gtest.h>

#include "estimator/closed_form.h"
#include "estimator/moment_start.h"
#include "estimator/pose_fit.h"
#include "testing/matchers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::Difference;
using testing::MatrixNear;
using testing::SeededByTest;

constexpr double kPosition = 1e-4, kOrientation = 5e-4;  // 1-sigma, m and rad

PoseBatch Packed(const std::vector<Observation>& rows) {
  PoseBatch batch;
  for (const Observation& o : rows) batch.Add(o.base_from_platform, o.world_from_tool);
  return batch;
}

struct Scene {
  BaseAndTool truth;
  std::vector<Observation> rows;
  PoseBatch batch;
};

template <typename Rng>
Scene NoisyScene(Rng& rng, int poses, const Matrix6d& noise) {
  Scene scene{testing::AnyMounts(rng), {}, {}};
  scene.rows = testing::HexapodObservations(rng, scene.truth, poses);
  testing::AddNoise(rng, noise, &scene.rows);
  scene.batch = Packed(scene.rows);
  return scene;
}

PoseMoments MomentsOf(const PoseBatch& batch, int threads = 1) {
  return PoseStream(batch, PoseWeights(), {}, threads).Moments();
}

TEST(PoseMoments, AreSumsOverPoses) {
  auto rng = SeededByTest();
  for (const int poses : {1, 2, 4, 7, 1030}) {
    const Scene scene = NoisyScene(rng, poses, testing::TrackerLikeCovariance());
    const PoseMoments found = MomentsOf(scene.batch);
    PoseMoments sum;
    for (const Observation& o : scene.rows) {
      const Eigen::Matrix3d reported = o.base_from_platform.rotation.toRotationMatrix();
      const Eigen::Matrix3d measured = o.world_from_tool.rotation.toRotationMatrix();
      const Eigen::Vector3d q =
          o.world_from_tool.translation - scene.rows[0].world_from_tool.translation;
      const Eigen::Vector3d a =
          o.base_from_platform.translation - scene.rows[0].base_from_platform.translation;
      ++sum.poses;
      for (int i = 0; i < 9; ++i)
        for (int k = 0; k < 9; ++k)
          sum.turns(i, k) += reported(i / 3, i % 3) * measured(k / 3, k % 3);
      sum.reported += reported;
      sum.measured += measured;
      for (int k = 0; k < 3; ++k) sum.q_reported[k] += q[k] * reported;
      sum.qq += q * q.transpose();
      sum.qa += q * a.transpose();
      sum.reported_a += reported.transpose() * a;
      sum.q += q, sum.a += a, sum.aa += a.squaredNorm();
    }
    const double tolerance = 1e-13 * poses;
    EXPECT_EQ(found.poses, poses);
    EXPECT_TRUE(MatrixNear(found.turns, sum.turns, tolerance));
    EXPECT_TRUE(MatrixNear(found.reported, sum.reported, tolerance));
    EXPECT_TRUE(MatrixNear(found.measured, sum.measured, tolerance));
    for (int k = 0; k < 3; ++k)
      EXPECT_TRUE(MatrixNear(found.q_reported[k], sum.q_reported[k], tolerance));
    EXPECT_TRUE(MatrixNear(found.qq, sum.qq, tolerance));
    EXPECT_TRUE(MatrixNear(found.qa, sum.qa, tolerance));
    EXPECT_TRUE(MatrixNear(found.reported_a, sum.reported_a, tolerance));
    EXPECT_TRUE(MatrixNear(found.q, sum.q, tolerance));
    EXPECT_TRUE(MatrixNear(found.a, sum.a, tolerance));
    EXPECT_NEAR(found.aa, sum.aa, tolerance);
  }
}

// The pass over the poses is the judge: at a perfect fit all is the same, away from it the
// positions' gradient is too, and the orientations' but for the cube of the error.
TEST(MomentStart, HasTheEquationsOfThePass) {
  auto rng = SeededByTest();
  for (const double turn : {0.0, 1e-3, 1e-2}) {
    Scene scene{testing::AnyMounts(rng), {}, {}};
    scene.rows = testing::HexapodObservations(rng, scene.truth, 17);
    for (Observation& o : scene.rows)
      o.world_from_tool = o.world_from_tool * testing::SmallPose(rng, turn, turn);
    scene.batch = Packed(scene.rows);
    const PoseMoments moments = MomentsOf(scene.batch);
    const IsotropicSums found = MomentStart(moments).At(scene.truth);
    const PoseWeights unit;
    const IsotropicSums sums = PoseStream(scene.batch, unit).PartsAt(scene.truth);
    EXPECT_TRUE(MatrixNear(found.position.gradient, sums.position.gradient, 1e-12));
    EXPECT_TRUE(MatrixNear(
        found.orientation.gradient, sums.orientation.gradient, 1e-12 + 17 * std::pow(turn, 3)));
    EXPECT_TRUE(MatrixNear(found.position.normal, sums.position.normal, 1e-12 + 17 * turn));
    EXPECT_TRUE(MatrixNear(found.orientation.normal, sums.orientation.normal, 1e-12 + 17 * turn));
  }
}

TEST(MomentStart, ClosedFormRecoversAnyBaseAndTool) {
  auto rng = SeededByTest();
  for (int i = 0; i < 200; ++i) {
    const BaseAndTool truth = testing::AnyMounts(rng);
    const PoseMoments moments = MomentsOf(Packed(testing::HexapodObservations(rng, truth, 10)));
    const std::optional<BaseAndTool> found = MomentStart(moments).ClosedForm();
    ASSERT_TRUE(found);
    EXPECT_LT(Difference(*found, truth).norm(), 1e-6);
  }
}

TEST(MomentStart, ClosedFormIsShahs) {
  auto rng = SeededByTest();
  for (int i = 0; i < 20; ++i) {
    const Scene scene = NoisyScene(rng, 60, testing::TrackerLikeCovariance());
    const PoseMoments moments = MomentsOf(scene.batch);
    const std::optional<BaseAndTool> found = MomentStart(moments).ClosedForm();
    ASSERT_TRUE(found);
    EXPECT_LT(Difference(*found, SolveClosedForm(ClosedForm::kShah, scene.rows)).norm(), 1e-5);
    EXPECT_GT(Difference(*found, scene.truth).norm(), 1e-4);
  }
}

void ExpectSameFit(const PoseFit& a, const PoseFit& b) {
  ASSERT_TRUE(a.solution.converged && b.solution.converged);
  EXPECT_TRUE(
      MatrixNear(Difference(a.solution.mounts, b.solution.mounts), Vector12d::Zero(), 1e-12));
  EXPECT_NEAR(a.equations.squared_norm, b.equations.squared_norm, 1e-10 * b.equations.squared_norm);
  const Matrix12d expected = CovarianceOf(b);
  const Vector12d scale = expected.diagonal().cwiseSqrt().cwiseInverse();
  EXPECT_TRUE(MatrixNear(scale.asDiagonal() * (CovarianceOf(a) - expected) * scale.asDiagonal(),
                         Matrix12d::Zero(),
                         1e-10));
}

PoseFit FitBy(PoseFitOptions::Method method,
              const PoseBatch& batch,
              const PoseWeights& weights,
              int threads = 1) {
  PoseFitOptions options;
  options.method = method;
  options.threads = threads;
  return FitPoses(batch, &weights, {}, options);
}

// With one level of each kind the moments lead so near that one or two passes are left.
TEST(MomentFit, AgreesWithTheTrustRegion) {
  auto rng = SeededByTest();
  for (const double factor : {0.1, 1.0, 20.0})
    for (const int poses : {5, 60, 1025, 9000}) {
      const Scene scene =
          NoisyScene(rng, poses, testing::Isotropic(factor * kPosition, factor * kOrientation));
      const PoseWeights weights = PoseWeights::Isotropic(factor * kPosition, factor * kOrientation);
      const std::optional<MomentFit> fit = FitByMoments(scene.batch, weights, 1);
      ASSERT_TRUE(fit) << poses << " poses, noise x " << factor;
      EXPECT_LE(fit->solution.iterations.size(), factor > 1.0 ? 4u : 2u);
      ExpectSameFit(FitBy(PoseFitOptions::Method::kMoments, scene.batch, weights),
                    FitBy(PoseFitOptions::Method::kTrustRegion, scene.batch, weights));
    }
}

TEST(MomentFit, AgreesWithTheTrustRegionForAnyWeights) {
  auto rng = SeededByTest();
  for (const int poses : {10, 60, 1500}) {
    const Scene scene = NoisyScene(rng, poses, testing::TrackerLikeCovariance());
    PoseWeights own = PoseWeights::PerPose(poses);
    for (int i = 0; i < poses; ++i)
      own.Add(testing::Uniform(rng, 0.5, 2.0) * testing::TrackerLikeCovariance());
    PoseWeights common = PoseWeights::Common(testing::TrackerLikeCovariance());
    for (const PoseWeights* weights : {&own, &common}) {
      EXPECT_TRUE(FitByMoments(scene.batch, *weights, 1));
      ExpectSameFit(FitBy(PoseFitOptions::Method::kMoments, scene.batch, *weights),
                    FitBy(PoseFitOptions::Method::kTrustRegion, scene.batch, *weights));
    }
  }
}

TEST(MomentFit, FindsAnyBaseAndTool) {
  auto rng = SeededByTest();
  const PoseWeights weights = PoseWeights::Isotropic(kPosition, kOrientation);
  for (int i = 0; i < 300; ++i) {
    const Scene scene = NoisyScene(rng, 20, testing::Isotropic(kPosition, kOrientation));
    const std::optional<MomentFit> fit = FitByMoments(scene.batch, weights, 1);
    ASSERT_TRUE(fit);
    EXPECT_LT(Difference(fit->solution.mounts, scene.truth).norm(), 0.02);
  }
}

TEST(MomentFit, ExactPosesLeaveNothing) {
  auto rng = SeededByTest();
  const PoseWeights weights = PoseWeights::Isotropic(kPosition, kOrientation);
  const BaseAndTool truth = testing::AnyMounts(rng);
  const PoseBatch batch = Packed(testing::HexapodObservations(rng, truth, 12));
  const std::optional<MomentFit> fit = FitByMoments(batch, weights, 1);
  ASSERT_TRUE(fit);
  EXPECT_LT(Difference(fit->solution.mounts, truth).norm(), 1e-12);
}

// What it leaves to the trust region is solved by that: rotations about one axis or none, many
// gross errors, stated noise beyond all rounding.
TEST(MomentFit, LeavesHardPosesToTheTrustRegion) {
  auto rng = SeededByTest();
  const PoseWeights weights = PoseWeights::Isotropic(kPosition, kOrientation);
  Scene one_axis{testing::AnyMounts(rng), {}, {}};
  one_axis.rows = testing::HexapodObservations(rng, one_axis.truth, 20);
  Scene none = one_axis, wrong = one_axis;
  for (std::size_t i = 0; i < 20; ++i) {
    one_axis.rows[i].base_from_platform.rotation =
        Exp(Eigen::Vector3d(0, 0, testing::Uniform(rng, -2, 2)));
    none.rows[i].base_from_platform.rotation.setIdentity();
    for (Scene* scene : {&one_axis, &none})
      scene->rows[i].world_from_tool = scene->truth.world_from_base *
                                       scene->rows[i].base_from_platform *
                                       scene->truth.platform_from_tool;
    if (i % 3 == 0) wrong.rows[i].world_from_tool = testing::RandomPose(rng, 2.0);
  }
  for (Scene* scene : {&one_axis, &none, &wrong}) {
    scene->batch = Packed(scene->rows);
    EXPECT_FALSE(FitByMoments(scene->batch, weights, 1));
    const PoseFit a = FitBy(PoseFitOptions::Method::kMoments, scene->batch, weights);
    const PoseFit b = FitBy(PoseFitOptions::Method::kTrustRegion, scene->batch, weights);
    EXPECT_TRUE(a.solution.converged);
    EXPECT_EQ(Difference(a.solution.mounts, b.solution.mounts).norm(), 0.0);
  }
}

// Far from a solution there is none of these poses: numbers that are none end nowhere.
TEST(MomentFit, RefusesWhatIsNoNumber) {
  auto rng = SeededByTest();
  Scene scene = NoisyScene(rng, 12, testing::Isotropic(kPosition, kOrientation));
  scene.rows[7].world_from_tool.translation.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(
      FitByMoments(Packed(scene.rows), PoseWeights::Isotropic(kPosition, kOrientation), 1));
}

TEST(MomentFit, ThreadsDoNotChangeABit) {
  auto rng = SeededByTest();
  const Scene scene = NoisyScene(rng, 40001, testing::Isotropic(kPosition, kOrientation));
  const PoseWeights weights = PoseWeights::Isotropic(kPosition, kOrientation);
  const PoseFit one = FitBy(PoseFitOptions::Method::kMoments, scene.batch, weights);
  EXPECT_TRUE(MomentsOf(scene.batch, 1).turns == MomentsOf(scene.batch, 5).turns);
  for (const int threads : {2, 3, 16}) {
    const PoseFit many = FitBy(PoseFitOptions::Method::kMoments, scene.batch, weights, threads);
    EXPECT_TRUE(one.equations.normal == many.equations.normal);
    EXPECT_EQ(Difference(one.solution.mounts, many.solution.mounts).norm(), 0.0);
  }
}

}  // namespace
}  // namespace hexcal
